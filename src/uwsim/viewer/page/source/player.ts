// Players: sources of the state of the scene at a time. Here is that for a trial of a replay; players/stream.ts has the other.
import type { Level, Marker, MarkerChange } from "./head";
import { fromPose, transform } from "./geometry";
import { readMotion, type Motion, type Pack } from "./pack";
import type { Removal } from "./sand";
import { Snapshot } from "./snapshot";
import { RecordedPuffs, type Puffs } from "./water/sediment/puffs";

/** The samples of a curve. */
export interface Samples {
  name: string;
  unit: string;
  /** The simulation times [s]. */
  times: number[];
  /** The values in `unit`; null: nothing was measured. */
  values: (number | null)[];
  /** The names of the values 1, 2, ..., for example of phases. */
  names?: string[];
  /** True if the range of the values is 0 to 1. */
  isFraction?: boolean;
}

/** A source of the state of the scene. Times are simulation times [s]. */
export interface Player {
  /** True for a running simulation. */
  readonly isLive: boolean;
  readonly start: number;
  /** The end of the trial, or the present time of a running simulation. */
  readonly end: number;
  /** The curves of the measures. */
  readonly curves: Samples[];
  /** The levels of all trials, with the index of their trial. */
  readonly levels: { trial: number; level: Level }[];
  /** The index of the selected trial; -1: none yet. */
  readonly trial: number;
  title: string;
  /** A counter that is incremented when the state changes while the time does not. */
  readonly version: number;
  snapshot(time: number): Snapshot;
  /** Return the speed of the origin of a body [m/s]; null if it is not known. */
  speed(body: string, time: number): number | null;
  /** Return the positions of a body in W from the start of the trails to a time, at about `TRAIL_RATE` [m]. */
  trail(body: string, endTime: number): number[][];
  /** Begin all trails at a time. */
  clearTrails(startTime: number): void;
  /** Return the markers that exist at a time. */
  markers(time: number): Marker[];
  /** Return the removals of sand from a heap up to a time, in order, or the heights of its columns [m]. */
  sand(heap: number, time: number): Removal[] | Float32Array;
  /** Return the puffs of sediment at the last period up to a time; null: there are none. */
  puffs(time: number): Puffs | null;
  /** Select the trial with an index, and load its motion and curves. */
  select(trial: number): Promise<void>;
}

export const TRAIL_RATE = 6; // [Hz]
export const SPEED_SPAN = 0.2; // the time over which a speed is computed [s]
const MAX_SPEED = 30; // the speed above which a displacement counts as a jump [m/s]
const TICK_RATE = 1e4; // [Hz]; the times of curves are stored in ticks of 0.1 ms

/** The recorded state of the scene in the trials of a replay. */
export class Replay implements Player {
  readonly isLive = false;
  readonly levels: { trial: number; level: Level }[];
  curves: Samples[] = [];
  trial = -1;
  readonly version = 0;
  title = "";
  private motion: Motion | null = null;
  private recordedPuffs: RecordedPuffs | null = null;
  private trailStart = -Infinity; // the start of the trails [s]

  constructor(private readonly pack: Pack) {
    const trials = pack.head.trials ?? [];
    this.levels = trials.flatMap(({ levels }, trial) => levels.map((level) => ({ trial, level })));
  }

  get start(): number {
    const levels = this.levels.filter(({ trial }) => trial === this.trial);
    return Math.min(this.motion?.head.start ?? Infinity, levels[0]?.level.start ?? 0);
  }

  get end(): number {
    const levels = this.levels.filter(({ trial }) => trial === this.trial);
    return Math.max(this.motion?.end ?? 0, ...levels.map(({ level }) => level.end));
  }

