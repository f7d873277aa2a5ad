// The player of a running simulation, whose newest state arrives over a WebSocket.
import type { Head, Level, Marker } from "../head";
import { speedOf, SPEED_SPAN, TRAIL_RATE, type Player, type Samples } from "../player";
import type { Removal } from "../sand";
import { Snapshot } from "../snapshot";
import { N_COLUMNS, type Puffs } from "../water/sediment/puffs";

/** The state of a running simulation, which `live.ts` sets. */
export class Stream implements Player {
  readonly isLive = true;
  readonly start = 0;
  readonly curves: Samples[] = [];
  readonly levels: { trial: number; level: Level }[] = [];
  readonly trial = 0;
  end = 0;
  title: string;
  version = 0;
  private currentMarkers: Marker[] = [];
  /** The heights of the columns [m] of each heap that has changed, by the heap's index. */
  private readonly heights = new Map<number, Float32Array>();
  private currentPuffs: Puffs | null = null;
  private row: ArrayLike<number> | null = null;
  private readonly recentRows: { time: number; row: ArrayLike<number> }[] = []; // rows of the last SPEED_SPAN
  /** The rows since the trails were cleared or the simulation was reset, at `TRAIL_RATE` at most. */
  private readonly trails: { time: number; row: ArrayLike<number> }[] = [];

  constructor(private readonly head: Head) {
    this.title = head.title;
  }

  /** Add the newest row, of a simulation time [s]. */
  push(time: number, row: ArrayLike<number>): void {
    const lastRow = this.trails.at(-1);
    if (time === this.end) this.version += 1; // a reset during a pause
    if (time < this.end) this.trails.length = this.recentRows.length = 0;
    if (!lastRow || time - lastRow.time >= 1 / TRAIL_RATE) this.trails.push({ time, row });
    if (this.trails.length > 20000) this.trails.splice(0, 10000);
    this.recentRows.push({ time, row });
    while (this.recentRows.length > 2 && this.recentRows[1].time <= time - SPEED_SPAN) this.recentRows.shift();
    this.row = row;
    this.end = time;
  }

  speed(body: string): number | null {
    const index = this.head.motion?.bodies.indexOf(body) ?? -1;
    const [firstRow, lastRow] = [this.recentRows[0], this.recentRows.at(-1)];
    if (index < 0 || !firstRow || !lastRow || lastRow.time <= firstRow.time) return null;
    const ends = [firstRow, lastRow].map(({ row }) => [0, 1, 2].map((i) => row[7 * index + i]));
    return speedOf(ends[0], ends[1], lastRow.time - firstRow.time);
  }

  /** Add a sample to a curve. */
  sample(name: string, unit: string, time: number, value: number | null): void {
    let curve = this.curves.find((samples) => samples.name === name);
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

  snapshot(): Snapshot {
    return new Snapshot(this.end, this.head.motion ?? null, this.row);
  }

  setMarkers(markers: Marker[]): void {
    this.currentMarkers = markers;
    this.version += 1;
  }

  markers(): Marker[] {
    return this.currentMarkers;
  }

  setSand(heap: number, heights: Float32Array): void {
    this.heights.set(heap, heights);
    this.version += 1;
  }

  sand(heap: number): Removal[] | Float32Array {
    return this.heights.get(heap) ?? [];
  }

  /** Set the puffs of sediment from their time and the columns of each. */
  setPuffs([time, ...numbers]: Float64Array): void {
    const puffs = Array.from({ length: numbers.length / N_COLUMNS }, (_, i) =>
      numbers.slice(N_COLUMNS * i, N_COLUMNS * (i + 1)),
    );
    this.currentPuffs = { time, puffs };
    this.version += 1;
  }

  puffs(): Puffs | null {
    return this.currentPuffs;
  }

  trail(body: string): number[][] {
    const index = this.head.motion?.bodies.indexOf(body) ?? -1;
    if (index < 0) return [];
    return this.trails.map(({ row }) => [0, 1, 2].map((i) => row[7 * index + i]));
  }

  clearTrails(): void {
    this.trails.length = 0;
  }
}
