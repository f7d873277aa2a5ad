// Fourier transforms of square grids of complex numbers, whose edge is a power of two.

/** A grid of complex numbers, row by row. */
export interface ComplexGrid {
  reals: Float64Array;
  imaginaries: Float64Array;
}

export function makeGrid(n: number): ComplexGrid {
  return { reals: new Float64Array(n * n), imaginaries: new Float64Array(n * n) };
}

/** Transforms of n x n grids. */
export class Fourier {
  private readonly cosines: Float64Array;
  private readonly sines: Float64Array;
  private readonly reversedIndices: number[]; // index with its bits reversedIndices

  constructor(readonly n: number) {
    this.cosines = Float64Array.from({ length: n / 2 }, (_, i) => Math.cos((2 * Math.PI * i) / n));
    this.sines = Float64Array.from({ length: n / 2 }, (_, i) => Math.sin((2 * Math.PI * i) / n));
    const nBits = Math.round(Math.log2(n));
    this.reversedIndices = Array.from({ length: n }, (_, i) => {
      let result = 0;
      for (let bit = 0; bit < nBits; ++bit) if (i & (1 << bit)) result |= 1 << (nBits - 1 - bit);
      return result;
    });
  }

  /** Replace a grid by its sums with exp(sign 2 pi i (k x + l y) / n), without a factor. */
  transform({ reals, imaginaries }: ComplexGrid, sign: 1 | -1): void {
    const { n } = this;
    for (let row = 0; row < n; ++row) this.pass(reals, imaginaries, n * row, 1, 1, sign);
    this.pass(reals, imaginaries, 0, n, n, sign);
  }

  /**
   * Transform sequences: element i of sequence j is at `first + step * i + j`.
   *
   * All `nSequences` are transformed side by side, so that memory is read in order.
   */
  private pass(
    reals: Float64Array, imaginaries: Float64Array, first: number, step: number, nSequences: number, sign: 1 | -1,
  ): void {
    const { n, reversedIndices, cosines, sines } = this;
    for (let i = 0; i < n; ++i) {
      if (reversedIndices[i] <= i) continue;
      let [a, b] = [first + step * i, first + step * reversedIndices[i]];
      for (let j = 0; j < nSequences; ++j, ++a, ++b) {
        const [x, y] = [reals[a], imaginaries[a]];
        reals[a] = reals[b];
        imaginaries[a] = imaginaries[b];
        reals[b] = x;
        imaginaries[b] = y;
      }
    }
    for (let half = 1; half < n; half *= 2) {
      const stride = n / (2 * half);
      for (let start = 0; start < n; start += 2 * half)
        for (let i = 0; i < half; ++i) {
          const cosine = cosines[i * stride];
          const sine = sign * sines[i * stride];
          let a = first + step * (start + i);
          let b = a + step * half;
          for (let j = 0; j < nSequences; ++j, ++a, ++b) {
            const x = reals[b] * cosine - imaginaries[b] * sine;
            const y = reals[b] * sine + imaginaries[b] * cosine;
            reals[b] = reals[a] - x;
            imaginaries[b] = imaginaries[a] - y;
            reals[a] += x;
            imaginaries[a] += y;
          }
        }
    }
  }
}
