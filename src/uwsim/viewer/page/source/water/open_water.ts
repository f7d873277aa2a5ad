// The radiance of open water over an image, as in uwsim.rendering.physical.daylight_field and open_water_map.
import type { Optics } from "./medium";
import { dot, rotate, unit, type Intrinsics, type Matrix } from "../geometry";

/** The numbers of columns and rows of the map. */
export const MAP_SIZE = [41, 31];
const WINDOW_COSINE = Math.sqrt(1 - 1 / 1.34 ** 2); // cosine at the rim of Snell's window
const WINDOW_SOFTNESS = 0.05; // half width of that rim, as a cosine
const HEMISPHERE_WIDTH = 0.1; // squared width of the change of scattered light at the horizon, as a cosine
const POLARISATION = 0.84; // at 90 degrees, of light that molecules scatter
const MAX_EXPONENT = 60;
const MAX_LENGTH = 1e9; // greatest way of light [m]

/** Return the radiance of open water at the points of a grid over the image, RGB and an unused number each. */
export function openWaterMap(
  optics: Optics, worldFromCamera: Matrix, intrinsics: Intrinsics, depth: number, lightRate: number,
  hasSurface: boolean,
): Float32Array<ArrayBuffer> {
  const [columns, rows] = MAP_SIZE;
  const values = new Float32Array(4 * columns * rows);
  const { fx, fy, cx, cy, skew, width, height } = intrinsics;
  const radiance = radianceAt(optics, Math.max(depth, 0), lightRate, hasSurface);
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const y = -((height * row) / (rows - 1) - 0.5 - cy) / fy;
      const x = ((width * column) / (columns - 1) - 0.5 - cx - skew * y) / fx;
      values.set(radiance(rotate(worldFromCamera, unit([x, y, -1]))), 4 * (columns * row + column));
    }
  return values;
}

/**
 * Return the function from a unit direction in W to the radiance of open water, for a camera's depth [m].
 *
 * `hasSurface`: true if the surface is drawn; else a level one is part of the open water.
 */
export function radianceAt(
  optics: Optics, depth: number, rate: number, hasSurface: boolean,
): (direction: number[]) => number[] {
  const { sun, open_water: water } = optics;
  const total = optics.total.map((value, i) => value * Math.exp(-optics.loss[i] * depth));
  const beam = optics.beam.map((value, i) => Math.min(value * Math.exp(-optics.beam_loss[i] * depth), total[i]));
  return (direction) => {
    const up = direction[2];
    const length = up > 0 ? Math.min(depth / Math.max(up, 1e-6), MAX_LENGTH) : MAX_LENGTH;
    const cosine = dot(direction, sun);
    const phase = henyeyGreenstein(water.asymmetry, cosine);
    const molecularPhase = (3 * (1 + POLARISATION * cosine * cosine)) / (4 * Math.PI * (3 + POLARISATION));
    const upper = 0.5 + ((0.5 - water.backscatter) * up) / Math.sqrt(up * up + HEMISPHERE_WIDTH);
    return [0, 1, 2].map((i) => {
      const attenuation = water.attenuation[i];
      const scattering = water.scattering[i];
      const molecules = water.molecules[i];
      const sunlight =
        beam[i] * (Math.PI / sun[2]) * (scattering * phase + molecules * molecularPhase) * integrate(attenuation * (1 - up / sun[2]), length);
      const upward = optics.reflectance[i] * total[i];
      const diffuse = total[i] - beam[i];
      const skylight =
        (scattering * (upper * diffuse + (1 - upper) * upward) + 0.5 * molecules * (diffuse + upward)) *
        integrate(attenuation - optics.loss[i] * up, length);
      const surface =
        up > 0 && !hasSurface ? surfaceRadiance(optics, i, up) * Math.exp(-Math.min(attenuation * length, 700)) : 0;
      return rate * (sunlight + skylight + surface);
    });
  };
}

/** Return the radiance of the surface from below in a channel: the sky in Snell's window, else a mirror. */
function surfaceRadiance(optics: Optics, channel: number, up: number): number {
  const x = Math.min(Math.max((up - WINDOW_COSINE) / (2 * WINDOW_SOFTNESS) + 0.5, 0), 1);
  const share = x * x * (3 - 2 * x);
  return share * optics.open_water.window + (1 - share) * optics.reflectance[channel] * optics.total[channel];
}

function henyeyGreenstein(asymmetry: number, cosine: number): number {
  const g = asymmetry;
  const root = Math.sqrt(1 + g * g - 2 * g * Math.min(Math.max(cosine, -1), 1));
  return (1 - g * g) / (4 * Math.PI * root ** 3);
}

/** Return the integral of exp(-rate t) for t from 0 to a length. */
function integrate(rate: number, length: number): number {
  const x = Math.min(Math.max(rate * length, -MAX_EXPONENT), MAX_EXPONENT);
  return Math.abs(x) < 1e-4 ? length * (1 - x / 2) : (1 - Math.exp(-x)) / rate;
}
