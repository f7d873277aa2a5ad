// The particles in a view, as in uwsim.particles: the same ones as in the images of the simulation.
import type { Intrinsics, Matrix } from "../geometry";
import { hashCell, parseWord, uniform, type Word } from "./hash64";
import type { SedimentSpec } from "./sediment/puffs";

/** The numbers of a record: place 3, radius, extent 3, weight, reflectance, kind. */
export const RECORD_LENGTH = 10;
const MAX_PARTICLES = 20000; // of a class in a view; one with more is shortened
const MAX_CELLS = 4e6; // largest number of cells of a view that is searched
const [MIN_EDGE, MAX_EDGE, MEAN_COUNT] = [0.02, 4, 3]; // limits of the edge of a cell [m]; mean number of particles in it
const [MAX_COUNT, FADE_SHARE, MAX_ELONGATION, MIN_SHARE, LENS_CLEARANCE] = [64, 0.25, 2, 0.02, 0.08];
const MIN_WIDTH = 0.5; // width of the smallest image of a particle [px]
const FLOC = 0; // the kind of flocs
const [WOBBLE, WOBBLE_RATE, PLUME_SLOPE, PLUME_RANGE_FACTOR] = [0.02, 9, 0.1, 4]; // of bubbles that rise from a source

/** A class of particles in the head; viewer/particles.py documents it. */
export interface SizeClass {
  kind: number; key: string; concentration: number; min_diameter: number; max_diameter: number; slope: number;
  rise_speed: number; reflectance: number; depth_scale: number | null; is_plume: boolean;
}

/** The particles of a scene in the head. */
export interface ParticlesSpec {
  range: number; exposure_time: number; aperture: number; focus_distance: number; source: number[] | null;
  classes: SizeClass[];
  sediment: SedimentSpec | null;
}

/** The displacement [m] and the velocity [m/s] of the water in W, and the time [s]. */
export interface Drift {
  displacement: number[];
  velocity: number[];
  time: number;
}

/** Return the records of the particles in a view. */
export function findParticles(
  spec: ParticlesSpec, drift: Drift, m: Matrix, intrinsics: Intrinsics, surfaceHeight: number,
): Float32Array<ArrayBuffer> {
  const parts = spec.classes.map((sizeClass) => {
    const view = new ParticleView(sizeClass, spec, drift, m, intrinsics);
    if (sizeClass.concentration > 0) {
      if (sizeClass.is_plume) fillPlume(view, spec.source!, surfaceHeight);
      else {
        fillView(view, surfaceHeight);
        while (view.isFull) {
          view.shorten();
          fillView(view, surfaceHeight);
        }
      }
    }
    return view.records;
  });
  return Float32Array.from(parts.flat());
}

/** The view of a camera in which the particles of a class are found. */
class ParticleView {
  readonly records: number[] = [];
  readonly key: Word;
  readonly slopes: number[]; // x / -z and y / -z of the image's edges: left, right, lower, upper
  readonly focal: number;
  reach: number;
  private readonly motion: number[]; // of the particles during the exposure, camera frame [m]

  constructor(
    readonly sizeClass: SizeClass, spec: ParticlesSpec, readonly drift: Drift, readonly m: Matrix, lens: Intrinsics,
  ) {
    this.key = parseWord(sizeClass.key);
    this.focal = Math.sqrt(lens.fx * lens.fy);
    const range = sizeClass.is_plume ? spec.range * PLUME_RANGE_FACTOR : spec.range;
    this.reach = Math.min(range, (sizeClass.max_diameter * this.focal) / MIN_WIDTH, lens.far);
    const [top, bottom] = [(lens.cy + 0.5) / lens.fy, (lens.cy + 0.5 - lens.height) / lens.fy];
    const skew = (Math.abs(lens.skew) / lens.fx) * Math.max(Math.abs(top), Math.abs(bottom));
    const [left, right] = [-(lens.cx + 0.5) / lens.fx - skew, (lens.width - 0.5 - lens.cx) / lens.fx + skew];
    this.slopes = [left, right, bottom, top];
    const { velocity } = drift;
    this.motion = this.toCamera(velocity[0], velocity[1], velocity[2] + sizeClass.rise_speed).map(
      (speed) => speed * spec.exposure_time,
    );
  }

