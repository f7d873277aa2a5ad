// The weights of sharp light and of the levels of blur over the range, as in uwsim.rendering.physical.blur_weights.
import type { BlurPlan } from "./blur_plan";
import type { Optics } from "./medium";

const N_RANGES = 128; // number of ranges of the weights
/** The number of ranges of a table: those of the weights, and one between two of them. */
export const N_SHARES = 2 * N_RANGES - 1;
const N_FREQUENCIES = 36;
const LOWEST_FREQUENCY = 0.5; // [cycles/rad]
const FIELD_WEIGHT = 1000; // weight of the whole field against one frequency
const REGULARISATION = 1e-9;

/** Return the shares of light as RGB and an unused number for each range of a row; row 0: sharp and direct light, row 1 + i: level i. */
export function weightTable(optics: Optics, plan: BlurPlan, nRows: number): Float32Array<ArrayBuffer> {
  const table = new Float32Array(4 * nRows * N_SHARES);
  const step = Math.log(plan.highestFrequency / LOWEST_FREQUENCY) / (N_FREQUENCIES - 1);
  const frequencies = Array.from({ length: N_FREQUENCIES }, (_, i) => LOWEST_FREQUENCY * Math.exp(i * step));
  const transforms = frequencies.map((frequency) => transformAt(optics, frequency));
  const levels = [0, ...plan.deviations].map((deviation) =>
    frequencies.map((frequency) => Math.exp(-2 * (Math.PI * frequency * deviation) ** 2)),
  );
  for (let i = 0; i < N_RANGES; ++i) {
    const share = i / (N_RANGES - 1);
    const range = (optics.scale * share) / Math.max(1 - share, 1e-6);
    for (let channel = 0; channel < 3; ++channel) {
      const [a, b] = [optics.absorption[channel], optics.scattering[channel]];
      const wideLoss = optics.field[0] + optics.field[1] * Math.sqrt(a * range);
      const [directLight, field] = [Math.exp(-(a + b) * range), Math.exp(-range * a - wideLoss * b * range)];
      if (!(field - directLight > 1e-9)) continue;
      const transfers = transforms.map((transform) => {
        const wideShare = (transform / optics.forward) ** 12;
        return Math.exp(range * (b * (transform - (wideLoss - (1 - optics.forward)) * wideShare) - (a + b)));
      });
      const weights = fitWeights(levels, transfers, directLight, field);
      weights.forEach((weight, row) => (table[4 * (N_SHARES * row + 2 * i) + channel] = weight));
    }
  }
  for (let row = 0; row < nRows; ++row)
    for (let place = 4 * N_SHARES * row + 4; place < 4 * N_SHARES * (row + 1); place += 8)
      for (let channel = 0; channel < 3; ++channel)
        table[place + channel] = (table[place + channel - 4] + table[place + channel + 4]) / 2;
  for (let i = 0; i < N_SHARES; ++i) {
    const share = i / (N_SHARES - 1);
    const range = (optics.scale * share) / Math.max(1 - share, 1e-6);
    for (let channel = 0; channel < 3; ++channel)
      table[4 * i + channel] += Math.exp(-(optics.absorption[channel] + optics.scattering[channel]) * range);
  }
  return table;
}

/** Return the transform Q of single scattering at a frequency [cycles/rad], from its table at equal ratios. */
function transformAt({ transform }: Optics, frequency: number): number {
  const { values, min_frequency, max_frequency } = transform;
  const place = (Math.log(frequency / min_frequency) / Math.log(max_frequency / min_frequency)) * (values.length - 1);
  const i = Math.min(Math.max(Math.floor(place), 0), values.length - 2);
  return values[i] + (place - i) * (values[i + 1] - values[i]);
}

/** Fit the weights of the levels, 0 or more, to the modulation transfer of the water at one range. */
function fitWeights(levels: number[][], transfers: number[], directLight: number, field: number): number[] {
  const columns = levels.map((level) => [...level.map((value, i) => value / transfers[i]), FIELD_WEIGHT / field]);
  const targets = [
    ...transfers.map((transfer) => (transfer - directLight) / transfer), (FIELD_WEIGHT * (field - directLight)) / field,
  ];
  const product = (a: number[], b: number[]) => a.reduce((sum, value, i) => sum + value * b[i], 0);
  const right = columns.map((column) => product(column, targets));
  const normal = columns.map((a, i) => columns.map((b, j) => product(a, b) * (i === j ? 1 + REGULARISATION : 1)));
  const weights = levels.map(() => 0);
  let freeLevels = levels.map((_, level) => level);
  while (freeLevels.length) {
    const solution = solve(freeLevels.map((i) => [...freeLevels.map((j) => normal[i][j]), right[i]]));
    const minimum = Math.min(...solution);
    if (minimum >= 0) {
      freeLevels.forEach((level, i) => (weights[level] = solution[i]));
      break;
    }
    freeLevels = freeLevels.filter((_, i) => i !== solution.indexOf(minimum));
  }
  const total = weights.reduce((sum, weight) => sum + weight, 0);
  return total > 0 ? weights.map((weight) => (weight * (field - directLight)) / total) : weights;
}

/** Solve linear equations, whose right sides are the last column of their matrix, by elimination with pivots. */
function solve(rows: number[][]): number[] {
  const n = rows.length;
  for (let i = 0; i < n; ++i) {
    let pivot = i;
    for (let j = i + 1; j < n; ++j) if (Math.abs(rows[j][i]) > Math.abs(rows[pivot][i])) pivot = j;
    [rows[i], rows[pivot]] = [rows[pivot], rows[i]];
    for (let j = i + 1; j < n; ++j) {
      const factor = rows[j][i] / rows[i][i];
      for (let k = i; k <= n; ++k) rows[j][k] -= factor * rows[i][k];
    }
  }
  const solution = new Array<number>(n).fill(0);
  for (let i = n - 1; i >= 0; --i) {
    let rest = rows[i][n];
    for (let k = i + 1; k < n; ++k) rest -= rows[i][k] * solution[k];
    solution[i] = rest / rows[i][i];
  }
  return solution;
}
