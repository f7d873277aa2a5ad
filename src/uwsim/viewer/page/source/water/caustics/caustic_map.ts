// Maps of the sun's light below the tile of short waves in several depths, as in uwsim.rendering.caustics.caustic_map.
import { Fourier, makeGrid, type ComplexGrid } from "./fft";
import type { CausticsSpec, MapConstants, TileWaves } from "./spec";
import { fillSpectrum } from "./tile_waves";

const MAX_EXPONENT = 30;

/** Return the depths of the maps [m]: the last is that of the floor, unless contrast is lost above it. */
export function findDepths(
  { min_depth, few_slices, many_slices, max_ratio, max_depth, least_floor_depth, depth_step }: MapConstants,
  lostDepth: number, floorDepth: number,
): number[] {
  const floor = Math.ceil(Math.min(floorDepth, max_depth) / depth_step - 1e-6) * depth_step;
  const depth = Math.min(lostDepth, Math.max(floor, least_floor_depth));
  const n = depth <= min_depth * max_ratio ** (few_slices - 1) ? few_slices : many_slices;
  return Array.from({ length: n }, (_, i) => min_depth * (depth / min_depth) ** (i / (n - 1)));
}

/** The computation of maps in some depths. */
export class CausticMapper {
  private readonly fourier: Fourier;
  private readonly slopes: ComplexGrid;
  private readonly pair: ComplexGrid; // two maps, and their spectrum
  private readonly lights: Float32Array;
  private readonly traces: Float32Array; // of the derivatives of the drift by the node
  private readonly squares: Float32Array; // the sums of their squares
  private readonly maps: Float32Array[]; // the gain of the sun's beam in each depth
  private readonly blurs: number[]; // the standard deviation of the blur in each depth [texels]
  private readonly transfers = new Map<number, Float32Array>(); // the transfer of the blur by the number of the map

  constructor(
    private readonly spec: CausticsSpec,
    private readonly depths: number[],
  ) {
    const n = spec.n_nodes;
    const [xx, , yy] = spec.covariance;
    const blur = (Math.sqrt(0.5 * (xx + yy)) * n) / spec.edge;
    this.fourier = new Fourier(n);
    [this.slopes, this.pair] = [makeGrid(n), makeGrid(n)];
    [this.lights, this.traces, this.squares] = [0, 1, 2].map(() => new Float32Array(n * n));
    this.maps = depths.map(() => new Float32Array(n * n));
    this.blurs = depths.map((depth) => depth * blur);
    this.blurs.forEach((deviation, i) => {
      if (deviation >= spec.maps.least_blur) this.transfers.set(i, computeTransfer(spec, depths[i]));
    });
  }

  /** Compute the gain minus 1 in each depth at a time [s]; the next call overwrites the arrays. */
  compute(waves: TileWaves, time: number): Float32Array[] {
    const { spec, maps, transfers } = this;
    fillSpectrum(waves, spec.edge, spec.n_nodes, time, this.slopes);
    this.fourier.transform(this.slopes, 1);
    this.refractAll();
    this.computeSpreads();
    const { max_spread, smooth_blur } = spec.maps;
    this.depths.forEach((depth, i) => {
      const maxSpread = this.blurs[i] < smooth_blur ? max_spread : Infinity;
      this.deposit(maps[i], (depth * spec.n_nodes) / spec.edge, maxSpread);
    });
    const indices = [...transfers.keys()];
    for (let i = 0; i < indices.length; i += 2) {
      const [a, b] = [indices[i], indices[Math.min(i + 1, indices.length - 1)]];
      this.blur(maps[a], maps[b], transfers.get(a)!, transfers.get(b)!);
    }
    for (const map of maps) for (let i = 0; i < map.length; ++i) map[i] -= 1;
    return maps;
  }