  /** True if the view has the largest number of particles. */
  get isFull(): boolean {
    return this.records.length >= RECORD_LENGTH * MAX_PARTICLES;
  }

  /** Remove all particles, and limit the range so that fewer are found. */
  shorten(): void {
    const [left, right, lower, upper] = this.slopes;
    const volume = (0.9 * MAX_PARTICLES) / this.sizeClass.concentration;
    this.reach = Math.min(Math.cbrt((3 * volume) / ((right - left + 0.05) * (upper - lower + 0.05))), 0.7 * this.reach);
    this.records.length = 0;
  }

  /** Return a vector of W in the camera's frame. */
  toCamera(x: number, y: number, z: number): [number, number, number] {
    const { m } = this;
    return [m[0] * x + m[4] * y + m[8] * z, m[1] * x + m[5] * y + m[9] * z, m[2] * x + m[6] * y + m[10] * z];
  }

  /** Return true if a cell of some radius around a point in the camera's frame may be in view. */
  mayContain([x, y, z]: number[], radius: number): boolean {
    const { slopes } = this;
    if (z > radius || x * x + y * y + z * z > (this.reach + radius) ** 2) return false;
    const margins = slopes.map((slope) => radius * Math.hypot(1, slope));
    return (
      slopes[0] * -z - x <= margins[0] && x - slopes[1] * -z <= margins[1] &&
      slopes[2] * -z - y <= margins[2] && y - slopes[3] * -z <= margins[3]
    );
  }

  /** Return the diameter of a particle for a random number [m]. */
  diameterOf(number: number): number {
    const { min_diameter, max_diameter, slope } = this.sizeClass;
    const ratio = (max_diameter / min_diameter) ** (1 - slope);
    return min_diameter * (1 + number * (ratio - 1)) ** (1 / (1 - slope));
  }

  /** Add a particle at a place in the camera's frame, if it is in view; `word` is the hash of its shape. */
  add([x, y, z]: number[], diameter: number, weight: number, word: Word): void {
    const { slopes, sizeClass, motion } = this;
    if (-z < LENS_CLEARANCE) return;
    const margin = diameter - 0.02 * z + 0.5 * (Math.abs(motion[0]) + Math.abs(motion[1]) + Math.abs(motion[2]));
    if (x < slopes[0] * -z - margin || x > slopes[1] * -z + margin) return;
    if (y < slopes[2] * -z - margin || y > slopes[3] * -z + margin) return;
    const share = Math.hypot(x, y, z) / Math.min(this.reach, (diameter * this.focal) / MIN_WIDTH);
    if (share >= 1 || this.isFull) return;
    const fade = Math.min((1 - share) / FADE_SHARE, 1);
    let [extent, factor] = [motion, 1];
    if (sizeClass.kind === FLOC) {
      factor = -Math.log(Math.max(uniform(word, 0), MIN_SHARE));
      const length = diameter * MAX_ELONGATION * uniform(word, 1);
      extent = motion.map((part, axis) => part + length * (2 * uniform(word, axis + 2) - 1));
    }
    this.records.push(x, y, z, diameter / 2, ...extent, weight * fade, sizeClass.reflectance * factor, sizeClass.kind);
  }
}

