// The state that determines an image, and the uniform block Frame that follows from it, as in uwsim.rendering.frame.
import type { Head, Water } from "../head";
import { columns, origin, product, rotateBack, type Intrinsics, type Matrix } from "../geometry";
import type { Optics } from "../water/medium";
import type { Drift } from "../water/particles";
import type { FocusingSurface } from "../water/caustics/spec";
import type { Puffs } from "../water/sediment/puffs";
import type { MovingSurface } from "../water/surface/spec";
import type { ActiveLamp, Shadows } from "./light";

/** The values that determine an image, in addition to the poses of the bodies. */
export interface RenderState {
  /** The pose of the camera in W, with OpenGL axes. */
  worldFromCamera: Matrix;
  intrinsics: Intrinsics;
  water: Water;
  /** The numbers of physical water; null: the fog law holds. */
  optics: Optics | null;
  lamps: ActiveLamp[];
  /** The displacement of the water, with which particles move; null: none are drawn. */
  drift?: Drift | null;
  /** The puffs of sediment; null: none are drawn. */
  puffs?: Puffs | null;
  /** The water's surface; null: it is not drawn. */
  surface?: MovingSurface | null;
  /** The surface that focuses the sun's light; null: none does. */
  focusing?: FocusingSurface | null;
  /** True for an external view: there is air above the water, and the parts that cameras do not draw are visible. */
  isExternal: boolean;
  /** True if the image is greyscale, as the image of a greyscale camera. */
  grey?: boolean;
  /** True for the image that the simulation's renderer draws, without savings in quality. */
  isExact?: boolean;
}

/** Return the values of the uniform block Frame (frame.glsl); `sun` points towards the sun in W. */
export function frameBlockValues(
  { worldFromCamera: m, intrinsics, water, optics }: RenderState, head: Head, clip: Matrix, sun: number[], shadows: Shadows,
): Float32Array<ArrayBuffer> {
  const { near, far } = intrinsics;
  const { ambient: ambientLight, specular, suns } = head;
  const rate = water.light_rate;
  const attenuation = optics?.absorption.map((a, i) => a + optics.scattering[i]) ?? water.attenuation;
  const waterRate = water.follows_light === false ? 1 : rate;
  const [water_colour, fog_colour] = [water.colour, water.fog_colour].map((colour) =>
    colour.map((c) => waterRate * c),
  );
  const far_colour = water.fog > 0 ? fog_colour : water_colour;
  return Float32Array.from([
    ...columns(clip),
    ...columns(product(shadows.textureFromWorld, m)),
    m[8], m[9], m[10], origin(m)[2] - water.surface_height,
    ...rotateBack(m, sun), shadows.lift,
    ...suns[water.sun].colour.map((c) => rate * c), 0,
    rate * ambientLight, rate * specular, 0, 0,
    ...water_colour, 0,
    ...attenuation, 0,
    ...fog_colour, water.fog ** 2,
    (far + near) / (far - near), (-2 * far * near) / (far - near), 0, 0,
    ...far_colour, 0,
  ]);
}
