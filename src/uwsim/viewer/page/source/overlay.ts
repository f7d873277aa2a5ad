// Lines and labels over an image: frames, trails, sonar beams, contacts, currents, markers, tracked quadrangles.
import type { Camera, Head, Sensor } from "./head";
import { inverse, origin, plus, transform, type Intrinsics, type Matrix } from "./geometry";
import type { Models } from "./models";
import type { Player } from "./player";
import type { Snapshot } from "./snapshot";

/** The parts of the overlay that can be hidden. */
export interface OverlaySwitches {
  frames: boolean;
  labels: boolean;
  trails: boolean;
  sonars: boolean;
}

const AXIS_COLOURS = ["#ff5a4f", "#45d96b", "#4aa3ff"]; // colours of the x, y and z axis
const NEAR_PLANE = 0.02; // depth from which on points are drawn [m]

const LETTER_HEIGHT = 11; // [px]
const LABEL_LINES = [0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5]; // offsets at which a label is tried, in lines above its point

/** A pen that draws points and lines, whose coordinates are in W [m], into the image of a camera. */
class Pen {
  private readonly labelBoxes: number[][] = []; // left, top, right, bottom of each label [px]
  private readonly cameraFromWorld: Matrix;

  constructor(
    readonly context: CanvasRenderingContext2D,
    worldFromCamera: Matrix,
    private readonly intrinsics: Intrinsics,
  ) {
    this.cameraFromWorld = inverse(worldFromCamera);
  }

  line(points: ArrayLike<number>[], colour: string, width = 1.5, dash: number[] = []): void {
    const { context } = this;
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.beginPath();
    let lastPoint: number[] | null = null;
    for (const point of points) {
      const cameraPoint = transform(this.cameraFromWorld, point);
      if (lastPoint && (lastPoint[2] < -NEAR_PLANE || cameraPoint[2] < -NEAR_PLANE)) {
        const [a, b] = [clipLine(lastPoint, cameraPoint), clipLine(cameraPoint, lastPoint)];
        context.moveTo(...this.pixel(a));
        context.lineTo(...this.pixel(b));
      }
      lastPoint = cameraPoint;
    }
    context.stroke();
  }

  /** Return the pixel of a point in W; null if it is behind the camera. */
  project(point: ArrayLike<number>): [number, number] | null {
    const cameraPoint = transform(this.cameraFromWorld, point);
    return cameraPoint[2] < -NEAR_PLANE ? this.pixel(cameraPoint) : null;
  }

  /** Draw a text next to a point, unless it would cover other labels at all offsets. */
  label(point: ArrayLike<number>, text: string, colour = "#ffffff"): void {
    const position = this.project(point);
    if (!position) return;
    const { context } = this;
    context.font = `${LETTER_HEIGHT}px system-ui, sans-serif`;
    const spot = this.findSpot(position, context.measureText(text).width);
    if (!spot) return;
    const [x, y] = spot;
    if (Math.abs(y - position[1]) > 2 * LETTER_HEIGHT) this.drawLeader(position, [x - 2, y - LETTER_HEIGHT / 3], colour);
    context.lineWidth = 3;
    context.setLineDash([]);
    context.strokeStyle = "rgba(0, 12, 24, 0.75)";
    context.strokeText(text, x, y);
    context.fillStyle = colour;
    context.fillText(text, x, y);
  }

  /** Return a position near a pixel at which a label covers no other label; null if there is none [px]. */
  private findSpot([x, y]: [number, number], width: number): [number, number] | null {
    for (const line of LABEL_LINES)
      for (const left of [x + 5, x - 5 - width]) {
        const base = y - 5 + line * (LETTER_HEIGHT + 3);
        const box = [left - 2, base - LETTER_HEIGHT, left + width + 2, base + 3];
        if (this.labelBoxes.some((b) => box[0] < b[2] && box[2] > b[0] && box[1] < b[3] && box[3] > b[1])) continue;
        this.labelBoxes.push(box);
        return [left, base];
      }
    return null;
  }

  /** Draw a thin line from a point to its label. */
  private drawLeader(start: [number, number], end: [number, number], colour: string): void {
    const { context } = this;
    context.strokeStyle = colour;
    context.lineWidth = 0.75;
    context.setLineDash([]);
    context.beginPath();
    context.moveTo(...start);
    context.lineTo(...end);
    context.stroke();
  }

  /** Draw a dot with a radius [px]. */
  dot(point: ArrayLike<number>, colour: string, radius: number): void {
    const position = this.project(point);
    if (!position) return;
    this.context.fillStyle = colour;
    this.context.beginPath();
    this.context.arc(position[0], position[1], radius, 0, 2 * Math.PI);
    this.context.fill();
  }

  /** Return the pixel of a point in the camera's frame (OpenGL axes). */
  private pixel([x, y, z]: number[]): [number, number] {
    const { fx, fy, cx, cy, skew } = this.intrinsics;
    return [cx + (fx * x + skew * y) / -z + 0.5, cy - (fy * y) / -z + 0.5];
  }
}

/** Return the first point of a line that is not nearer than the near plane; points in the camera's frame (OpenGL axes) [m]. */
function clipLine(start: number[], end: number[]): number[] {
  if (start[2] < -NEAR_PLANE) return start;
  const fraction = (-NEAR_PLANE - start[2]) / (end[2] - start[2]);
  return start.map((value, i) => value + fraction * (end[i] - value));
}

