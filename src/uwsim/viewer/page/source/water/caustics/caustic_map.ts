// Maps of the sun's light below the tile of short waves in several depths, as in uwsim.rendering.caustics.caustic_map.
import { Fourier, makeGrid, type ComplexGrid } from "./fft";
import type { CausticsSpec, TileWaves } from "./spec";
import { fillSpectrum } from "./tile_waves";

const MAX_EXPONENT = 30;

/** The computation of maps in some depths. */
export class CausticMapper {
  private readonly fourier: Fourier;
  private readonly slopes: ComplexGrid;
  private readonly pair: ComplexGrid; // two maps, and their spectrum
  private readonly lights: Float32Array;
  private readonly maps: Float32Array[]; // the gain of the sun's beam in each depth
  private readonly transfers: Float32Array[]; // the transfer of the blur in each depth

  constructor(
    private readonly spec: CausticsSpec,
    private readonly depths: number[],
  ) {
    const n = spec.n_nodes;
    this.fourier = new Fourier(n);
    [this.slopes, this.pair] = [makeGrid(n), makeGrid(n)];
    this.lights = new Float32Array(n * n);
    // a pair of maps is transformed at a time
    this.maps = Array.from({ length: 2 * Math.ceil(depths.length / 2) }, () => new Float32Array(n * n));
    this.transfers = this.maps.map((_, i) => computeTransfer(spec, depths[Math.min(i, depths.length - 1)]));
  }

  /** Compute the gain minus 1 in each depth at a time [s]; the next call overwrites the arrays. */
  compute(waves: TileWaves, time: number): Float32Array[] {
    const { spec, maps } = this;
    fillSpectrum(waves, spec.edge, spec.n_nodes, time, this.slopes);
    this.fourier.transform(this.slopes, 1);
    this.refractAll();
    this.depths.forEach((depth, i) => this.deposit(maps[i], (depth * spec.n_nodes) / spec.edge));
    for (let i = 0; i < maps.length; i += 2) this.blur(maps[i], maps[i + 1], this.transfers[i], this.transfers[i + 1]);
    return maps.slice(0, this.depths.length);
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

  /** Add the light of each ray to the nine nearest texels of a map; `step` is its depth in texels. */
  private deposit(map: Float32Array, step: number): void {
    const { lights, slopes } = this;
    const { reals: xs, imaginaries: ys } = slopes;
    const n = this.spec.n_nodes;
    const mask = n - 1;
    map.fill(0);
    for (let row = 0, i = 0; row < n; ++row)
      for (let column = 0; column < n; ++column, ++i) {
        const x = column + step * xs[i] + 0.5;
        const y = row + step * ys[i] + 0.5;
        const middle = Math.floor(x);
        const centre = Math.floor(y);
        const u = x - middle - 0.5;
        const v = y - centre - 0.5;
        const leftShare = 0.5 * (0.5 - u) * (0.5 - u);
        const middleShare = 0.75 - u * u;
        const rightShare = 0.5 * (0.5 + u) * (0.5 + u);
        const a = (middle - 1) & mask;
        const b = middle & mask;
        const c = (middle + 1) & mask;
        const light = lights[i];
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
  }

  /**
   * Blur two maps by even transfers, and subtract their means.
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
    reals[0] = imaginaries[0] = 0;
    fourier.transform(pair, 1);
    map0.set(reals);
    map1.set(imaginaries);
  }
}

/** Return the transfer of the blur in a depth [m], over the number of nodes. */
function computeTransfer({ edge, n_nodes: n, covariance: [xx, xy, yy], blur }: CausticsSpec, depth: number): Float32Array {
  const unit = (2 * Math.PI) / edge;
  const variance = ((blur * edge) / n) ** 2;
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
