// What is shown when: the trials of a replay, or what a running simulation sends.
import type { Head, Level, Marker, MarkerChange, MotionHead } from "./head";
import { fromPose, transform, type Matrix } from "./geometry";
import { readMotion, type Motion, type Pack } from "./pack";
import type { Dig } from "./sand";

export interface Samples {
  name: string;
  unit: string;
  times: number[];
  values: (number | null)[];
  /** Of the values 1, 2, ..., as of phases. */
  names?: string[];
  /** Whether its range is 0 to 1. */
  isShare?: boolean;
}

/** Poses and signals at one time. */
export class Moment {
  readonly poses = new Map<string, Matrix>();
  private readonly signals = new Map<string, number>();

  constructor(
    readonly time: number,
    head: MotionHead | null,
    row: ArrayLike<number> | null,
    placed: Record<string, number[]> = {},
  ) {
    for (const [name, pose] of Object.entries(placed)) this.poses.set(name, fromPose(pose));
    if (!head || !row) return;
    head.bodies.forEach((name, i) => this.poses.set(name, fromPose(row, 7 * i)));
    const first = 7 * head.bodies.length;
    head.signals.forEach((signal, i) => this.signals.set(signal.name, row[first + i]));
  }

  /** A signal's value; undefined where there is none, or nothing was measured. */
  signal(name: string): number | undefined {
    const value = this.signals.get(name);
    return value === undefined || Number.isNaN(value) ? undefined : value;
  }

  /** Points named prefix/0/x, prefix/0/y, ...: those that are there. */
  points(prefix: string, parts: string[]): number[][] {
    const found: number[][] = [];
    for (let k = 0; ; ++k) {
      if (!this.signals.has(`${prefix}/${k}/${parts[0]}`)) return found;
      const point = parts.map((part) => this.signal(`${prefix}/${k}/${part}`));
      if (point.every((value) => value !== undefined)) found.push(point as number[]);
    }
  }
}

export interface Player {
  readonly isLive: boolean;
  readonly start: number;
  readonly end: number;
  readonly curves: Samples[];
  readonly levels: { trial: number; level: Level }[];
  readonly trial: number;
  title: string;
  /** Grows when something came that no time says. */
  readonly version: number;
  moment(time: number): Moment;
  /** How fast the origin of a body moves [m/s]; null where it is not known. */
  speed(body: string, time: number): number | null;
  /** Where a body was, from the beginning until a time, a few times a second. */
  trail(body: string, until: number): number[][];
  /** What programs have spawned by a time. */
  markers(time: number): Marker[];
  /** Where sand of a heap had been taken by a time, in order, or the heights of its columns. */
  sand(heap: number, time: number): Dig[] | Float32Array;
  select(trial: number): Promise<void>;
}

const TRAIL_RATE = 6; // [Hz]
const SPAN = 0.2; // over which a speed is taken [s]
const FASTEST = 30; // [m/s]
const TICKS = 1e4; // of the times of curves, in a second

export class Replay implements Player {
  readonly isLive = false;
  readonly levels: { trial: number; level: Level }[];
  curves: Samples[] = [];
  trial = -1;
  readonly version = 0;
  title = "";
  private motion: Motion | null = null;

  constructor(private readonly pack: Pack) {
    const trials = pack.head.trials ?? [];
    this.levels = trials.flatMap(({ levels }, trial) => levels.map((level) => ({ trial, level })));
  }

  get start(): number {
    const own = this.levels.filter(({ trial }) => trial === this.trial);
    return Math.min(this.motion?.head.start ?? Infinity, own[0]?.level.start ?? 0);
  }

  get end(): number {
    const own = this.levels.filter(({ trial }) => trial === this.trial);
    return Math.max(this.motion?.end ?? 0, ...own.map(({ level }) => level.end));
  }

  async select(trial: number): Promise<void> {
    if (trial === this.trial) return;
    const chosen = this.pack.head.trials?.[trial];
    this.trial = trial;
    this.motion = null;
    this.curves = [];
    if (!chosen) return;
    this.title = chosen.title;
    this.curves = chosen.curves.map(({ name, unit, times, values, names, is_share }) => ({
      name,
      unit,
      names,
      isShare: is_share,
      times: Array.from(this.pack.numbers(times), (tick) => tick / TICKS),
      values: Array.from(this.pack.numbers(values), (v) => (Number.isNaN(v) ? null : v)),
    }));
    if (chosen.motion)
      this.motion = await readMotion(this.pack.numbers(chosen.motion) as Uint8Array<ArrayBuffer>);
  }

  moment(time: number): Moment {
    const placed = this.pack.head.trials?.[this.trial]?.poses;
    return new Moment(time, this.motion?.head ?? null, this.motion?.at(time) ?? null, placed);
  }

  speed(body: string, time: number): number | null {
    const motion = this.motion;
    const index = motion?.head.bodies.indexOf(body) ?? -1;
    if (!motion || index < 0) return null;
    const last = motion.head.start + (motion.head.n - 1) / motion.head.rate;
    const until = Math.min(last, Math.max(time, motion.head.start + SPAN));
    const ends = [until - SPAN, until].map((each) => Array.from(motion.at(each)!.slice(7 * index, 7 * index + 3)));
    return speedOf(ends[0], ends[1], SPAN);
  }

