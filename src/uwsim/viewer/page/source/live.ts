// The connection to a running simulation: the messages that it sends and receives (viewer/head.py documents their format).
import type { Controls } from "./controls";
import type { Level, Marker } from "./head";
import { toPose } from "./geometry";
import type { MediumSpec } from "./water/medium";
import { unpack, type Pack } from "./pack";
import type { Stream } from "./players/stream";
import { element } from "./panels";
import { Pilot, type PilotState } from "./pilot";
import type { Reading } from "./display/quantities";
import { Topics, type TopicMessage } from "./display/topics";
import type { ViewCamera } from "./views";

const HEADER_LENGTH = 16; // length of the header of binary messages [byte]
const MAX_ROW_WAIT = 100; // longest time for which the drawing of a camera's image waits for the next row of motion [ms]
const MAX_WIDTH = 640; // greatest width of an image of the view that the server draws [px]

/** The text messages from the simulation. */
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

/** The connection to a running simulation. */
export class Connection {
  readonly pilot = new Pilot((message, isNew) => {
    this.send(message);
    if (isNew) this.page?.picture.skipPauses();
  });
  readonly topics = new Topics((names) => this.send({ type: "topics", names }));
  private page: Controls | null = null;
  private stream: Stream | null = null;
  private lastRequest = ""; // the last request for an image of the view
  private readonly imageNumbers: number[] = []; // the number of images received so far from each camera
  /** True if the simulation allows a reset to its initial state. */
  allowsReset = false;

  constructor(
    private readonly socket: WebSocket,
    readonly pack: Pack,
    /** The messages that arrived before the page was built. */
    private readonly earlyEvents: MessageEvent<ArrayBuffer | string>[],
    /** True if the server draws the view, because this browser has no WebGL 2. */
    private readonly isServerDrawn: boolean,
  ) {
    socket.onclose = () => this.end("The simulation has ended.");
  }

  /** Pass messages to the page and its player from now on. */
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

  /** Request an image of the view from the server, if this browser cannot draw it. */
  requestView({ worldFromCamera, camera, intrinsics }: ViewCamera): void {
    if (!this.isServerDrawn) return;
    const fraction = Math.min(1, MAX_WIDTH / intrinsics.width);
    const [width, height] = [intrinsics.width, intrinsics.height].map((size) => Math.round(fraction * size));
    const pose = toPose(worldFromCamera).map((value) => Math.round(1e4 * value) / 1e4);
    const fovy = 2 * Math.atan(intrinsics.height / 2 / intrinsics.fy);
    const message = { type: "view", camera: camera?.name ?? null, pose, width, height, fovy };
    const text = JSON.stringify(message);
    if (text !== this.lastRequest) this.send(message);
    this.lastRequest = text;
  }

  /** Send an action of the user, such as `pause` or `reset`; `speed` is the real-time factor of the action `speed`. */
  control(action: string, speed?: number): void {
    this.send({ type: "control", action, ...(speed === undefined ? {} : { speed }) });
  }

  /** Apply a key of the pilot; return false if the key is not the pilot's. */
  handlePilotKey(event: KeyboardEvent): boolean {
    return this.pilot.handlePilotKey(event);
  }

  /** Return the lines of the help for the pilot's keys, below their title. */
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
    if (kind === 0) location.reload(); // the server shows another scene now
    if (kind === 1) stream.push(view.getFloat64(8, true), new Float32Array(event.data, HEADER_LENGTH));
    if (kind === 2) void this.showImage(index, event.data.slice(HEADER_LENGTH), page, stream);
    if (kind === 4) stream.setSand(index, new Float32Array(event.data, HEADER_LENGTH));
    if (kind === 5) void this.addMedium(event.data.slice(HEADER_LENGTH), page, stream);
    if (kind === 6) stream.setPuffs(new Float64Array(event.data, HEADER_LENGTH));
    if (kind === 3 && this.isServerDrawn) this.showView(event.data.slice(HEADER_LENGTH));
  }

  private async addMedium(content: ArrayBuffer, page: Controls, stream: Stream): Promise<void> {
    const pack = await unpack(new Uint8Array(content));
    page.picture.media.add(pack, (pack.head as unknown as { optics: MediumSpec }).optics);
    stream.version += 1;
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
    if (this.imageNumbers[index] !== number) return image.close(); // a newer image has arrived
    page.picture.show(index, image);
    const { end } = stream;
    setTimeout(() => {
      if (stream.end === end) stream.version += 1; // else the image was drawn with a row
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

/** Show a JPEG image in an element. */
function show(image: HTMLImageElement, data: ArrayBuffer): void {
  const oldUrl = image.src;
  image.src = URL.createObjectURL(new Blob([data], { type: "image/jpeg" }));
  if (oldUrl) URL.revokeObjectURL(oldUrl);
}

/** Connect to the server of the page; the promise resolves when the head has arrived. */
export function connect(isServerDrawn: boolean): Promise<Connection> {
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
      unpack(new Uint8Array(data.slice(HEADER_LENGTH))).then(
        (pack) => resolve(new Connection(socket, pack, earlyEvents, isServerDrawn)), reject,
      );
    };
  });
}
