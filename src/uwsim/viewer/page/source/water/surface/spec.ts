// Types of the numbers of the moving surface in the head, and of its state at a time; viewer/surface.py documents them.
import type { Ref } from "../../drawing/entries";

/** The components of waves or ripples that a seed determines. */
export interface WavesSpec {
  waves: Ref | null;
  ripples: Ref | null;
}

/** The numbers of the sky in the head. */
export interface SkySpec {
  /** The unit vector towards the sun in W. */
  sun: number[];
  /** The irradiance of a surface that faces the sun, by the sun. */
  sunlight: number[];
  /** The irradiance of a level surface by the sky. */
  light: number[];
  /** The factors on the two distributions of radiance. */
  clear: number;
  overcast: number;
}

/** The surface of a scene in the head. */
export interface SurfaceSpec extends WavesSpec {
  /** The factor on the amplitudes of waves at step 0 [1]. */
  scale: number;
  /** The variance of the slopes of waves and ripples along an axis [1]. */
  slope_variance: number;
  /** The least variance of the slopes of ripples along an axis [1]. */
  short_wave_variance: number;
  /** True if the surface mirrors bodies on the side of the camera. */
  mirror: boolean;
  /** The attenuation of air [1/m]. */
  air: number;
  sky: SkySpec;
}

/** Sinusoidal waves in W: amplitudes [m], angular frequencies [rad/s], wave numbers along x and y [rad/m], and phases [rad]. */
export interface Components {
  amplitude: Float32Array;
  omega: Float32Array;
  kx: Float32Array;
  ky: Float32Array;
  phase: Float32Array;
}

/** The surface at a time. */
export interface MovingSurface {
  /** The simulation time [s]. */
  time: number;
  /** The factor on the amplitudes of waves [1]. */
  scale: number;
  waves: Components | null;
  ripples: Components | null;
}
