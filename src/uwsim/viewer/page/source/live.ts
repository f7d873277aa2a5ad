// The link to a running simulation: messages from it and to it (their format: viewer/head.py).
import type { Controls } from "./controls";
import type { Level, Marker } from "./head";
import { toPose } from "./geometry";
import { unpack, type Pack } from "./pack";
import type { Stream } from "./player";
import { element } from "./panels";
import { Pilot, type PilotState } from "./pilot";
import type { Reading } from "./display/quantities";
import { Topics, type TopicMessage } from "./display/topics";
import type { ViewCamera } from "./views";

const HEADER = 16; // length of the header of binary messages [byte]
const MAX_ROW_WAIT = 100; // greatest time that an image waits to be drawn with the next row [ms]
const MAX_WIDTH = 640; // greatest width of a view that the server draws [px]

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
  readonly pilot = new Pilot((message, isNew) => {
    this.send(message);
    if (isNew) this.page?.picture.skipRests();
  });
  readonly topics = new Topics((names) => this.send({ type: "topics", names }));
  private page: Controls | null = null;
  private stream: Stream | null = null;
  private lastRequest = "";
  private readonly imageNumbers: number[] = []; // the number of the newest image of each camera
  /** True if the simulation allows a reset to its initial state. */
  allowsReset = false;

  constructor(
    private readonly socket: WebSocket,
    readonly pack: Pack,
    private readonly earlyEvents: MessageEvent<ArrayBuffer | string>[],
    /** True if the server draws, because this browser cannot. */
    private readonly isServerDrawn: boolean,
  ) {
    socket.onclose = () => this.end("The simulation has ended.");
  }

  begin(page: Controls, stream: Stream): void {
    this.page = page;
    this.stream = stream;
    for (const event of this.earlyEvents) this.receive(event);
    this.socket.onmessage = (event: MessageEvent<ArrayBuffer | string>) => this.receive(event);
    this.subscribe(page.switches.pictures);
  }

  /** Request the images of all cameras, or of none. */
  subscribe(isOn: boolean): void {
    const cameras = isOn ? this.pack.head.cameras.map(({ name }) => name) : [];
    this.send({ type: "images", cameras, rate: 10, width: this.page?.picture.pictureWidth() });
  }

  /** Request an image of the view, if this browser cannot draw it. */
  requestView({ worldFromCamera, camera, lens }: ViewCamera): void {
    if (!this.isServerDrawn) return;
    const share = Math.min(1, MAX_WIDTH / lens.width);
    const [width, height] = [lens.width, lens.height].map((size) => Math.round(share * size));
    const pose = toPose(worldFromCamera).map((value) => Math.round(1e4 * value) / 1e4);
    const fovy = 2 * Math.atan(lens.height / 2 / lens.fy);
    const message = { type: "view", camera: camera?.name ?? null, pose, width, height, fovy };
    const text = JSON.stringify(message);
    if (text !== this.lastRequest) this.send(message);
    this.lastRequest = text;
  }

  control(action: string, speed?: number): void {
    this.send({ type: "control", action, ...(speed === undefined ? {} : { speed }) });
  }

  /** Apply a key of the pilot; return false if the key is not the pilot's. */
  takeKey(event: KeyboardEvent): boolean {
    return this.pilot.takeKey(event);
  }

  helpGroups(): Record<string, { keys: string; action: string }[]> {
    return { Pilot: this.pilot.help() };
  }

  private send(message: object): void {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private receive(event: MessageEvent<ArrayBuffer | string>): void {
    const { page, stream } = this;
    if (!page || !stream) return;
    if (typeof event.data === "string") return this.handleMessage(JSON.parse(event.data) as Message, page, stream);
    const view = new DataView(event.data);
    const [kind, index] = [view.getUint8(0), view.getUint8(1)];
    if (kind === 0) location.reload(); // another scene has begun
    if (kind === 1) stream.push(view.getFloat64(8, true), new Float32Array(event.data, HEADER));
    if (kind === 2) void this.showImage(index, event.data.slice(HEADER), page, stream);
    if (kind === 4) stream.setSand(index, new Float32Array(event.data, HEADER));
    if (kind === 3 && this.isServerDrawn) this.showView(event.data.slice(HEADER));
  }

  private handleMessage(message: Message, page: Controls, stream: Stream): void {
    if (message.type === "state") {
      page.setState(message.paused, message.speed);
      this.allowsReset = message.resets;
      this.pilot.enable(message);
      page.views.follow(message.vehicle);
      page.keyboard.showHelp();
    } else if (message.type === "levels") stream.setLevels(message.levels);
    else if (message.type === "samples") for (const sample of message.samples) stream.sample(...sample);
    else if (message.type === "readings") stream.version += Number(page.quantities.setReadings(message.readings));
    else if (message.type === "topics") this.topics.list(message.topics);
    else if (message.type === "topic") this.topics.showMessage(message);
    else if (message.type === "markers") stream.setMarkers(message.markers);
    else if (message.type === "end") this.end(message.why);
  }

  private async showImage(index: number, data: ArrayBuffer, page: Controls, stream: Stream): Promise<void> {
    const number = (this.imageNumbers[index] ?? 0) + 1;
    this.imageNumbers[index] = number;
    const image = await createImageBitmap(new Blob([data], { type: "image/jpeg" }));
    if (this.imageNumbers[index] !== number) return image.close(); // a newer one has arrived
    page.picture.show(index, image);
    const { end } = stream;
    setTimeout(() => {
      if (stream.end === end) stream.version += 1; // else it was drawn with a row
    }, MAX_ROW_WAIT);
  }

  private showView(data: ArrayBuffer): void {
    const image = element<HTMLImageElement>("stream");
    image.hidden = false;
    show(image, data);
  }

  private end(reason: string): void {
    element("message").textContent = reason;
    if (this.page) this.page.isPlaying = false;
  }
}

function show(image: HTMLImageElement, data: ArrayBuffer): void {
  const oldUrl = image.src;
  image.src = URL.createObjectURL(new Blob([data], { type: "image/jpeg" }));
  if (oldUrl) URL.revokeObjectURL(oldUrl);
}

/** Open the socket of the page's server; resolve when the head has arrived. */
export function connect(isServerDrawn: boolean): Promise<Link> {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  const socket = new WebSocket(`${scheme}//${location.host}/socket${location.search}`);
  socket.binaryType = "arraybuffer";
  return new Promise((resolve, reject) => {
    const earlyEvents: MessageEvent<ArrayBuffer | string>[] = [];
    let hasHead = false;
    socket.onerror = socket.onclose = () => reject(new Error("The simulation cannot be reached."));
    socket.onmessage = (event: MessageEvent<ArrayBuffer | string>) => {
      const { data } = event;
      if (hasHead || typeof data === "string" || new DataView(data).getUint8(0) !== 0) {
        earlyEvents.push(event);
        return;
      }
      hasHead = true;
      unpack(new Uint8Array(data.slice(HEADER))).then(
        (pack) => resolve(new Link(socket, pack, earlyEvents, isServerDrawn)), reject,
      );
    };
  });
}
