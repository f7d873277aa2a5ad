// The uniform block Surface, as in uwsim.rendering.surface.surface_block.
import { clipFromCamera, columns, matrix, origin, product, type Intrinsics, type Matrix } from "../../geometry";
import type { Optics } from "../medium";
import type { SurfaceSpec } from "./spec";
import { N_POINTS, type WaveGrids } from "./wave_grids";

/** The edge of the tile of ripples [m]. */
export const TILE_SIZE = 5.3;
const N_USES = 2; // number of times that the tile is added up
const [RIPPLE_ANGLE, RIPPLE_SCALE] = [0.55, 0.43]; // turn [rad] and relative size of the tile in its second use
const SUN_RADIUS = 0.00465; // angular radius of the sun [rad]
const REFRACTIVE_INDEX = 1.34;
const N_NUMBERS = 96; // numbers in the block
const ROTATION_OFFSET = 16; // index of the rotation to W among them

/** Return the values of the uniform block Surface (surface_block.glsl). */
export function surfaceBlockValues(
  spec: SurfaceSpec, optics: Optics, grids: WaveGrids, height: number, rippleVariance: number, m: Matrix,
  intrinsics: Intrinsics, lightRate: number,
): Float32Array<ArrayBuffer> {
  const eye = origin(m);
  const rotation = rotationOnly(m);
  const cameraFromWorld = matrix([m[0], m[4], m[8], 0, m[1], m[5], m[9], 0, m[2], m[6], m[10], 0, 0, 0, 0, 1]);
  const scaleLight = (values: number[]) => values.map((value) => lightRate * value);
  const places = [0, 1, 2, 3].map((level) => {
    const frame = grids.frames[level];
    if (!frame) return [0, 0, 0, 0];
    const { origin: first, spacing, nPoints } = frame;
    const place = [0, 1].map((axis) => ((eye[axis] - first[axis]) / spacing + 0.5) / nPoints);
    return [...place, 1 / (spacing * nPoints), spacing];
  });
  const [cosine, sine] = [Math.cos(RIPPLE_ANGLE) / RIPPLE_SCALE, Math.sin(RIPPLE_ANGLE) / RIPPLE_SCALE];
  const turnedPlace = [cosine * eye[0] - sine * eye[1], sine * eye[0] + cosine * eye[1]];
  const block = new Float32Array(N_NUMBERS);
  block.set([
    ...columns(product(clipFromCamera(intrinsics, true), cameraFromWorld)),
    ...columns(rotation),
    height, intrinsics.near, 0, grids.frames.length,
    ...places.flat(),
    ...[0, 1, 2, 3].map((level) => grids.frames[level]?.roughness ?? 0),
    Math.sqrt(rippleVariance / N_USES), rippleVariance / N_USES, 1 / TILE_SIZE, TILE_SIZE / N_POINTS,
    remainder(eye[0], 5 * TILE_SIZE), remainder(eye[1], 5 * TILE_SIZE), 0, 0,
    remainder(turnedPlace[0], TILE_SIZE), remainder(turnedPlace[1], TILE_SIZE), cosine, sine,
    grids.maxElevation, grids.slopeVariance, 0, 0,
    ...spec.sky.sun, SUN_RADIUS,
    ...scaleLight(spec.sky.sunlight), optics.sun[2],
    ...scaleLight(spec.sky.light), 0,
    ...optics.reflectance.map((share, i) => lightRate * share * optics.total[i]), 0,
    intrinsics.width, intrinsics.height, 0, 0,
    spec.air, REFRACTIVE_INDEX, 1 / Math.sqrt(intrinsics.fx * intrinsics.fy), 0,
  ]);
  return block;
}

/** Return the values of the block with the rotation of another camera to W, for bodies of another view. */
export function turnBlock(values: Float32Array, m: Matrix): Float32Array<ArrayBuffer> {
  const block = Float32Array.from(values);
  block.set(columns(rotationOnly(m)), ROTATION_OFFSET);
  return block;
}

function rotationOnly(m: Matrix): Matrix {
  return matrix([m[0], m[1], m[2], 0, m[4], m[5], m[6], 0, m[8], m[9], m[10], 0, 0, 0, 0, 1]);
}

/** Return the remainder of a division, from 0 to the divisor. */
function remainder(value: number, divisor: number): number {
  return value - divisor * Math.floor(value / divisor);
}
