// The head, as viewer/head.py documents it.
import type { Lens } from "./geometry";

/** An array of a pack: its first byte, how many numbers, and their type. */
export type Ref = [number, number, string];

export interface Visual {
  part: number;
  mesh: number;
  matrix: number[];
  texture: number | null;
  opacity: number;
  two_sided: boolean;
  hidden: boolean;
}

export interface Body {
  name: string;
  vehicle: string | null;
  pose: number[];
  visuals: Visual[];
}

export interface Mesh {
  positions: Ref;
  normals: Ref;
  uvs: Ref | null;
  tints: Ref;
  triangles: Ref;
  pieces: number[][];
}

export interface Mounted {
  name: string;
  body: string;
  pose: number[];
}

export interface Camera extends Mounted, Lens {
  grey: boolean;
}

export interface Lamp extends Mounted {
  half_angle: number;
  softness: number;
  colour: number[];
  intensity: number;
  shadow: boolean;
  on: boolean;
}

export interface Sensor extends Mounted {
  kind: "range" | "fan" | "sonar";
  reach: number;
  from: number;
  to: number;
}

export interface Projector extends Mounted {
  fovy: number;
  laser: boolean;
  pattern: number;
}

/** Sand over an object: a grid of columns. */
export interface Heap {
  body: string;
  mesh: number;
  columns: [number, number];
  corner: number[];
  cell: number;
  reach: number;
  bite: number;
}

/** From where one looks, and at what. */
export interface Place {
  pose: number[];
  fovy: number;
  at: number[];
}

export interface Water {
  fog: number;
  fog_colour: number[];
  colour: number[];
  attenuation: number[];
  surface_height: number;
  clip: boolean;
  light_rate: number;
  follows_light?: boolean;
  sun: string;
  shadows: boolean;
}

export interface Level {
  label: string;
  status: string;
  why: string | null;
  start: number;
  end: number;
  values: Record<string, number>;
}

export interface Curve {
  name: string;
  unit: string;
  times: Ref;
  values: Ref;
  names: string[];
  is_share: boolean;
}

export interface Trial {
  title: string;
  poses?: Record<string, number[]>;
  motion: Ref | null;
  levels: Level[];
  curves: Curve[];
}

/** Spawned by a program: lines in W. */
export interface Marker {
  name: string;
  at: number[];
  colour: string;
  lines: number[][][];
}

/** From a frame on a marker has a shape, a colour and a pose in W, or is gone. */
export type MarkerChange = [number, string] | [number, string, number, string, number[]];

export interface MotionHead {
  rate: number;
  n: number;
  start: number;
  bodies: string[];
  length: number;
  quaternion: number;
  signals: { name: string; unit: string; step: number }[];
  sand?: { n: number; grain: number };
  markers?: { shapes: number[][][][]; changes: MarkerChange[] };
}

export interface Head {
  uwsim_head: number;
  title: string;
  live: boolean;
  localized: number[];
  meshes: Mesh[];
  textures: { type: string; bytes: Ref; width: number; height: number; repeats: boolean }[];
  bodies: Body[];
  cameras: Camera[];
  lamps: Lamp[];
  projector: Projector | null;
  sensors: Sensor[];
  frames: { name: string; body: string | null; pose: number[] }[];
  vehicles: { name: string; body: string; thrusters: string[]; joints: string[] }[];
  sand: Heap[];
  view: Place;
  file_view: Place | null;
  water: Water;
  suns: Record<string, { direction: number[]; colour: number[] }>;
  ambient: number;
  specular: number;
  trials?: Trial[];
  motion?: MotionHead;
}
