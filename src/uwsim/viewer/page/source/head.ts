// Types of the head, whose format and units viewer/head.py describes.
import type { Intrinsics } from "./geometry";

/** A reference to an array of a pack: offset of its first byte, number of elements, their type. */
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

export interface Mount {
  name: string;
  body: string;
  pose: number[];
}

export interface Camera extends Mount, Intrinsics {
  grey: boolean;
}

export interface Lamp extends Mount {
  half_angle: number;
  softness: number;
  colour: number[];
  intensity: number;
  shadow: boolean;
  on: boolean;
}

export interface Sensor extends Mount {
  kind: "range" | "fan" | "sonar";
  reach: number;
  from: number;
  to: number;
}

export interface Projector extends Mount {
  fovy: number;
  laser: boolean;
  pattern: number;
}

/** A heap of sand over an object: a grid of columns. */
export interface Heap {
  body: string;
  mesh: number;
  columns: [number, number];
  corner: number[];
  cell: number;
  reach: number;
  bite: number;
}

/** A view: the pose of its camera, its vertical field of view, and the point around which it turns. */
export interface ViewSpec {
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

/** A spawned marker: lines in W. */
export interface Marker {
  name: string;
  at: number[];
  colour: string;
  lines: number[][][];
}

/** A change from a frame on: a marker is removed, or gets a shape (by index), a colour and a pose in W. */
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
  view: ViewSpec;
  file_view: ViewSpec | null;
  water: Water;
  suns: Record<string, { direction: number[]; colour: number[] }>;
  ambient: number;
  specular: number;
  trials?: Trial[];
  motion?: MotionHead;
}
