// The live view: what a running simulation sends, and what is sent to it (viewer/head.py).
import type { Controls } from "./controls";
import type { Level, Marker } from "./head";
import { toPose } from "./geometry";
import { unpack, type Pack } from "./pack";
import type { Stream } from "./player";
import { element } from "./panels";
import { Pilot, type PilotState } from "./pilot";
import type { Reading } from "./display/quantities";
import { Topics, type TopicMessage } from "./display/topics";
import type { Sight } from "./views";

const HEADER = 16;
const WAIT = 100; // of an image for the next row, to be drawn with it [ms]
const MAX_WIDTH = 640; // of an image that the server draws

type Message =
  | {
      type: "state"; paused: boolean; speed: number; resets: boolean; vehicle: number;
    } & PilotState
  | { type: "levels"; levels: Level[] }
  | { type: "samples"; samples: [string, string, number, number | null][] }
  | { type: "readings"; time: number; readings: Reading[] }
  | { type: "topics"; topics: [string, string][] }
  | TopicMessage
  | { type: "markers"; markers: Marker[] }
  | { type: "end"; why: string };

export class Link {
  readonly pilot = new Pilot((message, isNews) => {
    this.send(message);
    if (isNews) this.page?.picture.hurry();
  });
  readonly topics = new Topics((names) => this.send({ type: "topics", names }));
  private page: Controls | null = null;
  private stream: Stream | null = null;
  private asked = "";
  private readonly numbers: number[] = []; // of the newest image of each camera
  /** Whether all may go back where it began. */
  resets = false;

  constructor(
    private readonly socket: WebSocket,
    readonly pack: Pack,
    private readonly early: MessageEvent<ArrayBuffer | string>[],
    /** Whether the server draws, because this browser cannot. */
    private readonly isDrawnThere: boolean,
  ) {
    socket.onclose = () => this.end("The simulation has ended.");
  }

  begin(page: Controls, stream: Stream): void {
    this.page = page;
    this.stream = stream;
    for (const event of this.early) this.receive(event);
    this.socket.onmessage = (event: MessageEvent<ArrayBuffer | string>) => this.receive(event);
    this.subscribe(page.switches.pictures);
  }

  /** Ask for the images of the cameras, or for none. */
  subscribe(on: boolean): void {
    const cameras = on ? this.pack.head.cameras.map(({ name }) => name) : [];
    this.send({ type: "images", cameras, rate: 10, width: this.page?.picture.widest() });
  }

  /** Ask for an image of what is looked at, where this browser cannot draw it. */
  ask({ worldFromCamera, camera, lens }: Sight): void {
    if (!this.isDrawnThere) return;
    const share = Math.min(1, MAX_WIDTH / lens.width);
    const [width, height] = [lens.width, lens.height].map((size) => Math.round(share * size));
    const pose = toPose(worldFromCamera).map((value) => Math.round(1e4 * value) / 1e4);
    const fovy = 2 * Math.atan(lens.height / 2 / lens.fy);
    const message = { type: "view", camera: camera?.name ?? null, pose, width, height, fovy };
    const text = JSON.stringify(message);
    if (text !== this.asked) this.send(message);
    this.asked = text;
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
    if (kind === 0) location.reload(); // another scene has begun
    if (kind === 1) stream.push(view.getFloat64(8, true), new Float32Array(event.data, HEADER));
    if (kind === 2) void this.showImage(index, event.data.slice(HEADER), page, stream);
    if (kind === 4) stream.dig(index, new Float32Array(event.data, HEADER));
    if (kind === 3 && this.isDrawnThere) this.showView(event.data.slice(HEADER));
  }

  private hear(message: Message, page: Controls, stream: Stream): void {
    if (message.type === "state") {
      page.isTold(message.paused, message.speed);
      this.resets = message.resets;
      this.pilot.enable(message);
      page.views.follow(message.vehicle);
      page.keyboard.help();
    } else if (message.type === "levels") stream.setLevels(message.levels);
    else if (message.type === "samples") for (const each of message.samples) stream.sample(...each);
    else if (message.type === "readings") stream.version += Number(page.quantities.hear(message.readings));
    else if (message.type === "topics") this.topics.list(message.topics);
    else if (message.type === "topic") this.topics.hear(message);
    else if (message.type === "markers") stream.spawn(message.markers);
    else if (message.type === "end") this.end(message.why);
  }

  private async showImage(index: number, data: ArrayBuffer, page: Controls, stream: Stream): Promise<void> {
    const number = (this.numbers[index] ?? 0) + 1;
    this.numbers[index] = number;
    const image = await createImageBitmap(new Blob([data], { type: "image/jpeg" }));
    if (this.numbers[index] !== number) return image.close(); // a newer one has come meanwhile
    page.picture.show(index, image);
    const { end } = stream;
    setTimeout(() => {
      if (stream.end === end) stream.version += 1; // else a row has had it drawn
    }, WAIT);
  }

  private showView(data: ArrayBuffer): void {
    const image = element<HTMLImageElement>("stream");
    image.hidden = false;
    show(image, data);
  }

  private end(why: string): void {
    element("message").textContent = why;
    if (this.page) this.page.isPlaying = false;
  }
}

function show(image: HTMLImageElement, data: ArrayBuffer): void {
  const before = image.src;
  image.src = URL.createObjectURL(new Blob([data], { type: "image/jpeg" }));
  if (before) URL.revokeObjectURL(before);
}

/** Open the socket of the server that the page came from; resolves when the head has arrived. */
export function connect(isDrawnThere: boolean): Promise<Link> {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  const socket = new WebSocket(`${scheme}//${location.host}/socket${location.search}`);
  socket.binaryType = "arraybuffer";
  return new Promise((resolve, reject) => {
    const early: MessageEvent<ArrayBuffer | string>[] = [];
    let isThere = false;
    socket.onerror = socket.onclose = () => reject(new Error("The simulation cannot be reached."));
    socket.onmessage = (event: MessageEvent<ArrayBuffer | string>) => {
      const { data } = event;
      if (isThere || typeof data === "string" || new DataView(data).getUint8(0) !== 0) {
        early.push(event);
        return;
      }
      isThere = true;
      unpack(new Uint8Array(data.slice(HEADER))).then(
        (pack) => resolve(new Link(socket, pack, early, isDrawnThere)), reject,
      );
    };
  });
}
