// The radiance of the sky, and of the open water below the surface, as in uwsim.rendering.surface.sky and hemispheres.
import { dot } from "../../geometry";
import type { Optics } from "../medium";
import { radianceAt } from "../open_water";
import type { SkySpec } from "./spec";

/** The width and height of a hemisphere [px]. */
export const HEMISPHERE_SIZE = 128;
const CLEAR_SKY = [-1, -0.32, 10, -3, 0.45]; // the coefficients a to e of the CIE sky of type 12
const OVERCAST_SKY = [4, -0.7]; // the coefficients a and b of the CIE sky of type 1
const [ZENITH_MIRED, HORIZON_MIRED] = [50, 154]; // inverse colour temperatures of a clear sky [1e6/K]
const LUMINANCE = [0.2126, 0.7152, 0.0722];
const SRGB_FROM_XYZ = [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.204, 1.057]];
const MIN_COSINE = 0.01;

/** Return the radiance of the sky by upward, then of open water by downward directions, RGB and an unused number each. */
export function hemispheres(optics: Optics, sky: SkySpec, lightRate: number): Float32Array<ArrayBuffer> {
  const size = HEMISPHERE_SIZE;
  const values = new Float32Array(2 * 4 * size * size);
  const water = radianceAt(optics, 0, lightRate, true);
  for (let row = 0; row < size; ++row)
    for (let column = 0; column < size; ++column) {
      const [x, y] = [column, row].map((i) => (2 * i) / (size - 1) - 1);
      const radius = Math.hypot(x, y);
      const square = Math.min(radius * radius, 1);
      const factor = 2 / (1 + square) / Math.max(radius, 1);
      const direction = [factor * x, factor * y, (1 - square) / (1 + square)];
      const offset = 4 * (size * row + column);
      values.set(skyRadiance(sky, direction).map((value) => lightRate * value), offset);
      values.set(water([direction[0], direction[1], -direction[2]]), 4 * size * size + offset);
    }
  return values;
}

function skyRadiance(sky: SkySpec, direction: number[]): number[] {
  const cosine = Math.max(direction[2], MIN_COSINE);
  const sunCosine = Math.min(Math.max(dot(direction, sky.sun), -1), 1);
  const [a, b, c, d, e] = CLEAR_SKY;
  const gradation = 1 + a * Math.exp(b / cosine);
  const indicatrix =
    1 + c * (Math.exp(d * Math.acos(sunCosine)) - Math.exp((d * Math.PI) / 2)) + e * sunCosine * sunCosine;
  const clearSky = sky.clear * gradation * indicatrix;
  const overcastSky = sky.overcast * (1 + OVERCAST_SKY[0] * Math.exp(OVERCAST_SKY[1] / cosine));
  return hueOf(HORIZON_MIRED + (ZENITH_MIRED - HORIZON_MIRED) * Math.sqrt(cosine)).map(
    (value) => clearSky * value + overcastSky,
  );
}

/** Return linear sRGB of CIE daylight with the luminance 1, for 1e6 over the temperature. */
function hueOf(inverseTemperature: number): number[] {
  const t = inverseTemperature * 1e-3;
  const warmX = 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.607));
  const coldX = 0.23704 + t * (0.24748 + t * (1.9018 - t * 2.0064));
  const x = inverseTemperature > 1e6 / 7000 ? warmX : coldX;
  const y = -3 * x * x + 2.87 * x - 0.275;
  const hue = SRGB_FROM_XYZ.map((row) => Math.max(dot(row, [x / y, 1, (1 - x - y) / y]), 0));
  const luminance = dot(hue, LUMINANCE);
  return hue.map((value) => value / luminance);
}