  /** Replace the slopes by the drift against that below a level surface, and compute the light of each ray. */
  private refractAll(): void {
    const { reals: xs, imaginaries: ys } = this.slopes;
    const { lights } = this;
    const { sun: [sunX, sunY, sunZ], drift: [driftX, driftY], index } = this.spec;
    let total = 0;
    for (let i = 0; i < lights.length; ++i) {
      const [x, y] = [xs[i], ys[i]];
      const scale = 1 / Math.sqrt(1 + x * x + y * y);
      const area = Math.max(sunZ - sunX * x - sunY * y, 0);
      const cosine = area * scale;
      const refractedCosine = Math.sqrt(1 - (1 - cosine * cosine) / (index * index));
      const alongNormal = (cosine / index - refractedCosine) * scale;
      const down = 1 / (sunZ / index - alongNormal);
      const s = (cosine - index * refractedCosine) / (cosine + index * refractedCosine);
      const p = (refractedCosine - index * cosine) / (refractedCosine + index * cosine);
      xs[i] = (-sunX / index - alongNormal * x) * down - driftX;
      ys[i] = (-sunY / index - alongNormal * y) * down - driftY;
      lights[i] = area * (2 - s * s - p * p);
      total += lights[i];
    }
    const factor = lights.length / total;
    for (let i = 0; i < lights.length; ++i) lights[i] *= factor;
  }

  /** Compute the traces and the sums of squares of the derivatives of the drift by the node. */
  private computeSpreads(): void {
    const { traces, squares, slopes } = this;
    const { reals: xs, imaginaries: ys } = slopes;
    const n = this.spec.n_nodes;
    const mask = n - 1;
    for (let row = 0, i = 0; row < n; ++row) {
      const rowBefore = ((row - 1) & mask) * n;
      const rowAfter = ((row + 1) & mask) * n;
      for (let column = 0; column < n; ++column, ++i) {
        const left = row * n + ((column - 1) & mask);
        const right = row * n + ((column + 1) & mask);
        const xx = 0.5 * (xs[right] - xs[left]);
        const yx = 0.5 * (ys[right] - ys[left]);
        const xy = 0.5 * (xs[rowAfter + column] - xs[rowBefore + column]);
        const yy = 0.5 * (ys[rowAfter + column] - ys[rowBefore + column]);
        traces[i] = xx + yy;
        squares[i] = xx * xx + yx * yx + xy * xy + yy * yy;
      }
    }
  }

  /** Add the light of each ray to a map, whose depth is `step` in texels; rays that spread are split. */
  private deposit(map: Float32Array, step: number, maxSpread: number): void {
    const { lights, traces, squares, slopes } = this;
    const { reals: xs, imaginaries: ys } = slopes;
    const n = this.spec.n_nodes;
    map.fill(0);
    for (let row = 0, i = 0; row < n; ++row)
      for (let column = 0; column < n; ++column, ++i) {
        const x = column + step * xs[i];
        const y = row + step * ys[i];
        if (2 + step * (2 * traces[i] + step * squares[i]) < maxSpread) addSpline(map, n, x, y, lights[i]);
        else this.addTents(map, step, row, column, x, y);
      }
  }

  /** Add a quarter of a ray's light in each quarter of a parallelogram, to the four nearest texels. */
  private addTents(map: Float32Array, step: number, row: number, column: number, x: number, y: number): void {
    const { reals: xs, imaginaries: ys } = this.slopes;
    const n = this.spec.n_nodes;
    const mask = n - 1;
    const left = row * n + ((column - 1) & mask);
    const right = row * n + ((column + 1) & mask);
    const lower = ((row - 1) & mask) * n + column;
    const upper = ((row + 1) & mask) * n + column;
    const xx = 1 + 0.5 * step * (xs[right] - xs[left]);
    const yx = 0.5 * step * (ys[right] - ys[left]);
    const xy = 0.5 * step * (xs[upper] - xs[lower]);
    const yy = 1 + 0.5 * step * (ys[upper] - ys[lower]);
    const light = 0.25 * this.lights[row * n + column];
    for (let part = 0; part < 4; ++part) {
      const a = part & 1 ? 0.25 : -0.25;
      const b = part & 2 ? 0.25 : -0.25;
      const partX = x + a * xx + b * xy;
      const partY = y + a * yx + b * yy;
      const first = Math.floor(partX);
      const low = Math.floor(partY);
      const u = partX - first;
      const v = partY - low;
      const lowRow = (low & mask) * n;
      const highRow = ((low + 1) & mask) * n;
      const second = (first + 1) & mask;
      map[lowRow + (first & mask)] += light * (1 - v) * (1 - u);
      map[lowRow + second] += light * (1 - v) * u;
      map[highRow + (first & mask)] += light * v * (1 - u);
      map[highRow + second] += light * v * u;
    }
  }

