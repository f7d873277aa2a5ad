// Types of the description of recorded motion and of markers; viewer/head.py documents them.

/** A marker: lines in W. */
export interface Marker {
  name: string;
  /** The position of its origin. */
  at: number[];
  /** As `#rrggbb`. */
  colour: string;
  /** Polylines of points. */
  lines: number[][][];
}

/** A change from a frame on: a marker is removed, or gets a shape (by index), a colour and a pose in W. */
export type MarkerChange = [number, string] | [number, string, number, string, number[]];

export interface MotionHead {
  /** Rows per second [Hz]. */
  rate: number;
  /** The number of rows. */
  n: number;
  /** The simulation time of the first row [s]. */
  start: number;
  /** The names of the bodies, in the order of the columns. */
  bodies: string[];
  /** The resolution of positions [m]. */
  length: number;
  /** The resolution of quaternions [1]. */
  quaternion: number;
  /** The recorded signals; `step` is the resolution in `unit`. */
  signals: { name: string; unit: string; step: number }[];
  /** The number of removals of sand, and the resolution of their positions [m]. */
  sand?: { n: number; grain: number };
  /** The number of puffs of sediment, and the resolution of each of their numbers. */
  sediment?: { n: number; steps: number[] };
  /** The shapes of markers, and the changes by frame. */
  markers?: { shapes: number[][][][]; changes: MarkerChange[] };
}
