// Types of the *head*: the JSON description of the scene that the page receives; viewer/head.py
// documents the format and the units. Lengths are in metres, angles in radians, positions and poses
// in W unless a comment states another frame; a pose is x y z w x y z.
import type { Material, MaterialArrays, Ref } from "./drawing/entries";
import type { Intrinsics } from "./geometry";
import type { MediumSpec } from "./water/medium";
import type { MotionHead, Marker, MarkerChange } from "./motion_head";
import type { ParticlesSpec } from "./water/particles";
import type { CausticsSpec, FocusingWavesSpec } from "./water/caustics/spec";
import type { SurfaceSpec, WavesSpec } from "./water/surface/spec";

export type { Marker, MarkerChange, MotionHead, Ref };

export interface Visual {
  /** The index of the model in the scene. */
  part: number;
  /** The index in `meshes`. */
  mesh: number;
  /** Body from mesh, 4 x 4, row by row. */
  matrix: number[];
  /** The index in `textures`; null: none. */
  texture: number | null;
  /** From 0 to 1. */
  opacity: number;
  two_sided: boolean;
  /** The properties besides the base colour; absent: none that the page needs. */
  material?: Material;
  /** True if cameras do not draw it. */
  hidden: boolean;
}

export interface Body {
  name: string;
  /** The name of its vehicle; null for an object. */
  vehicle: string | null;
  /** World from body at step 0. */
  pose: number[];
  visuals: Visual[];
}

export interface Mesh extends MaterialArrays {
  /** Vertices in the frame of the mesh [m], f4. */
  positions: Ref;
  /** Unit normals of the vertices, i2 / 32767. */
  normals: Ref;
  /** Texture coordinates, f4; null without a texture. */
  uvs: Ref | null;
  /** Colours of the vertices, 0 to 1, u2 / 65535. */
  tints: Ref;
  /** Indices of vertices, three a triangle. */
  triangles: Ref;
  /** Parts that are drawn or left out as a whole: indices, bounds, normal, texels per metre (see head.py). */
  pieces: number[][];
}

export interface Mount {
  name: string;
  /** The name of the body that carries it. */
  body: string;
  /** Body from mount. */
  pose: number[];
}

export interface Camera extends Mount, Intrinsics {
  /** True if its images have no colour. */
  grey: boolean;
}

export interface Lamp extends Mount {
  /** The half angle of the cone; pi: all directions. */
  half_angle: number;
  /** The fraction of the half angle over which the light fades towards the edge. */
  softness: number;
  /** Red, green, blue, 0 to 1. */
  colour: number[];
  /** The value of a white surface that faces the lamp at 1 m, without water [1]. */
  intensity: number;
  /** True if it casts shadows. */
  shadow: boolean;
  /** True if it is lit at step 0. */
  on: boolean;
}

export interface Sensor extends Mount {
  /** A fan is a multibeam echo sounder. */
  kind: "range" | "fan" | "sonar";
  /** The maximum range [m]. */
  reach: number;
  /** The angle of the first beam. */
  from: number;
  /** The angle of the last beam. */
  to: number;
}

export interface Projector extends Mount {
  /** The vertical field of view. */
  fovy: number;
  /** True if a laser projects the pattern, false if a lamp does. */
  laser: boolean;
  /** The index of its image in `textures`. */
  pattern: number;
}

/** A heap of sand over an object: a grid of columns. */
export interface Heap {
  /** The name of its body in `bodies`. */
  body: string;
  /** The index in `meshes`; vertex i * (n along y) + j is the top of column i, j. */
  mesh: number;
  /** The numbers of columns along x and y. */
  columns: [number, number];
  /** The corner of minimum x, y and z, from which heights are measured. */
  corner: number[];
  /** The distance between neighbouring columns. */
  cell: number;
  /** The radius in which the dredge removes sand. */
  reach: number;
  /** The height that the dredge removes from a column at a time. */
  bite: number;
}

/** A view: the pose of its camera, its vertical field of view, and the point around which it turns. */
export interface ViewSpec {
  /** World from camera. */
  pose: number[];
  /** The vertical field of view. */
  fovy: number;
  /** The point around which the view turns. */
  at: number[];
}