  /**
   * Blur two maps by even transfers, or one that is given twice.
   *
   * With the spectrum Z of map 0 + i map 1, that of the result is (t0 + t1) Z(k) / 2 + (t0 - t1) Z*(-k) / 2.
   */
  private blur(map0: Float32Array, map1: Float32Array, transfer0: Float32Array, transfer1: Float32Array): void {
    const { pair, fourier } = this;
    const { reals, imaginaries } = pair;
    const { n } = fourier;
    const mask = n - 1;
    reals.set(map0);
    imaginaries.set(map1);
    fourier.transform(pair, -1);
    for (let row = 0; row < n; ++row)
      for (let column = 0; column < n; ++column) {
        const i = row * n + column;
        const j = (-row & mask) * n + (-column & mask);
        if (j < i) continue;
        const sum = 0.5 * (transfer0[i] + transfer1[i]);
        const difference = 0.5 * (transfer0[i] - transfer1[i]);
        const [x0, y0, x1, y1] = [reals[i], imaginaries[i], reals[j], imaginaries[j]];
        reals[i] = sum * x0 + difference * x1;
        imaginaries[i] = sum * y0 - difference * y1;
        reals[j] = sum * x1 + difference * x0;
        imaginaries[j] = sum * y1 - difference * y0;
      }
    fourier.transform(pair, 1);
    map0.set(reals);
    map1.set(imaginaries);
  }
}

/** Return the transfer of the blur in a depth [m], over the number of nodes. */
function computeTransfer({ edge, n_nodes: n, covariance: [xx, xy, yy], maps }: CausticsSpec, depth: number): Float32Array {
  const unit = (2 * Math.PI) / edge;
  const variance = ((maps.map_blur * edge) / n) ** 2;
  const transfer = new Float32Array(n * n);
  for (let row = 0; row < n; ++row)
    for (let column = 0; column < n; ++column) {
      const [kx, ky] = [column, row].map((i) => unit * (i < n / 2 ? i : i - n));
      const form = xx * kx * kx + 2 * xy * kx * ky + yy * ky * ky;
      const exponent = 0.5 * (depth * depth * form + variance * (kx * kx + ky * ky));
      transfer[row * n + column] = Math.exp(-Math.min(exponent, MAX_EXPONENT)) / (n * n);
    }
  return transfer;
}

/** Add light to the nine nearest texels of a map by a quadratic spline. */
function addSpline(map: Float32Array, n: number, x: number, y: number, light: number): void {
  const mask = n - 1;
  const middle = Math.floor(x + 0.5);
  const centre = Math.floor(y + 0.5);
  const u = x - middle;
  const v = y - centre;
  const leftShare = 0.5 * (0.5 - u) * (0.5 - u);
  const middleShare = 0.75 - u * u;
  const rightShare = 0.5 * (0.5 + u) * (0.5 + u);
  const a = (middle - 1) & mask;
  const b = middle & mask;
  const c = (middle + 1) & mask;
  let share = light * 0.5 * (0.5 - v) * (0.5 - v);
  let first = ((centre - 1) & mask) * n;
  map[first + a] += share * leftShare;
  map[first + b] += share * middleShare;
  map[first + c] += share * rightShare;
  share = light * (0.75 - v * v);
  first = (centre & mask) * n;
  map[first + a] += share * leftShare;
  map[first + b] += share * middleShare;
  map[first + c] += share * rightShare;
  share = light * 0.5 * (0.5 + v) * (0.5 + v);
  first = ((centre + 1) & mask) * n;
  map[first + a] += share * leftShare;
  map[first + b] += share * middleShare;
  map[first + c] += share * rightShare;
}