/** Draw the overlay of an image. */
export function drawOverlay(
  context: CanvasRenderingContext2D, worldFromCamera: Matrix, intrinsics: Intrinsics, head: Head,
  models: Models, player: Player, snapshot: Snapshot, switches: OverlaySwitches,
): void {
  const pen = new Pen(context, worldFromCamera, intrinsics);
  for (const { name, at: position, colour, lines } of player.markers(snapshot.time)) {
    for (const line of lines) pen.line(line, colour);
    if (!lines.length) pen.dot(position, colour, 3);
    if (switches.labels || !lines.length) pen.label(position, name);
  }
  if (switches.trails) drawTrails(pen, head, player, snapshot);
  if (switches.sonars)
    for (const sensor of head.sensors) drawSensor(pen, sensor, models.worldFromMount(sensor), snapshot);
  if (switches.frames) drawFrames(pen, head, models, switches.labels);
  else if (switches.labels)
    for (const { name, body } of head.vehicles) pen.label(origin(models.body(body)), name);
  for (const point of snapshot.points("contacts", ["x", "y", "z"])) pen.dot(point, "#ffb02e", 4);
  for (const { name, body } of head.vehicles) drawCurrent(pen, name, models.body(body), snapshot);
}

function drawTrails(pen: Pen, head: Head, player: Player, snapshot: Snapshot): void {
  const bases = head.vehicles.map(({ body }) => body);
  const objects = head.bodies.filter((candidate) => candidate.vehicle === null).map(({ name }) => name);
  for (const body of [...bases, ...objects]) {
    const now = snapshot.poses.get(body);
    if (!now) continue;
    const points = player.trail(body, snapshot.time);
    pen.line([...points, origin(now)], "rgba(255, 214, 92, 0.9)", 1.5);
  }
}

function drawFrames(pen: Pen, head: Head, models: Models, hasLabels: boolean): void {
  const hasSeveral = head.vehicles.length > 1;
  const owners = new Map(head.bodies.map(({ name, vehicle }) => [name, vehicle ?? ""]));
  for (const { name, body, pose } of head.frames) {
    const worldFromFrame = models.worldFromMount({ body, pose });
    const length = body === null ? 1 : 0.25;
    AXIS_COLOURS.forEach((colour, i) => {
      const tip = [0, 1, 2].map((k) => (k === i ? length : 0));
      pen.line([origin(worldFromFrame), transform(worldFromFrame, tip)], colour, 2);
    });
    const owner = hasSeveral && body !== null ? `${owners.get(body)} ` : "";
    if (hasLabels) pen.label(origin(worldFromFrame), owner + name.split("/").at(-1)!);
  }
}

/** Draw the beam of a range sensor up to the measured range, or the outline of the beams of a sonar. */
function drawSensor(pen: Pen, sensor: Sensor, worldFromSensor: Matrix, snapshot: Snapshot): void {
  const colour = "rgba(120, 220, 255, 0.8)";
  const range = snapshot.signal(`range/${sensor.name}`);
  if (sensor.kind === "range") {
    const reach = range ?? sensor.reach;
    const hit = transform(worldFromSensor, [reach, 0, 0]);
    pen.line([origin(worldFromSensor), hit], colour, 1.5, range === undefined ? [4, 4] : []);
    if (range !== undefined) pen.dot(hit, "#78dcff", 3);
    if (range !== undefined) pen.label(hit, `${range.toFixed(2)} m`, "#bfeeff");
    return;
  }
  const direction = (angle: number): number[] =>
    sensor.kind === "fan"
      ? [0, Math.sin(angle), -Math.cos(angle)]
      : [Math.cos(angle), Math.sin(angle), 0];
  const arc = Array.from({ length: 33 }, (_, i) => {
    const angle = sensor.from + ((sensor.to - sensor.from) * i) / 32;
    return transform(worldFromSensor, direction(angle).map((value) => value * sensor.reach));
  });
  pen.line([origin(worldFromSensor), ...arc, origin(worldFromSensor)], colour, 1);
}

/** Draw the velocity of the water at a vehicle as an arrow above it. */
function drawCurrent(pen: Pen, vehicle: string, base: Matrix, snapshot: Snapshot): void {
  const flow = ["x", "y", "z"].map((axis) => snapshot.signal(`water/${vehicle}/${axis}`) ?? 0);
  const speed = Math.hypot(...flow);
  if (speed < 5e-3) return;
  const start = plus(origin(base), [0, 0, 0.55]);
  const end = plus(start, flow, (0.5 + 2 * speed) / speed);
  const side = [-flow[1] / speed, flow[0] / speed, 0];
  const back = plus(end, flow, -0.15 / speed);
  pen.line([start, end], "#5ee6d0", 2.5);
  pen.line([plus(back, side, 0.08), end, plus(back, side, -0.08)], "#5ee6d0", 2.5);
  pen.label(end, `current ${speed.toFixed(2)} m/s`, "#b9fff1");
}

/** Draw the true and the estimated quadrangle of the tracked object over a camera's image at (left, top) of the canvas [px]. */
export function drawQuads(
  context: CanvasRenderingContext2D, camera: Camera, intrinsics: Intrinsics, left: number, top: number,
  snapshot: Snapshot,
): void {
  const factor = intrinsics.fx / camera.fx;
  for (const [kind, colour, dash] of [
    ["truth", "#45f08b", []],
    ["estimate", "#ff9f43", [6, 4]],
  ] as const) {
    const points = snapshot.points(`${kind}/${camera.name}`, ["u", "v"]);
    if (points.length < 2) continue;
    context.strokeStyle = colour;
    context.lineWidth = 2;
    context.setLineDash([...dash]);
    context.beginPath();
    for (const [u, v] of points)
      context.lineTo(
        left + intrinsics.cx + (u - camera.cx) * factor + 0.5, top + intrinsics.cy + (v - camera.cy) * factor + 0.5,
      );
    context.closePath();
    context.stroke();
    context.setLineDash([]);
  }
}

