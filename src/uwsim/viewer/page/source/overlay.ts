// Lines and words over an image: frames, trails, fans, contacts, currents, quadrangles.
import type { Camera, Head, Sensor } from "./head";
import { inverse, origin, plus, transform, type Lens, type Matrix } from "./geometry";
import type { Models } from "./models";
import type { Moment, Player } from "./player";

export interface Shown {
  frames: boolean;
  labels: boolean;
  trails: boolean;
  sonars: boolean;
}

const AXES = ["#ff5a4f", "#45d96b", "#4aa3ff"];
const CLOSE = 0.02; // [m] ahead of the camera

const LETTERS = 11; // height [px]
const PLACES = [0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5]; // of a label, lines below and above its point

/** Draws in W on a part of a canvas. */
class Pen {
  private readonly taken: number[][] = []; // boxes of labels: left, top, right, bottom [px]
  private readonly cameraFromWorld: Matrix;

  constructor(
    readonly context: CanvasRenderingContext2D,
    worldFromCamera: Matrix,
    private readonly lens: Lens,
  ) {
    this.cameraFromWorld = inverse(worldFromCamera);
  }

  line(points: ArrayLike<number>[], colour: string, width = 1.5, dash: number[] = []): void {
    const { context } = this;
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.beginPath();
    let last: number[] | null = null;
    for (const point of points) {
      const here = transform(this.cameraFromWorld, point);
      if (last && (last[2] < -CLOSE || here[2] < -CLOSE)) {
        const [a, b] = [cut(last, here), cut(here, last)];
        context.moveTo(...this.pixel(a));
        context.lineTo(...this.pixel(b));
      }
      last = here;
    }
    context.stroke();
  }

  /** Where a point is in the image; null behind the camera. */
  place(point: ArrayLike<number>): [number, number] | null {
    const here = transform(this.cameraFromWorld, point);
    return here[2] < -CLOSE ? this.pixel(here) : null;
  }

  word(point: ArrayLike<number>, text: string, colour = "#ffffff"): void {
    const at = this.place(point);
    if (!at) return;
    const { context } = this;
    context.font = `${LETTERS}px system-ui, sans-serif`;
    const free = this.free(at, context.measureText(text).width);
    if (!free) return;
    const [x, y] = free;
    if (Math.abs(y - at[1]) > 2 * LETTERS) this.leader(at, [x - 2, y - LETTERS / 3], colour);
    context.lineWidth = 3;
    context.setLineDash([]);
    context.strokeStyle = "rgba(0, 12, 24, 0.75)";
    context.strokeText(text, x, y);
    context.fillStyle = colour;
    context.fillText(text, x, y);
  }

  /** Where a label of some width near a point covers no other; null where there is no room. */
  private free([x, y]: [number, number], width: number): [number, number] | null {
    for (const line of PLACES)
      for (const left of [x + 5, x - 5 - width]) {
        const base = y - 5 + line * (LETTERS + 3);
        const box = [left - 2, base - LETTERS, left + width + 2, base + 3];
        if (this.taken.some((b) => box[0] < b[2] && box[2] > b[0] && box[1] < b[3] && box[3] > b[1])) continue;
        this.taken.push(box);
        return [left, base];
      }
    return null;
  }

  /** A thin line from a point to its label. */
  private leader(from: [number, number], to: [number, number], colour: string): void {
    const { context } = this;
    context.strokeStyle = colour;
    context.lineWidth = 0.75;
    context.setLineDash([]);
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
  }

  dot(point: ArrayLike<number>, colour: string, radius: number): void {
    const at = this.place(point);
    if (!at) return;
    this.context.fillStyle = colour;
    this.context.beginPath();
    this.context.arc(at[0], at[1], radius, 0, 2 * Math.PI);
    this.context.fill();
  }

  private pixel([x, y, z]: number[]): [number, number] {
    const { fx, fy, cx, cy, skew } = this.lens;
    return [cx + (fx * x + skew * y) / -z + 0.5, cy - (fy * y) / -z + 0.5];
  }
}

/** The part of a line from a point that is ahead of the camera. */
function cut(from: number[], to: number[]): number[] {
  if (from[2] < -CLOSE) return from;
  const share = (-CLOSE - from[2]) / (to[2] - from[2]);
  return from.map((value, i) => value + share * (to[i] - value));
}

