// The selection of the pieces in view, and of the pieces whose shadow in the sun may fall on them, as in
// uwsim.rendering.instance, lights.sun_shadow and minification.
import {
  cross, dot, matrix, origin, plus, transform, rotateBack, unit, inverse, type Intrinsics, type Matrix,
} from "../geometry";
import type { Models, Piece } from "../models";

/** The camera of an image. */
export interface Eye {
  worldFromCamera: Matrix;
  /** The matrix from the camera's frame to clip space. */
  clip: Matrix;
  intrinsics: Intrinsics;
}

const LOW_SUN = 0.3; // sine of the sun's elevation below which shadow axes are perpendicular to the sunbeams [1]
const MAX_CASTER_RADIUS = 5; // radius above which a model casts no shadow of the sun [m]
const MAX_HULL_RADIUS = 20; // radius up to which a hull casts one in physical water [m]
const [MARGIN, HULL_MARGIN] = [0.05, 2.05]; // distances by which a shadow may reach beyond the box of its caster, and with hulls [m]
const MAX_TEXELS = Math.SQRT2; // greatest number of texels along a pixel for which mipmaps can be skipped
/** The transform from clip space (-1 .. 1) to texture coordinates and depth (0 .. 1). */
export const TEXTURE_FROM_CLIP = matrix([0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1]);

/** Return the six planes [nx, ny, nz, d] of the view frustum in the camera's frame; inside, n . p + d >= 0. */
function frustum(clip: Matrix): number[][] {
  const rows = [0, 4, 8, 12].map((i) => [clip[i], clip[i + 1], clip[i + 2], clip[i + 3]]);
  const planes = [1, -1].flatMap((sign) =>
    [0, 1, 2].map((i) => rows[3].map((value, k) => value + sign * rows[i][k])),
  );
  return planes.map((plane) => {
    const length = Math.hypot(plane[0], plane[1], plane[2]);
    return plane.map((value) => value / length);
  });
}

/** Return the pieces whose bounds intersect the view frustum, in ascending order of distance. */
export function findVisible(pieces: Piece[], eye: Eye): Piece[] {
  const planes = frustum(eye.clip);
  const cameraFromWorld = inverse(eye.worldFromCamera);
  const visiblePieces: [number, Piece][] = [];
  for (const piece of pieces) {
    const centre = transform(cameraFromWorld, piece.centre);
    if (!planes.every((p) => dot(p, centre) + p[3] + piece.radius > 0)) continue;
    const corners = piece.corners.map((corner) => transform(cameraFromWorld, corner));
    if (!planes.every((p) => corners.some((corner) => dot(p, corner) + p[3] > 0))) continue;
    visiblePieces.push([Math.hypot(...centre) + piece.radius, piece]);
  }
  return visiblePieces.sort((a, b) => a[0] - b[0]).map(([, piece]) => piece);
}

/**
 * Return the casters whose shadow may fall on a part of a receiver that is in view.
 *
 * `sun` is the unit vector towards the sun in W.
 */
function castersInView(casters: Piece[], receivers: Piece[], sun: number[], eye: Eye, margin: number): Piece[] {
  const frame = shadowAxes(sun);
  const position = origin(eye.worldFromCamera);
  const back = [eye.worldFromCamera[2], eye.worldFromCamera[6], eye.worldFromCamera[10]];
  const rays = cornerRays(eye);
  const litBoxes = receivers.map((piece) => {
    const depths = piece.corners.map((corner) => dot(plus(position, corner, -1), back));
    const ends = [Math.max(0, Math.min(...depths)), Math.max(0, Math.max(...depths))];
    const slice = ends.flatMap((end) => rays.map((ray) => plus(position, ray, end)));
    const [box, cut] = [bounds(piece.corners, frame), bounds(slice, frame)];
    return box.map(([low, high], i) => [Math.max(low, cut[i][0]), Math.min(high, cut[i][1])]);
  });
  return casters.filter((caster) => {
    const casterBox = bounds(caster.corners, frame);
    return litBoxes.some(
      (box) =>
        [0, 1].every((i) => casterBox[i][0] <= box[i][1] + margin && casterBox[i][1] >= box[i][0] - margin) &&
        casterBox[2][1] >= box[2][0] - margin,
    );
  });
}

/** Return three axes in W; the coordinates along the first two are constant along a sunbeam. */
function shadowAxes(sun: number[]): number[][] {
  if (sun[2] < LOW_SUN) return [...axesOf(sun), sun];
  return [[1, 0, -sun[0] / sun[2]], [0, 1, -sun[1] / sun[2]], sun];
}

/** Return the least and greatest coordinate of some points along each axis of a frame. */
function bounds(points: number[][], frame: number[][]): [number, number][] {
  return frame.map((axis) => {
    const values = points.map((point) => dot(axis, point));
    return [Math.min(...values), Math.max(...values)];
  });
}

/** Return the vectors, in W, from the camera to the corners of its image at a depth of 1 m. */
function cornerRays({ clip, worldFromCamera: m }: Eye): number[][] {
  const corners = [[-1, -1], [-1, 1], [1, -1], [1, 1]];
  return corners.map(([u, v]) => {
    const y = (v + clip[6]) / clip[5];
    const x = (u + clip[2] - clip[1] * y) / clip[0];
    return [m[0] * x + m[1] * y - m[2], m[4] * x + m[5] * y - m[6], m[8] * x + m[9] * y - m[10]];
  });
}

