// The plan of the blur of an image through physical water, as in uwsim.rendering.physical.blur_plan.
import type { Intrinsics } from "../geometry";
import type { Switches } from "../drawing/shaders";

/** The greatest number of levels. */
export const MAX_LEVELS = 8;
const MAX_DEVIATION = 0.41; // deviation of the last level [rad]
const RATIO = 2.6; // ratio of the deviations of two levels, approximately
const HIGHEST_FREQUENCY = 120; // highest frequency at which the blur is fitted [cycles/rad]
const MAX_PIXEL_FREQUENCY = 0.3; // the same [cycles/px]
const N_SQUARES = 2; // number of levels that are means of squares
const [SQUARE_VARIANCE, SMOOTH_VARIANCE] = [0.0625, 0.1875]; // variances of the two kinds of reduction [texel^2]
const INTERPOLATION_VARIANCE = 0.1875; // variance of linear interpolation to twice the resolution [texel^2]
const MAX_RADIUS = 24; // greatest radius of a Gaussian [texel]

/** The levels of the blur of a camera; without levels, all light counts as sharp. */
export interface BlurPlan {
  /** The deviation of each level [rad]. */
  deviations: number[];
  /** The parameter of the Gaussian of each level [texel]; 0: none. */
  spreads: number[];
  /** The factor on the range of each level. */
  reach: number[];
  /** The highest frequency at which the weights are fitted [cycles/rad]. */
  highestFrequency: number;
}

/** Return the plan of a camera's blur; `nodes` are those of the mean over a Gaussian of the deviation 1. */
export function planBlur(intrinsics: Intrinsics, nodes: number[], hasBlur: boolean): BlurPlan {
  const focal = Math.sqrt(intrinsics.fx * intrinsics.fy);
  const nSteps = Math.min(Math.round(Math.log(Math.max(MAX_DEVIATION * focal, 1)) / Math.log(RATIO)), MAX_LEVELS - 1);
  if (!hasBlur || nSteps < 1) return { deviations: [], spreads: [], reach: [], highestFrequency: HIGHEST_FREQUENCY };
  const ratio = (MAX_DEVIATION * focal) ** (1 / nSteps);
  const widths = Array.from({ length: nSteps + 1 }, (_, level) => ratio ** level); // [px]
  const deviations = widths.map((width) => width / focal);
  return {
    deviations,
    spreads: widths.map(spreadOf),
    reach: deviations.map((deviation) => reachOf(deviation, nodes, intrinsics)),
    highestFrequency: Math.min(HIGHEST_FREQUENCY, MAX_PIXEL_FREQUENCY * focal),
  };
}

/** Return the macros of a Gaussian with a parameter [texel]. */
export function kernelSwitches(spread: number): Switches {
  return { RADIUS: radiusOf(spread), SPREAD: Math.round(1000 * spread) };
}

function radiusOf(spread: number): number {
  return spread > 0 ? Math.min(Math.ceil(3 * spread), MAX_RADIUS) : 0;
}

/** Return the inverse of the mean of sqrt(1 + x^2 + y^2) over a Gaussian, within the image. */
function reachOf(deviation: number, nodes: number[], lens: Intrinsics): number {
  const [width, height] = [lens.width / lens.fx / 2, lens.height / lens.fy / 2];
  const squares = [width, height].map((limit) => nodes.map((node) => Math.min(deviation * node, limit) ** 2));
  let total = 0;
  for (const x of squares[0]) for (const y of squares[1]) total += Math.sqrt(1 + x + y);
  return nodes.length ** 2 / total;
}

/** Return the parameter of the Gaussian that reduction and interpolation leave to a level [texel]. */
function spreadOf(width: number, level: number): number {
  let [reduction, interpolation] = [0, 0];
  for (let i = 0; i <= level; ++i) {
    reduction = reduction / 4 + (i < N_SQUARES ? SQUARE_VARIANCE : SMOOTH_VARIANCE);
    interpolation = interpolation / 4 + INTERPOLATION_VARIANCE;
  }
  const rest = (width / 2 ** (level + 1)) ** 2 - reduction - interpolation;
  return rest > 0.01 ? parameterOf(rest) : 0;
}

/** Return the parameter of a Gaussian, sampled at whole texels, that has a variance [texel], by bisection. */
function parameterOf(variance: number): number {
  let [low, high] = [0.1, 2 * Math.sqrt(variance) + 1];
  while (high - low > 5e-4) {
    const middle = (low + high) / 2;
    let [total, moment] = [1, 0];
    for (let i = 1; i <= radiusOf(middle); ++i) {
      const weight = 2 * Math.exp((-i * i) / (2 * middle * middle));
      total += weight;
      moment += weight * i * i;
    }
    if (moment < variance * total) low = middle;
    else high = middle;
  }
  return Math.round(500 * (low + high)) / 1000;
}
