// The live view: what a running simulation sends, and what is sent to it (viewer/head.py).
import type { Level } from "./head";
import type { Page } from "./main";
import { unpack, type Pack } from "./pack";
import type { Stream } from "./player";
import { Pilot } from "./pilot";

const HEADER = 16;

type Message =
  | { type: "state"; paused: boolean; speed: number; pilot: boolean; mapping?: Record<string, string> }
  | { type: "levels"; levels: Level[] }
  | { type: "samples"; samples: [string, string, number, number | null][] }
  | { type: "end"; why: string };

export class Link {
  readonly pilot = new Pilot((message) => this.send(message));
  private page: Page | null = null;
  private stream: Stream | null = null;

  constructor(
    private readonly socket: WebSocket,
    readonly pack: Pack,
  ) {
    socket.onmessage = (event) => this.receive(event);
    socket.onclose = () => this.end("The simulation has ended.");
  }

  begin(page: Page, stream: Stream): void {
    this.page = page;
    this.stream = stream;
    page.isPlaying = true;
    this.send({ type: "images", cameras: this.pack.head.cameras.map(({ name }) => name), rate: 10 });
  }

  control(action: string, speed?: number): void {
    this.send({ type: "control", action, ...(speed === undefined ? {} : { speed }) });
  }

  /** Whether a key is the pilot's. */
  takes(event: KeyboardEvent): boolean {
    return this.pilot.takes(event);
  }

  help(): Record<string, { keys: string; does: string }[]> {
    return { Pilot: this.pilot.help() };
  }

  private send(message: object): void {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private receive(event: MessageEvent<ArrayBuffer | string>): void {
    const { page, stream } = this;
    if (!page || !stream) return;
    if (typeof event.data === "string") return this.hear(JSON.parse(event.data) as Message, page, stream);
    const view = new DataView(event.data);
    const [kind, index] = [view.getUint8(0), view.getUint8(1)];
    if (kind === 1) stream.push(view.getFloat64(8, true), new Float32Array(event.data, HEADER));
    if (kind === 2) this.showImage(page.picture.frame(index), event.data.slice(HEADER), index);
  }

  private hear(message: Message, page: Page, stream: Stream): void {
    if (message.type === "state") {
      page.isPlaying = !message.paused;
      document.getElementById("play")!.textContent = message.paused ? "Play" : "Pause";
      this.pilot.enable(message.pilot, message.mapping ?? {});
    } else if (message.type === "levels") stream.setLevels(message.levels);
    else if (message.type === "samples") for (const each of message.samples) stream.sample(...each);
    else if (message.type === "end") this.end(message.why);
  }

  private showImage(frame: HTMLElement | undefined, data: ArrayBuffer, index: number): void {
    if (!frame) return;
    let image = frame.querySelector("img");
    if (!image) {
      image = document.createElement("img");
      image.alt = `image of ${this.pack.head.cameras[index].name}`;
      frame.prepend(image);
      frame.querySelector("figcaption")!.textContent = this.pack.head.cameras[index].name;
    }
    const before = image.src;
    image.src = URL.createObjectURL(new Blob([data], { type: "image/jpeg" }));
    if (before) URL.revokeObjectURL(before);
  }

  private end(why: string): void {
    document.getElementById("message")!.textContent = why;
    if (this.page) this.page.isPlaying = false;
  }
}

/** Open the socket that the page came from; resolves when the head has arrived. */
export function connect(): Promise<Link> {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  const socket = new WebSocket(`${scheme}//${location.host}/socket${location.search}`);
  socket.binaryType = "arraybuffer";
  return new Promise((resolve, reject) => {
    socket.onerror = () => reject(new Error("The simulation cannot be reached."));
    socket.onmessage = (event: MessageEvent<ArrayBuffer>) => {
      if (typeof event.data === "string" || new DataView(event.data).getUint8(0) !== 0) return;
      unpack(new Uint8Array(event.data.slice(HEADER))).then(
        (pack) => resolve(new Link(socket, pack)), reject,
      );
    };
  });
}
