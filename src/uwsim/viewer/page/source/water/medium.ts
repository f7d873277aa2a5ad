// Types of the numbers of physical water in the head; viewer/optics.py documents them.
import type { FocusingMedium } from "./caustics/spec";

/** The numbers of a medium in the light of the scene; viewer/optics.py documents them. */
export interface Optics {
  /** Of red, green and blue [1/m], as `scattering`. */
  absorption: number[];
  scattering: number[];
  /** The ratio of full scale to radiance [1]. */
  exposure: number;
  /** The exposure of views through the purest water. */
  clear_exposure: number;
  field: [number, number];
  phase: number[];
  /** The middle range of the table of weights [m]. */
  scale: number;
  /** The share of the light that is scattered forward. */
  forward: number;
  /** The transform of single scattering at frequencies in equal ratios [cycles/rad]. */
  transform: { min_frequency: number; max_frequency: number; values: Float32Array };
  /** The unit vector towards the refracted sun in W. */
  sun: number[];
  /** The irradiance by the sun just below the surface, and its attenuation over depth [1/m]. */
  beam: number[];
  beam_loss: number[];
  /** The irradiance by sun and sky just below the surface, and its attenuation over depth [1/m]. */
  total: number[];
  loss: number[];
  /** The share of the irradiance that comes up. */
  reflectance: number[];
  /** The numbers of the light that open water scatters. */
  open_water: {
    scattering: number[]; molecules: number[]; attenuation: number[]; asymmetry: number; backscatter: number; window: number;
  };
  /** Two coefficients of the light of each lamp of the head. */
  lamps: [number, number][];
  /** The numbers of caustics and light shafts; null: none. */
  caustics: FocusingMedium | null;
  /** True if stored values are linear. */
  linear: boolean;
  /** True if light that is scattered forward blurs images. */
  blur: boolean;
  /** The share of the image that is drawn beyond each of its edges. */
  blur_margin: number;
  /** True if the water scatters the light of lamps into cameras. */
  lamp_veil: boolean;
}

/** The numbers of a medium in the head: `values` refers to an array (`Ref`). */
export type MediumSpec = Omit<Optics, "transform"> & {
  transform: { min_frequency: number; max_frequency: number; values: [number, number, string] };
};
