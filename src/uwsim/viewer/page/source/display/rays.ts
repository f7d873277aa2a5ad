// Rays against the surfaces of the scene: what is below a vehicle, or between it and a viewer.
import type { Head, Visual } from "../head";
import {
  cross, dot, matrix, plus, product, transform, type Matrix, type Vector,
} from "../geometry";
import type { Pack } from "../pack";

const OPAQUE = 0.5; // opacity below which a surface hides nothing [1]

export class Rays {
  constructor(private readonly pack: Pack) {}

  /**
   * Share of the way from one point to another at which the first surface is; 1 if there is none.
   *
   * `place` returns world from body; bodies that `skips` chooses are passed through.
   */
  cast(from: Vector, to: Vector, place: (body: string) => Matrix, skips: (body: Head["bodies"][0]) => boolean): number {
    let nearest = 1;
    for (const body of this.pack.head.bodies) {
      if (!body.visuals.length || skips(body)) continue;
      const worldFromBody = place(body.name);
      for (const visual of body.visuals) {
        if (visual.hidden || visual.opacity < OPAQUE) continue;
        const meshFromWorld = inverseOf(product(worldFromBody, matrix(visual.matrix)));
        if (!meshFromWorld) continue;
        const [a, b] = [transform(meshFromWorld, from), transform(meshFromWorld, to)];
        nearest = Math.min(nearest, this.onMesh(visual, a, b, nearest));
      }
    }
    return nearest;
  }

  private onMesh(visual: Visual, from: Vector, to: Vector, nearest: number): number {
    const mesh = this.pack.head.meshes[visual.mesh];
    const along = plus(to, from, -1);
    const square = dot(along, along);
    for (const piece of mesh.pieces) {
      const centre = plus([piece[2], piece[3], piece[4]], from, -1);
      const share = square > 0 ? Math.min(nearest, Math.max(0, dot(centre, along) / square)) : 0;
      const beside = plus(centre, along, -share);
      if (dot(beside, beside) > piece[5] * piece[5]) continue;
      const positions = this.pack.numbers(mesh.positions);
      const triangles = this.pack.numbers(mesh.triangles);
      for (let i = piece[0]; i < piece[0] + piece[1]; i += 3)
        nearest = Math.min(nearest, onTriangle(positions, triangles, i, from, along));
    }
    return nearest;
  }
}

/**
 * Share of a way at which it meets a triangle (Moeller and Trumbore, 1997); Infinity: not at all.
 *
 * Written out, as it is computed for each triangle near the way and makes no garbage so.
 */
function onTriangle(
  positions: Vector, triangles: Vector, at: number, from: Vector, along: Vector,
): number {
  const [i, j, k] = [3 * triangles[at], 3 * triangles[at + 1], 3 * triangles[at + 2]];
  const [ax, ay, az] = [positions[i], positions[i + 1], positions[i + 2]];
  const [ex, ey, ez] = [positions[j] - ax, positions[j + 1] - ay, positions[j + 2] - az];
  const [fx, fy, fz] = [positions[k] - ax, positions[k + 1] - ay, positions[k + 2] - az];
  const [dx, dy, dz] = [along[0], along[1], along[2]];
  const [nx, ny, nz] = [dy * fz - dz * fy, dz * fx - dx * fz, dx * fy - dy * fx];
  const determinant = ex * nx + ey * ny + ez * nz;
  if (Math.abs(determinant) < 1e-14) return Infinity;
  const [sx, sy, sz] = [from[0] - ax, from[1] - ay, from[2] - az];
  const u = (sx * nx + sy * ny + sz * nz) / determinant;
  if (u < 0 || u > 1) return Infinity;
  const [qx, qy, qz] = [sy * ez - sz * ey, sz * ex - sx * ez, sx * ey - sy * ex];
  const v = (dx * qx + dy * qy + dz * qz) / determinant;
  if (v < 0 || u + v > 1) return Infinity;
  const share = (fx * qx + fy * qy + fz * qz) / determinant;
  return share >= 0 ? share : Infinity;
}

/** Inverse of an affine matrix with any scale; null where it has none. */
function inverseOf(m: Matrix): Matrix | null {
  const rows = [0, 1, 2].map((i) => [m[4 * i], m[4 * i + 1], m[4 * i + 2]]);
  const columns = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])];
  const determinant = dot(rows[0], columns[0]);
  if (Math.abs(determinant) < 1e-18) return null;
  const linear = [0, 1, 2].map((i) => columns.map((column) => column[i] / determinant));
  const shift = linear.map((row) => -dot(row, [m[3], m[7], m[11]]));
  return matrix([...linear.flatMap((row, i) => [...row, shift[i]]), 0, 0, 0, 1]);
}
