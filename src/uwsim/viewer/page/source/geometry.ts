// Poses and matrices as in uwsim.base.geometry: 4 x 4 matrices in row-major order, quaternions w x y z.

/** A 4 x 4 matrix in row-major order. */
export type Matrix = Float64Array;
/** A vector x y z. */
export type Vector = ArrayLike<number>;
/** A position [m] and a quaternion: x y z w x y z. */
export type Pose = ArrayLike<number>;

/** The intrinsics of a pinhole camera [px], with the distances of the near and far plane [m]. */
export interface Intrinsics {
  width: number;
  height: number;
  fx: number;
  fy: number;
  /** The principal point; (0, 0) is the centre of the upper left pixel. */
  cx: number;
  cy: number;
  skew: number;
  near: number;
  far: number;
}

export function matrix(values: ArrayLike<number>): Matrix {
  return Float64Array.from(values);
}

export function identity(): Matrix {
  return matrix([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
}

/** Return the matrix product a b. */
export function product(a: Matrix, b: Matrix): Matrix {
  const out = new Float64Array(16);
  for (let i = 0; i < 16; i += 4)
    for (let j = 0; j < 4; ++j)
      out[i + j] = a[i] * b[j] + a[i + 1] * b[4 + j] + a[i + 2] * b[8 + j] + a[i + 3] * b[12 + j];
  return out;
}

/** Return the matrix of a pose whose seven numbers begin at `offset`; its quaternion need not have unit length. */
export function fromPose(pose: Pose, offset = 0): Matrix {
  const [x, y, z] = [pose[offset], pose[offset + 1], pose[offset + 2]];
  const length = Math.hypot(pose[offset + 3], pose[offset + 4], pose[offset + 5], pose[offset + 6]) || 1;
  const [w, i, j, k] = [3, 4, 5, 6].map((n) => pose[offset + n] / length);
  return matrix([
    1 - 2 * (j * j + k * k), 2 * (i * j - w * k), 2 * (i * k + w * j), x,
    2 * (i * j + w * k), 1 - 2 * (i * i + k * k), 2 * (j * k - w * i), y,
    2 * (i * k - w * j), 2 * (j * k + w * i), 1 - 2 * (i * i + j * j), z,
    0, 0, 0, 1,
  ]);
}

/** Return the pose (x y z w x y z) of a rigid transform. */
export function toPose(m: Matrix): number[] {
  const signs = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]; // of w, x, y, z
  const squares = signs.map(([a, b, c]) => Math.max(0, 1 + a * m[0] + b * m[5] + c * m[10]));
  const [w, x, y, z] = squares.map((square) => Math.sqrt(square) / 2);
  const index = squares.indexOf(Math.max(...squares));
  const pairs: number[][] = [
    [1, m[9] - m[6], m[2] - m[8], m[4] - m[1]],
    [m[9] - m[6], 1, m[1] + m[4], m[2] + m[8]],
    [m[2] - m[8], m[1] + m[4], 1, m[6] + m[9]],
    [m[4] - m[1], m[2] + m[8], m[6] + m[9], 1],
  ];
  const q = [w, x, y, z].map((value, i) => value * (pairs[index][i] < 0 ? -1 : 1));
  return [m[3], m[7], m[11], ...q];
}

/** Return the inverse of a rigid transform. */
export function inverse(m: Matrix): Matrix {
  const back = (i: number): number => -(m[i] * m[3] + m[4 + i] * m[7] + m[8 + i] * m[11]);
  return matrix([
    m[0], m[4], m[8], back(0), m[1], m[5], m[9], back(1), m[2], m[6], m[10], back(2), 0, 0, 0, 1,
  ]);
}

/** Return the determinant of the upper left 3 x 3. */
export function determinant(m: Matrix): number {
  return dot([m[0], m[1], m[2]], cross([m[4], m[5], m[6]], [m[8], m[9], m[10]]));
}

/** Return the inverse transpose of the upper left 3 x 3, which transforms normals, in a 4 x 4 matrix. */
export function normalMatrix(m: Matrix): Matrix {
  const rows = [0, 4, 8].map((i) => [m[i], m[i + 1], m[i + 2]]);
  const d = 1 / determinant(m);
  const [a, b, c] = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])];
  return matrix([...[a, b, c].flatMap((row) => [row[0] * d, row[1] * d, row[2] * d, 0]), 0, 0, 0, 1]);
}

/** Transform a point. */
export function transform(m: Matrix, p: Vector): [number, number, number] {
  return [
    m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3],
    m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
    m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11],
  ];
}

/** Multiply a direction by the upper left 3 x 3 of a matrix. */
export function rotate(m: Matrix, v: Vector): [number, number, number] {
  return [dot([m[0], m[1], m[2]], v), dot([m[4], m[5], m[6]], v), dot([m[8], m[9], m[10]], v)];
}