  markers(time: number): Marker[] {
    const [motion, spawned] = [this.motion, this.motion?.head.markers];
    if (!motion || !spawned) return [];
    const frame = motion.frame(time);
    const there = new Map<string, MarkerChange>();
    for (const change of spawned.changes) {
      if (change[0] > frame) break;
      if (change.length > 2) there.set(change[1], change);
      else there.delete(change[1]);
    }
    return [...there.values()].map(([, name, shape, colour, pose]) => {
      const place = fromPose(pose!);
      const lines = spawned.shapes[shape!].map((line) => line.map((point) => transform(place, point)));
      return { name, at: pose!.slice(0, 3), colour: colour!, lines };
    });
  }

  sand(heap: number, time: number): Dig[] {
    const frame = this.motion?.frame(time) ?? -1;
    return this.motion?.digs.filter((dig) => dig.heap === heap && dig.frame <= frame) ?? [];
  }

  trail(body: string, until: number): number[][] {
    const motion = this.motion;
    const index = motion?.head.bodies.indexOf(body) ?? -1;
    if (!motion || index < 0) return [];
    const { rate, start, n } = motion.head;
    const last = Math.min(n - 1, Math.floor((until - start) * rate));
    const points: number[][] = [];
    for (let row = 0; row <= last; row += Math.max(1, Math.round(rate / TRAIL_RATE))) {
      const at = row * motion.columns + 7 * index;
      points.push(Array.from(motion.rows.subarray(at, at + 3)));
    }
    return points;
  }
}

/** Speed between two places; null where something was put elsewhere. */
function speedOf(from: number[], to: number[], seconds: number): number | null {
  const speed = Math.hypot(...to.map((value, i) => value - from[i])) / seconds;
  return seconds > 0 && speed < FASTEST ? speed : null;
}

/** Places and curves while a simulation runs; `live.ts` fills it. */
export class Stream implements Player {
  readonly isLive = true;
  readonly start = 0;
  readonly curves: Samples[] = [];
  readonly levels: { trial: number; level: Level }[] = [];
  readonly trial = 0;
  end = 0;
  title: string;
  version = 0;
  /** Number of a heap -> heights of its columns, of those from which sand was taken. */
  private spawned: Marker[] = [];
  private readonly heights = new Map<number, Float32Array>();
  private row: ArrayLike<number> | null = null;
  private readonly recent: { time: number; row: ArrayLike<number> }[] = []; // of the last SPAN
  private readonly trails: { time: number; row: ArrayLike<number> }[] = [];

  constructor(private readonly head: Head) {
    this.title = head.title;
  }

  push(time: number, row: ArrayLike<number>): void {
    const last = this.trails.at(-1);
    if (time === this.end) this.version += 1; // as after a reset in a pause
    if (time < this.end) this.trails.length = this.recent.length = 0;
    if (!last || time - last.time >= 1 / TRAIL_RATE) this.trails.push({ time, row });
    if (this.trails.length > 20000) this.trails.splice(0, 10000);
    this.recent.push({ time, row });
    while (this.recent.length > 2 && this.recent[1].time <= time - SPAN) this.recent.shift();
    this.row = row;
    this.end = time;
  }

  speed(body: string): number | null {
    const index = this.head.motion?.bodies.indexOf(body) ?? -1;
    const [first, last] = [this.recent[0], this.recent.at(-1)];
    if (index < 0 || !first || !last || last.time <= first.time) return null;
    const ends = [first, last].map(({ row }) => [0, 1, 2].map((i) => row[7 * index + i]));
    return speedOf(ends[0], ends[1], last.time - first.time);
  }

  sample(name: string, unit: string, time: number, value: number | null): void {
    let curve = this.curves.find((each) => each.name === name);
    if (!curve) {
      curve = { name, unit, times: [], values: [] };
      this.curves.push(curve);
    }
    curve.times.push(time);
    curve.values.push(value);
  }

  setLevels(levels: Level[]): void {
    this.levels.splice(0, this.levels.length, ...levels.map((level) => ({ trial: 0, level })));
    this.version += 1;
  }

  async select(): Promise<void> {}

  moment(): Moment {
    return new Moment(this.end, this.head.motion ?? null, this.row);
  }

  spawn(markers: Marker[]): void {
    this.spawned = markers;
    this.version += 1;
  }

  markers(): Marker[] {
    return this.spawned;
  }

  dig(heap: number, heights: Float32Array): void {
    this.heights.set(heap, heights);
    this.version += 1;
  }

  sand(heap: number): Dig[] | Float32Array {
    return this.heights.get(heap) ?? [];
  }

  trail(body: string): number[][] {
    const index = this.head.motion?.bodies.indexOf(body) ?? -1;
    if (index < 0) return [];
    return this.trails.map(({ row }) => [0, 1, 2].map((i) => row[7 * index + i]));
  }
}