  async select(trial: number): Promise<void> {
    if (trial === this.trial) return;
    const trialHead = this.pack.head.trials?.[trial];
    this.trial = trial;
    this.motion = this.recordedPuffs = null;
    this.trailStart = -Infinity;
    this.curves = [];
    if (!trialHead) return;
    this.title = trialHead.title;
    this.curves = trialHead.curves.map(({ name, unit, times, values, names, is_share }) => ({
      name, unit, names, isFraction: is_share,
      times: Array.from(this.pack.numbers(times), (tick) => tick / TICK_RATE),
      values: Array.from(this.pack.numbers(values), (v) => (Number.isNaN(v) ? null : v)),
    }));
    if (trialHead.motion)
      this.motion = await readMotion(this.pack.numbers(trialHead.motion) as Uint8Array<ArrayBuffer>);
    const sediment = this.pack.head.particles?.sediment;
    if (sediment && this.motion?.births.length)
      this.recordedPuffs = new RecordedPuffs(
        sediment, this.motion.births, (time) => this.snapshot(time).drift().velocity,
      );
  }

  snapshot(time: number): Snapshot {
    const initialPoses = this.pack.head.trials?.[this.trial]?.poses;
    return new Snapshot(time, this.motion?.head ?? null, this.motion?.row(time) ?? null, initialPoses);
  }

  speed(body: string, time: number): number | null {
    const motion = this.motion;
    const index = motion?.head.bodies.indexOf(body) ?? -1;
    if (!motion || index < 0) return null;
    const lastRow = motion.head.start + (motion.head.n - 1) / motion.head.rate;
    const endTime = Math.min(lastRow, Math.max(time, motion.head.start + SPEED_SPAN));
    const ends = [endTime - SPEED_SPAN, endTime].map((end) => [...motion.row(end).slice(7 * index, 7 * index + 3)]);
    return speedOf(ends[0], ends[1], SPEED_SPAN);
  }

  markers(time: number): Marker[] {
    const [motion, markerLog] = [this.motion, this.motion?.head.markers];
    if (!motion || !markerLog) return [];
    const row = motion.rowIndex(time);
    const changes = new Map<string, MarkerChange>();
    for (const change of markerLog.changes) {
      if (change[0] > row) break;
      if (change.length > 2) changes.set(change[1], change);
      else changes.delete(change[1]);
    }
    return [...changes.values()].map(([, name, shape, colour, pose]) => {
      const worldFromMarker = fromPose(pose!);
      const lines = markerLog.shapes[shape!].map((line) => line.map((point) => transform(worldFromMarker, point)));
      return { name, at: pose!.slice(0, 3), colour: colour!, lines };
    });
  }

  sand(heap: number, time: number): Removal[] {
    const row = this.motion?.rowIndex(time) ?? -1;
    return this.motion?.removals.filter((removal) => removal.heap === heap && removal.row <= row) ?? [];
  }

  puffs(time: number): Puffs | null {
    return this.recordedPuffs?.puffsAt(time) ?? null;
  }

  trail(body: string, endTime: number): number[][] {
    const motion = this.motion;
    const index = motion?.head.bodies.indexOf(body) ?? -1;
    if (!motion || index < 0) return [];
    const { rate, start, n } = motion.head;
    const lastRow = Math.min(n - 1, Math.floor((endTime - start) * rate));
    const points: number[][] = [];
    const firstRow = Math.max(0, Math.ceil((this.trailStart - start) * rate));
    for (let row = firstRow; row <= lastRow; row += Math.max(1, Math.round(rate / TRAIL_RATE))) {
      const offset = row * motion.columns + 7 * index;
      points.push(Array.from(motion.rows.subarray(offset, offset + 3)));
    }
    return points;
  }

  clearTrails(startTime: number): void {
    this.trailStart = startTime;
  }
}

/** Return the mean speed between two positions [m/s]; null if the displacement is a jump, such as a reset. */
export function speedOf(start: number[], end: number[], seconds: number): number | null {
  const speed = Math.hypot(...end.map((value, i) => value - start[i])) / seconds;
  return seconds > 0 && speed < MAX_SPEED ? speed : null;
}