export interface Water {
  /** The fog density [1/m]. */
  fog: number;
  /** Red, green, blue, 0 to 1; `colour` is that of the light that the water scatters into a long ray. */
  fog_colour: number[];
  colour: number[];
  /** The attenuation of red, green and blue [1/m]. */
  attenuation: number[];
  /** z of the surface. */
  surface_height: number;
  /** True if fog depends on clip-space z, as in UWSim; false: on the distance. */
  clip: boolean;
  /** The factor by which the light is scaled [1]. */
  light_rate: number;
  /** True if `light_rate` scales the colours of water and fog, too. */
  follows_light?: boolean;
  /** The key of the sun in `suns`. */
  sun: string;
  /** True if the sun casts shadows. */
  shadows: boolean;
  /** The media of physical water, the initial one first; null or undefined: the fog law holds. */
  media?: MediumSpec[] | null;
  /** The purest physical water, which views without fog show. */
  clear?: MediumSpec | null;
  /** The nodes of a mean over a Gaussian of the deviation 1, for the blur in physical water. */
  nodes?: number[] | null;
}

export interface Level {
  label: string;
  /** The status of the row, as `ok`. */
  status: string;
  /** The reason of a status other than ok. */
  why: string | null;
  /** Simulation time [s]. */
  start: number;
  /** Simulation time [s]. */
  end: number;
  /** The swept parameters by name. */
  values: Record<string, number>;
}

export interface Curve {
  name: string;
  unit: string;
  /** Simulation times, u4 [0.1 ms]. */
  times: Ref;
  /** The samples in `unit`, f4; NaN: nothing was measured. */
  values: Ref;
  /** The names of the values 1, 2, ..., for phases; or empty. */
  names: string[];
  /** True if the values are fractions, 0 to 1. */
  is_share: boolean;
}

export interface Trial {
  title: string;
  /** World from body at step 0, where a seed or a level changes it, by name of the body. */
  poses?: Record<string, number[]>;
  /** The meshes of a body, where a seed or a level changes them, by name of the body. */
  visuals?: Record<string, Visual[]>;
  /** The waves and ripples, where a seed changes them. */
  surface?: WavesSpec;
  caustics?: FocusingWavesSpec;
  /** The bytes of its motion track, u1; null: not recorded. */
  motion: Ref | null;
  levels: Level[];
  curves: Curve[];
}

export interface Head {
  /** The version of the format. */
  uwsim_head: number;
  title: string;
  /** True if rows of motion arrive over a WebSocket. */
  live: boolean;
  /** World from L, the frame of the scene file. */
  localized: number[];
  meshes: Mesh[];
  /** Images; `repeats`: beyond the texture coordinates 0 to 1. */
  textures: { type: string; bytes: Ref; width: number; height: number; repeats: boolean; levels?: Ref[] }[];
  /** Shares of even light that rough surfaces reflect, f4, in physical water (uwsim.rendering.materials.reflectance). */
  reflectance?: Ref;
  bodies: Body[];
  cameras: Camera[];
  lamps: Lamp[];
  projector: Projector | null;
  sensors: Sensor[];
  /** Frames that can be shown; `body` null: `pose` is in W, else in the body. */
  frames: { name: string; body: string | null; pose: number[] }[];
  /** `body` is the base of the vehicle. */
  vehicles: { name: string; body: string; thrusters: string[]; joints: string[] }[];
  /** Heaps of sand over objects. */
  sand: Heap[];
  /** The initial view. */
  view: ViewSpec;
  /** The view of the scene file's camera. */
  file_view: ViewSpec | null;
  water: Water;
  /** Marine snow and bubbles in physical water; null or undefined: none. */
  particles?: ParticlesSpec | null;
  /** The water's surface in physical water; null or undefined: images do not show it. */
  surface?: SurfaceSpec | null;
  /** The caustics and light shafts in physical water; null or undefined: none. */
  caustics?: CausticsSpec | null;
  /** By name: a vector towards the sun in W, of any length, and the colour of its light, 0 to 1. */
  suns: Record<string, { direction: number[]; colour: number[] }>;
  /** The brightness of ambient light, as a fraction of a surface's colour [1]. */
  ambient: number;
  /** The brightness of the sun's specular reflection [1]. */
  specular: number;
  /** The trials of a replay. */
  trials?: Trial[];
  /** The columns of the rows of a live view. */
  motion?: MotionHead;
}
