// Heaps of sand, and what a dredge takes of them, as uwsim.simulation.scenery.sand has it.
import type { Heap } from "./head";

/** A place at which sand was taken, from a frame on. */
export interface Dig {
  frame: number;
  heap: number;
  /** From the heap's corner [m]; null: all its sand is put back. */
  place: [number, number, number] | null;
}

export class Sand {
  readonly heights: Float32Array<ArrayBuffer>;
  private readonly untouched: Float32Array;
  private dug: Dig[] = [];
  private told: Float32Array | null = null;

  constructor(
    private readonly heap: Heap,
    /** Of the mesh, x y z each. */
    private readonly positions: Float32Array,
  ) {
    this.untouched = Float32Array.from(
      { length: positions.length / 3 }, (_, i) => positions[3 * i + 2] - heap.corner[2],
    );
    this.heights = this.untouched.slice();
  }

  /** Set the heights of its columns; returns whether they are others. */
  set(heights: Float32Array): boolean {
    if (heights === this.told) return false;
    this.told = heights;
    this.heights.set(heights.subarray(0, this.heights.length));
    return true;
  }

  /** Make it what digs, in order, make of it; returns whether that changed it. */
  show(digs: Dig[]): boolean {
    const isOn = digs.length >= this.dug.length && this.dug.every((dig, i) => dig === digs[i]);
    if (isOn && digs.length === this.dug.length) return false;
    if (!isOn) this.heights.set(this.untouched);
    for (const { place } of isOn ? digs.slice(this.dug.length) : digs) {
      if (place) this.take(place);
      else this.heights.set(this.untouched);
    }
    this.dug = digs;
    return true;
  }

  /** Where its vertices are, and how its surface is turned: 32767 is 1. */
  surface(): { positions: Float32Array<ArrayBuffer>; normals: Int16Array<ArrayBuffer> } {
    const { heap, heights } = this;
    const [nx, ny] = heap.columns;
    const positions = Float32Array.from(this.positions);
    const normals = new Int16Array(positions.length);
    const slope = (i: number, n: number, at: (i: number) => number): number => {
      const [low, high] = [Math.max(0, i - 1), Math.min(n - 1, i + 1)];
      return (at(high) - at(low)) / ((high - low) * heap.cell);
    };
    for (let i = 0; i < nx; ++i)
      for (let j = 0; j < ny; ++j) {
        const k = i * ny + j;
        const x = slope(i, nx, (other) => heights[other * ny + j]);
        const y = slope(j, ny, (other) => heights[i * ny + other]);
        const scale = 32767 / Math.hypot(x, y, 1);
        positions[3 * k + 2] = heap.corner[2] + heights[k];
        normals.set([-x * scale, -y * scale, scale], 3 * k);
      }
    return { positions, normals };
  }

  private take([x, y, z]: [number, number, number]): void {
    const { heap, heights } = this;
    const [nx, ny] = heap.columns;
    const reach = heap.reach ** 2;
    const range = (at: number, n: number): [number, number] => [
      Math.max(0, Math.floor((at - heap.reach) / heap.cell)),
      Math.min(n - 1, Math.ceil((at + heap.reach) / heap.cell)),
    ];
    const [[low, high], [first, last]] = [range(x, nx), range(y, ny)];
    for (let i = low; i <= high; ++i)
      for (let j = first; j <= last; ++j) {
        const k = i * ny + j;
        const away = (i * heap.cell - x) ** 2 + (j * heap.cell - y) ** 2 + (heights[k] - z) ** 2;
        if (away < reach) heights[k] = Math.max(0, heights[k] - heap.bite);
      }
  }
}