export function drawOverlay(
  context: CanvasRenderingContext2D, worldFromCamera: Matrix, lens: Lens, head: Head,
  models: Models, player: Player, moment: Moment, shown: Shown, since: number,
): void {
  const pen = new Pen(context, worldFromCamera, lens);
  for (const { name, at, colour, lines } of player.markers(moment.time)) {
    for (const line of lines) pen.line(line, colour);
    if (!lines.length) pen.dot(at, colour, 3);
    if (shown.labels || !lines.length) pen.word(at, name);
  }
  if (shown.trails) drawTrails(pen, head, player, moment, since);
  if (shown.sonars)
    for (const sensor of head.sensors) drawSensor(pen, sensor, models.mounted(sensor), moment);
  if (shown.frames) drawFrames(pen, head, models, shown.labels);
  else if (shown.labels)
    for (const { name, body } of head.vehicles) pen.word(origin(models.body(body)), name);
  for (const point of moment.points("contacts", ["x", "y", "z"])) pen.dot(point, "#ffb02e", 4);
  for (const { name, body } of head.vehicles) drawCurrent(pen, name, models.body(body), moment);
}

function drawTrails(pen: Pen, head: Head, player: Player, moment: Moment, since: number): void {
  const bases = head.vehicles.map(({ body }) => body);
  const objects = head.bodies.filter((each) => each.vehicle === null).map(({ name }) => name);
  for (const body of [...bases, ...objects]) {
    const now = moment.poses.get(body);
    if (!now) continue;
    const points = player.trail(body, moment.time).slice(since);
    pen.line([...points, origin(now)], "rgba(255, 214, 92, 0.9)", 1.5);
  }
}

function drawFrames(pen: Pen, head: Head, models: Models, labelled: boolean): void {
  const several = head.vehicles.length > 1;
  const owners = new Map(head.bodies.map(({ name, vehicle }) => [name, vehicle ?? ""]));
  for (const { name, body, pose } of head.frames) {
    const place = models.mounted({ body, pose });
    const length = body === null ? 1 : 0.25;
    AXES.forEach((colour, i) => {
      const tip = [0, 1, 2].map((k) => (k === i ? length : 0));
      pen.line([origin(place), transform(place, tip)], colour, 2);
    });
    const owner = several && body !== null ? `${owners.get(body)} ` : "";
    if (labelled) pen.word(origin(place), owner + name.split("/").at(-1)!);
  }
}

function drawSensor(pen: Pen, sensor: Sensor, place: Matrix, moment: Moment): void {
  const colour = "rgba(120, 220, 255, 0.8)";
  const range = moment.signal(`range/${sensor.name}`);
  if (sensor.kind === "range") {
    const reach = range ?? sensor.reach;
    const hit = transform(place, [reach, 0, 0]);
    pen.line([origin(place), hit], colour, 1.5, range === undefined ? [4, 4] : []);
    if (range !== undefined) pen.dot(hit, "#78dcff", 3);
    if (range !== undefined) pen.word(hit, `${range.toFixed(2)} m`, "#bfeeff");
    return;
  }
  const along = (angle: number): number[] =>
    sensor.kind === "fan"
      ? [0, Math.sin(angle), -Math.cos(angle)]
      : [Math.cos(angle), Math.sin(angle), 0];
  const arc = Array.from({ length: 33 }, (_, i) => {
    const angle = sensor.from + ((sensor.to - sensor.from) * i) / 32;
    return transform(place, along(angle).map((value) => value * sensor.reach));
  });
  pen.line([origin(place), ...arc, origin(place)], colour, 1);
}

function drawCurrent(pen: Pen, vehicle: string, base: Matrix, moment: Moment): void {
  const flow = ["x", "y", "z"].map((axis) => moment.signal(`water/${vehicle}/${axis}`) ?? 0);
  const speed = Math.hypot(...flow);
  if (speed < 5e-3) return;
  const from = plus(origin(base), [0, 0, 0.55]);
  const to = plus(from, flow, (0.5 + 2 * speed) / speed);
  const aside = [-flow[1] / speed, flow[0] / speed, 0];
  const back = plus(to, flow, -0.15 / speed);
  pen.line([from, to], "#5ee6d0", 2.5);
  pen.line([plus(back, aside, 0.08), to, plus(back, aside, -0.08)], "#5ee6d0", 2.5);
  pen.word(to, `current ${speed.toFixed(2)} m/s`, "#b9fff1");
}

/** Truth and estimate in a camera's image that lies in a part of the canvas. */
export function drawQuads(
  context: CanvasRenderingContext2D, camera: Camera, lens: Lens, left: number, top: number,
  moment: Moment,
): void {
  const factor = lens.fx / camera.fx;
  for (const [kind, colour, dash] of [
    ["truth", "#45f08b", []],
    ["estimate", "#ff9f43", [6, 4]],
  ] as const) {
    const points = moment.points(`${kind}/${camera.name}`, ["u", "v"]);
    if (points.length < 2) continue;
    context.strokeStyle = colour;
    context.lineWidth = 2;
    context.setLineDash([...dash]);
    context.beginPath();
    for (const [u, v] of points)
      context.lineTo(
        left + lens.cx + (u - camera.cx) * factor + 0.5, top + lens.cy + (v - camera.cy) * factor + 0.5,
      );
    context.closePath();
    context.stroke();
    context.setLineDash([]);
  }
}