/** Add the particles of a class that is everywhere. */
function fillView(view: ParticleView, surfaceHeight: number): void {
  const { m, sizeClass, drift, key } = view;
  const { concentration, depth_scale } = sizeClass;
  const edge = Math.min(Math.max(Math.cbrt(MEAN_COUNT / concentration), MIN_EDGE), MAX_EDGE);
  const mean = Math.min(concentration * edge ** 3, MAX_COUNT / 2);
  const rise = [0, 0, sizeClass.rise_speed * drift.time];
  const eye = [m[3], m[7], m[11]].map((value, axis) => value - (drift.displacement[axis] + rise[axis]));
  let [lower, upper] = cellBounds(view, eye, edge);
  while (lower.reduce((n, low, axis) => n * (upper[axis] - low + 1), 1) > MAX_CELLS) {
    view.reach *= 0.7;
    [lower, upper] = cellBounds(view, eye, edge);
  }
  const radius = 0.8660254037844387 * edge + sizeClass.max_diameter;
  const cameraDepth = surfaceHeight - m[11];
  for (let i = lower[0]; i <= upper[0] && !view.isFull; ++i)
    for (let j = lower[1]; j <= upper[1]; ++j)
      for (let k = lower[2]; k <= upper[2]; ++k) {
        const centre = view.toCamera((i + 0.5) * edge - eye[0], (j + 0.5) * edge - eye[1], (k + 0.5) * edge - eye[2]);
        if (!view.mayContain(centre, radius)) continue;
        const word = hashCell(key, i, j, k);
        const count = drawCount(uniform(word, 0), mean);
        for (let number = 0; number < count; ++number) {
          const first = 1 + 5 * number;
          const [x, y, z] = [i, j, k].map((index, axis) => (index + uniform(word, first + axis)) * edge - eye[axis]);
          const depth = cameraDepth - z;
          if (depth < 0) continue;
          const share = depth_scale === null ? 1 : Math.exp(-depth / depth_scale) - uniform(word, first + 4);
          if (share <= 0) continue;
          const weight = depth_scale === null ? 1 : Math.min(share / 0.05, 1);
          const diameter = view.diameterOf(uniform(word, first + 3));
          view.add(view.toCamera(x, y, z), diameter, weight, hashCell(word, number, 0, 0));
        }
      }
}

/** Return the lowest and the highest indices of the cells around a view; the box may be larger than necessary. */
function cellBounds({ slopes, reach, m }: ParticleView, eye: number[], edge: number): [number[], number[]] {
  // the view is within a cone around the camera's axis, and that within a box
  const halfDiagonal = Math.hypot(Math.max(...slopes.slice(0, 2).map(Math.abs)), Math.max(...slopes.slice(2).map(Math.abs)));
  const angle = Math.atan(halfDiagonal);
  const limits = [0, 1, 2].map((axis) => {
    const tilt = Math.acos(Math.min(Math.max(-m[4 * axis + 2], -1), 1)); // from the axis of W to the direction of view
    const high = tilt <= angle ? 1 : Math.cos(tilt - angle);
    const low = Math.PI - tilt <= angle ? -1 : Math.cos(Math.min(tilt + angle, Math.PI));
    return [reach * Math.min(low, 0), reach * Math.max(high, 0)];
  });
  return [0, 1].map((end) => limits.map((limit, axis) => Math.floor((eye[axis] + limit[end]) / edge))) as [number[], number[]];
}

/** Draw from Poisson's distribution by inversion. */
function drawCount(number: number, mean: number): number {
  let [count, share] = [0, Math.exp(-mean)];
  let total = share;
  while (number > total && count < MAX_COUNT) {
    count += 1;
    share *= mean / count;
    total += share;
  }
  return count;
}

/** Add the bubbles of a class that rise from a source. */
function fillPlume(view: ParticleView, source: number[], surfaceHeight: number): void {
  const { m, sizeClass, drift, key } = view;
  const [rate, speed, rise] = [sizeClass.concentration, sizeClass.rise_speed, surfaceHeight - source[2]];
  if (rise <= 0) return;
  const lastBubble = Math.floor(rate * drift.time);
  const first = Math.max(Math.ceil(rate * (drift.time - rise / speed)), 0, lastBubble - MAX_PARTICLES + 1);
  for (let bubble = first; bubble <= lastBubble; ++bubble) {
    const word = hashCell(key, bubble);
    const age = drift.time - bubble / rate;
    const height = speed * age;
    const angle = 2 * Math.PI * uniform(word, 0);
    const radius = PLUME_SLOPE * height * Math.sqrt(uniform(word, 1));
    const phase = 2 * Math.PI * uniform(word, 2) + WOBBLE_RATE * age;
    const wobble = WOBBLE * Math.min(10 * height, 1);
    const offsets = [
      radius * Math.cos(angle) + wobble * Math.cos(phase), radius * Math.sin(angle) + wobble * Math.sin(phase), height,
    ];
    const [x, y, z] = offsets.map((offset, axis) => source[axis] + drift.velocity[axis] * age + offset - m[4 * axis + 3]);
    view.add(view.toCamera(x, y, z), view.diameterOf(uniform(word, 3)), 1, word);
  }
}