/** Multiply a direction by the transpose of the upper left 3 x 3, the inverse of a rotation. */
export function rotateBack(m: Matrix, v: Vector): [number, number, number] {
  return [dot([m[0], m[4], m[8]], v), dot([m[1], m[5], m[9]], v), dot([m[2], m[6], m[10]], v)];
}

/** Return the translation of a transform: the origin of its source frame in the target frame. */
export function origin(m: Matrix): [number, number, number] {
  return [m[3], m[7], m[11]];
}

export function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vector, b: Vector): [number, number, number] {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** Return a + factor b. */
export function plus(a: Vector, b: Vector, factor = 1): [number, number, number] {
  return [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
}

/** Return the unit vector in the direction of a vector; 0 for 0. */
export function unit(a: Vector): [number, number, number] {
  const length = Math.hypot(a[0], a[1], a[2]) || 1;
  return [a[0] / length, a[1] / length, a[2] / length];
}

/** Return the pose in W of a camera (OpenGL axes) at `eye` that looks towards `target`. */
export function lookAt(eye: Vector, target: Vector, up: Vector = [0, 0, 1]): Matrix {
  const back = unit(plus(eye, target, -1));
  let right = cross(up, back);
  if (Math.hypot(...right) < 1e-6) right = cross([1, 0, 0], back);
  right = unit(right);
  const trueUp = cross(back, right);
  return matrix([
    right[0], trueUp[0], back[0], eye[0], right[1], trueUp[1], back[1], eye[1],
    right[2], trueUp[2], back[2], eye[2], 0, 0, 0, 1,
  ]);
}

/**
 * Return the intrinsics for an image size [px] and a vertical field of view `fovy` [rad].
 *
 * An image narrower than 4:3 has the horizontal field of view of a 4:3 image, so that its vertical one is larger.
 */
export function intrinsicsOf(width: number, height: number, fovy: number): Intrinsics {
  const focal = Math.min(height, 0.75 * width) / (2 * Math.tan(fovy / 2));
  const centre = { cx: (width - 1) / 2, cy: (height - 1) / 2 };
  return { width, height, fx: focal, fy: focal, ...centre, skew: 0, near: 0.05, far: 2000 };
}

/** Return the intrinsics of an image that is larger by a ratio; its sides are rounded to whole pixels. */
export function scaleIntrinsics(intrinsics: Intrinsics, ratio: number): Intrinsics {
  const [width, height] = [Math.round(intrinsics.width * ratio), Math.round(intrinsics.height * ratio)];
  return {
    ...intrinsics,
    width,
    height,
    fx: intrinsics.fx * ratio,
    fy: intrinsics.fy * ratio,
    cx: (intrinsics.cx + 0.5) * ratio - 0.5,
    cy: (intrinsics.cy + 0.5) * ratio - 0.5,
    skew: intrinsics.skew * ratio,
  };
}

/** Return the matrix from the camera's frame to clip space; with `isFlipped`, row 0 of the framebuffer is the image's top. */
export function clipFromCamera(intrinsics: Intrinsics, isFlipped: boolean): Matrix {
  const { width: w, height: h, near, far } = intrinsics;
  const span = far - near;
  const s = isFlipped ? 1 : -1;
  return matrix([
    (2 * intrinsics.fx) / w, (2 * intrinsics.skew) / w, 1 - (2 * intrinsics.cx + 1) / w, 0,
    0, (-2 * s * intrinsics.fy) / h, s * (1 - (2 * intrinsics.cy + 1) / h), 0,
    0, 0, -(far + near) / span, (-2 * far * near) / span,
    0, 0, -1, 0,
  ]);
}

/** Return the elements of a matrix in column-major order, as OpenGL expects them. */
export function columns(m: Matrix): number[] {
  return [0, 1, 2, 3].flatMap((i) => [m[i], m[4 + i], m[8 + i], m[12 + i]]);
}

/** Return the intrinsics of an image with more columns and rows on each side [px]. */
export function widenIntrinsics(intrinsics: Intrinsics, columns: number, rows: number): Intrinsics {
  const { width, height, cx, cy } = intrinsics;
  return { ...intrinsics, width: width + 2 * columns, height: height + 2 * rows, cx: cx + columns, cy: cy + rows };
}

/** Return the rotation from W to the camera's frame, as a 4 x 4 matrix. */
export function rotationOf(worldFromCamera: Matrix): Matrix {
  const m = worldFromCamera;
  return matrix([m[0], m[4], m[8], 0, m[1], m[5], m[9], 0, m[2], m[6], m[10], 0, 0, 0, 0, 1]);
}