/** Return two unit vectors that are perpendicular to each other and to the direction of the sun. */
function axesOf(sun: number[]): [number[], number[]] {
  const down = [-sun[0], -sun[1], -sun[2]];
  const sideAxis = unit(cross(down, Math.abs(sun[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  return [sideAxis, cross(sideAxis, down)];
}

/** Return a parallel projection along the sunbeams that contains all casters (clip space from W), and its width [m]. */
export function fitSunView(casters: Piece[], sun: number[]): [Matrix, number] {
  const axes = [...axesOf(sun), [-sun[0], -sun[1], -sun[2]]];
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { centre, radius } of casters)
    axes.forEach((axis, i) => {
      low[i] = Math.min(low[i], dot(axis, centre) - radius);
      high[i] = Math.max(high[i], dot(axis, centre) + radius);
    });
  const half = Math.max(high[0] - low[0], high[1] - low[1]) / 2;
  const reach = 20; // distance behind the casters up to which shadows fall [m]
  const scale = [1 / half, 1 / half, 2 / (high[2] + reach - low[2])];
  const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (high[2] + reach + low[2]) / 2];
  const rows = axes.flatMap((axis, i) => [
    axis[0] * scale[i], axis[1] * scale[i], axis[2] * scale[i], -scale[i] * middle[i],
  ]);
  return [matrix([...rows, 0, 0, 0, 1]), 2 * half];
}

/** Return true if no pixel of a flat piece covers more than `MAX_TEXELS` texels, so that mipmaps have no effect. */
export function canSkipMipmaps(piece: Piece, eye: Eye): boolean {
  if (!(piece.density > 0) || dot(piece.normal, piece.normal) === 0) return false;
  const cameraFromWorld = inverse(eye.worldFromCamera);
  const points = piece.corners.map((corner) => transform(cameraFromWorld, corner));
  const normal = rotateBack(eye.worldFromCamera, piece.normal);
  const depths = points.map((point) => -point[2]);
  if (Math.min(...depths) <= 0) return false;
  const distance = Math.min(...points.map((point) => Math.abs(dot(normal, point))));
  const maxDistance = Math.max(...points.map((point) => Math.hypot(...point)));
  const tilt = Math.hypot(normal[0], normal[1]);
  const focal = Math.min(eye.intrinsics.fx, eye.intrinsics.fy);
  const footprint = (Math.max(...depths) / focal) * (1 + (tilt * maxDistance) / distance);
  return piece.density * footprint <= MAX_TEXELS;
}

/**
 * Return the opaque pieces that shade the sun in an image, and whether hulls are among them.
 *
 * `maxHullHeight` is the height in W below which hulls shade, in physical water [m]; -infinity: none do.
 */
export function findCasters(
  models: Models, pieces: Piece[], receivers: Piece[], sun: number[], eye: Eye, maxHullHeight: number,
): { casters: Piece[]; hasHulls: boolean } {
  const hullParts = findHulls(models, pieces, maxHullHeight);
  const isHull = ({ instance }: Piece) => hullParts.has(instance.visual.part);
  const isCaster = (piece: Piece) => models.radius(piece.instance) <= MAX_CASTER_RADIUS || isHull(piece);
  const candidates = pieces.filter((piece) => piece.instance.visual.opacity >= 1 && isCaster(piece));
  const casters = castersInView(candidates, receivers, sun, eye, candidates.some(isHull) ? HULL_MARGIN : MARGIN);
  return { casters, hasHulls: casters.some(isHull) };
}

/** Return the numbers of large models that are no ground: below a height, and at least a fifth as high as they are long. */
function findHulls(models: Models, pieces: Piece[], maxHeight: number): Set<number> {
  const limits = new Map<number, [number, number]>();
  for (const { instance, corners } of pieces) {
    const radius = models.radius(instance);
    if (radius <= MAX_CASTER_RADIUS || radius > MAX_HULL_RADIUS) continue;
    const heights = corners.map((corner) => corner[2]);
    const [low, high] = limits.get(instance.visual.part) ?? [Infinity, -Infinity];
    limits.set(instance.visual.part, [Math.min(low, ...heights), Math.max(high, ...heights)]);
  }
  const radii = new Map(pieces.map(({ instance }) => [instance.visual.part, models.radius(instance)]));
  const hulls = [...limits].filter(([part, [low, high]]) => high < maxHeight && high - low > 0.4 * radii.get(part)!);
  return new Set(hulls.map(([part]) => part));
}

/** Return the height of the lowest point of large models, which count as the ground [m]; -infinity without any. */
export function findLowestPoint(models: Models): number {
  const largeModels = models.instances.filter(
    (instance) => instance.isPresent && models.radius(instance) > MAX_CASTER_RADIUS,
  );
  const heights = largeModels.flatMap(({ pieces }) => pieces.flatMap(({ corners }) => corners.map((corner) => corner[2])));
  return heights.length ? heights.reduce((a, b) => Math.min(a, b)) : -Infinity;
}
