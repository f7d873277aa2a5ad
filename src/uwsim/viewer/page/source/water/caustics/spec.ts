// Types of the numbers of caustics and light shafts in the head; viewer/caustics.py documents them.
import type { Ref } from "../../drawing/entries";
import type { Components } from "../surface/spec";

/** What a seed determines: the phases of the waves of the tile, and the waves of the scene. */
export interface FocusingWavesSpec {
  phases: Ref;
  waves: Ref | null;
}

/** The entry of a scene in the head. */
export interface CausticsSpec extends FocusingWavesSpec {
  /** The edge of the tile [m]. */
  edge: number;
  n_nodes: number;
  columns: Ref;
  rows: Ref;
  amplitudes: Ref;
  /** The unit of `amplitudes` [m]. */
  amplitude: number;
  tension: number;
  wave_lengths: [number, number];
  scale: number;
  swell: { n_points: number; spacing: number };
  sun: number[];
  drift: number[];
  matrix: number[];
  covariance: number[];
  index: number;
  maps: MapConstants;
  has_caustics: boolean;
  shafts: Record<string, string> | null;
}

/** The constants of maps; lengths are in m, blurs in texels. */
export interface MapConstants {
  min_depth: number; few_slices: number; many_slices: number; max_ratio: number; max_depth: number;
  least_floor_depth: number; depth_step: number; max_spread: number; least_blur: number; smooth_blur: number;
  map_blur: number;
}

/** The numbers of a medium in the head. */
export interface FocusingMedium {
  /** The depth of the deepest map without a floor above it [m]. */
  lost_depth: number;
  /** Those of the uniform block: `caustic_loss`, and three of `shaft_numbers`. */
  loss: number[];
  shafts: number[];
}

/** The waves of a tile: their numbers along x and y, amplitudes [m], angular frequencies [rad/s], phases [rad]. */
export interface TileWaves {
  columns: Int16Array;
  rows: Int16Array;
  amplitude: Float64Array;
  omega: Float64Array;
  phase: Float64Array;
}

/** The surface that focuses light, at a time. */
export interface FocusingSurface {
  /** The simulation time [s]. */
  time: number;
  /** The factor on the amplitudes of the waves of the scene. */
  scale: number;
  tile: TileWaves;
  waves: Components | null;
}
