// The state of a scene at one time.
import type { MotionHead } from "./head";
import { fromPose, type Matrix } from "./geometry";

/** The poses of bodies (world from body) and the values of signals at one simulation time [s]. */
export class Snapshot {
  readonly poses = new Map<string, Matrix>();
  private readonly signals = new Map<string, number>();

  constructor(
    readonly time: number,
    head: MotionHead | null,
    row: ArrayLike<number> | null,
    initialPoses: Record<string, number[]> = {},
  ) {
    for (const [name, pose] of Object.entries(initialPoses)) this.poses.set(name, fromPose(pose));
    if (!head || !row) return;
    head.bodies.forEach((name, i) => this.poses.set(name, fromPose(row, 7 * i)));
    const offset = 7 * head.bodies.length;
    head.signals.forEach((signal, i) => this.signals.set(signal.name, row[offset + i]));
  }

  /** Return the value of a signal; undefined if there is no such signal, or it has no value at this time. */
  signal(name: string): number | undefined {
    const value = this.signals.get(name);
    return value === undefined || Number.isNaN(value) ? undefined : value;
  }

  /** Return the displacement and the velocity of the water that carries particles; at rest without signals. */
  drift(): { displacement: number[]; velocity: number[]; time: number } {
    const read = (name: string) => [..."xyz"].map((axis) => this.signal(`${name}/${axis}`) ?? 0);
    return { displacement: read("particles"), velocity: read("particle_velocity"), time: this.time };
  }

  /**
   * Return the points whose coordinates are the signals prefix/0/x, prefix/0/y, prefix/1/x, ...
   *
   * `parts` are the names of the coordinates. A point without values is left out.
   */
  points(prefix: string, parts: string[]): number[][] {
    const points: number[][] = [];
    for (let k = 0; ; ++k) {
      if (!this.signals.has(`${prefix}/${k}/${parts[0]}`)) return points;
      const point = parts.map((part) => this.signal(`${prefix}/${k}/${part}`));
      if (point.every((value) => value !== undefined)) points.push(point as number[]);
    }
  }
}
