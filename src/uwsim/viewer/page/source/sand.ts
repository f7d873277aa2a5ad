// Heaps of sand, from which a dredge removes sand, as in uwsim.simulation.scenery.sand.
import type { Heap } from "./head";

/** A removal of sand at a position. */
export interface Removal {
  /** The index of the row of the motion from which on the sand is removed. */
  row: number;
  /** The index of the heap. */
  heap: number;
  /** The position of the dredge in the heap's frame, relative to its corner [m]; null: the whole heap is restored. */
  position: [number, number, number] | null;
}

/** A heap of sand: a grid of columns with heights above the heap's corner. */
export class Sand {
  /** The present heights [m]; column (i, j) has the index i * (columns along y) + j. */
  readonly heights: Float32Array<ArrayBuffer>;
  private readonly initialHeights: Float32Array;
  private removals: Removal[] = [];
  private lastHeights: Float32Array | null = null;

  constructor(
    private readonly heap: Heap,
    /** The initial positions of the mesh's vertices, the tops of the columns, x y z each [m]. */
    private readonly positions: Float32Array,
  ) {
    this.initialHeights = Float32Array.from(
      { length: positions.length / 3 }, (_, i) => positions[3 * i + 2] - heap.corner[2],
    );
    this.heights = this.initialHeights.slice();
  }

  /** Set the heights of the columns [m]; return true if they have changed. */
  set(heights: Float32Array): boolean {
    if (heights === this.lastHeights) return false;
    this.lastHeights = heights;
    this.heights.set(heights.subarray(0, this.heights.length));
    return true;
  }

  /** Compute the heights after all removals so far, in order; return true if they have changed. */
  apply(removals: Removal[]): boolean {
    const oldRemovals = this.removals;
    const isContinuation =
      removals.length >= oldRemovals.length && oldRemovals.every((removal, i) => removal === removals[i]);
    if (isContinuation && removals.length === oldRemovals.length) return false;
    if (!isContinuation) this.heights.set(this.initialHeights);
    for (const { position } of isContinuation ? removals.slice(oldRemovals.length) : removals) {
      if (position) this.remove(position);
      else this.heights.set(this.initialHeights);
    }
    this.removals = removals;
    return true;
  }

  /** Return the positions [m] and normals (1 is stored as 32767) of the heap's vertices. */
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

  /** Lower the columns whose tops are nearer than the dredge's radius to its position [m]. */
  private remove([x, y, z]: [number, number, number]): void {
    const { heap, heights } = this;
    const [nx, ny] = heap.columns;
    const squaredRadius = heap.reach ** 2;
    const range = (position: number, n: number): [number, number] => [
      Math.max(0, Math.floor((position - heap.reach) / heap.cell)),
      Math.min(n - 1, Math.ceil((position + heap.reach) / heap.cell)),
    ];
    const [[low, high], [first, last]] = [range(x, nx), range(y, ny)];
    for (let i = low; i <= high; ++i)
      for (let j = first; j <= last; ++j) {
        const k = i * ny + j;
        const squaredDistance = (i * heap.cell - x) ** 2 + (j * heap.cell - y) ** 2 + (heights[k] - z) ** 2;
        if (squaredDistance < squaredRadius) heights[k] = Math.max(0, heights[k] - heap.bite);
      }
  }
}
