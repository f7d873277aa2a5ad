// Ray casting against the surfaces of the scene, for the altitude and for the chase view.
import type { Head, Visual } from "../head";
import {
  cross, dot, matrix, plus, product, transform, type Matrix, type Vector,
} from "../geometry";
import { visualsOf } from "../models";
import type { Pack } from "../pack";

const MIN_OPACITY = 0.5; // least opacity of a surface that rays hit [1]

/** Ray casts against the meshes of a pack. */
export class Rays {
  trial = 0; // the index of the selected trial

  constructor(private readonly pack: Pack) {}

  /**
   * Return the fraction of the way from `start` to `end` (in W [m]) at which the first surface is hit; 1: no surface.
   *
   * `bodyPose` returns the pose of a body in W; rays pass through bodies for which `isSkipped` returns true.
   */
  cast(start: Vector, end: Vector, bodyPose: (body: string) => Matrix, isSkipped: (body: Head["bodies"][0]) => boolean): number {
    let nearestFraction = 1;
    for (const body of this.pack.head.bodies) {
      const visuals = visualsOf(this.pack.head, this.trial, body.name);
      if (!visuals.length || isSkipped(body)) continue;
      const worldFromBody = bodyPose(body.name);
      for (const visual of visuals) {
        if (visual.hidden || visual.opacity < MIN_OPACITY) continue;
        const meshFromWorld = inverseOf(product(worldFromBody, matrix(visual.matrix)));
        if (!meshFromWorld) continue;
        const [a, b] = [transform(meshFromWorld, start), transform(meshFromWorld, end)];
        nearestFraction = Math.min(nearestFraction, this.hitMesh(visual, a, b, nearestFraction));
      }
    }
    return nearestFraction;
  }

  /** Return the fraction at which a ray in the frame of a mesh hits it, or `nearestFraction` if that is smaller. */
  private hitMesh(visual: Visual, start: Vector, end: Vector, nearestFraction: number): number {
    const mesh = this.pack.head.meshes[visual.mesh];
    const ray = plus(end, start, -1);
    const square = dot(ray, ray);
    for (const piece of mesh.pieces) {
      const centre = plus([piece[2], piece[3], piece[4]], start, -1);
      const fraction = square > 0 ? Math.min(nearestFraction, Math.max(0, dot(centre, ray) / square)) : 0;
      const offset = plus(centre, ray, -fraction);
      if (dot(offset, offset) > piece[5] * piece[5]) continue;
      const positions = this.pack.numbers(mesh.positions);
      const triangles = this.pack.numbers(mesh.triangles);
      for (let i = piece[0]; i < piece[0] + piece[1]; i += 3)
        nearestFraction = Math.min(nearestFraction, hitTriangle(positions, triangles, i, start, ray));
    }
    return nearestFraction;
  }
}

/**
 * Return the fraction of a ray at which it hits a triangle (Moeller and Trumbore, 1997); Infinity: no hit.
 *
 * Written without vectors, so that it allocates no memory for each triangle near the ray.
 */
function hitTriangle(
  positions: Vector, triangles: Vector, index: number, start: Vector, ray: Vector,
): number {
  const [i, j, k] = [3 * triangles[index], 3 * triangles[index + 1], 3 * triangles[index + 2]];
  const [ax, ay, az] = [positions[i], positions[i + 1], positions[i + 2]];
  const [ex, ey, ez] = [positions[j] - ax, positions[j + 1] - ay, positions[j + 2] - az];
  const [fx, fy, fz] = [positions[k] - ax, positions[k + 1] - ay, positions[k + 2] - az];
  const [dx, dy, dz] = [ray[0], ray[1], ray[2]];
  const [nx, ny, nz] = [dy * fz - dz * fy, dz * fx - dx * fz, dx * fy - dy * fx];
  const determinant = ex * nx + ey * ny + ez * nz;
  if (Math.abs(determinant) < 1e-14) return Infinity;
  const [sx, sy, sz] = [start[0] - ax, start[1] - ay, start[2] - az];
  const u = (sx * nx + sy * ny + sz * nz) / determinant;
  if (u < 0 || u > 1) return Infinity;
  const [qx, qy, qz] = [sy * ez - sz * ey, sz * ex - sx * ez, sx * ey - sy * ex];
  const v = (dx * qx + dy * qy + dz * qz) / determinant;
  if (v < 0 || u + v > 1) return Infinity;
  const fraction = (fx * qx + fy * qy + fz * qz) / determinant;
  return fraction >= 0 ? fraction : Infinity;
}

/** Return the inverse of an affine transform; null if it is singular. */
function inverseOf(m: Matrix): Matrix | null {
  const rows = [0, 1, 2].map((i) => [m[4 * i], m[4 * i + 1], m[4 * i + 2]]);
  const columns = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])];
  const determinant = dot(rows[0], columns[0]);
  if (Math.abs(determinant) < 1e-18) return null;
  const linear = [0, 1, 2].map((i) => columns.map((column) => column[i] / determinant));
  const shift = linear.map((row) => -dot(row, [m[3], m[7], m[11]]));
  return matrix([...linear.flatMap((row, i) => [...row, shift[i]]), 0, 0, 0, 1]);
}
