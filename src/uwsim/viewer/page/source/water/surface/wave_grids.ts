// The waves near the camera on square grids, from fine to coarse, as in uwsim.rendering.surface.wave_grids.
import { UNITS, type Programs } from "../../drawing/shaders";
import type { Components } from "./spec";

/** The number of points along an edge of a grid and of the tile of ripples. */
export const N_POINTS = 128;
const SPACINGS = [0.2, 0.8, 3.2, 12.8]; // of the grids of a camera that sees far [m]
const N_NEAR_POINTS = 192;
const NEAR_SPACINGS = [0.2, 0.4, 0.8, 1.6]; // possible spacings of the grid of a camera under water [m]
const POINTS_PER_WAVE = 4;
const MAX_DEVIATIONS = 6; // greatest elevation of a sea, in standard deviations
const FOAM_THRESHOLD = 0.22; // least downward acceleration of crests over gravity at which there may be foam
const FOAM_DEVIATIONS = 4.5;
const GRAVITY = 9.81;

/** The place of a grid in the world. */
export interface GridFrame {
  /** x and y of the first point in W [m]. */
  origin: [number, number];
  /** The distance between neighbouring points [m]. */
  spacing: number;
  /** The number of points along an edge. */
  nPoints: number;
  /** The variance of the slopes along an axis of the components that the grid leaves out. */
  roughness: number;
}

/** A texture, and the framebuffer of each of its layers. */
export interface GridTexture {
  texture: WebGLTexture;
  buffers: WebGLFramebuffer[];
}

/** The sums of components on the points of a grid, in a layer of a texture. */
export class GridSums {
  private readonly textures: [WebGLTexture, WebGLTexture];

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly programs: Programs,
    private readonly format: number,
  ) {
    this.textures = [gl.createTexture(), gl.createTexture()];
    for (const texture of this.textures) {
      gl.bindTexture(gl.TEXTURE_2D, texture);
      for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    }
  }

  /** Return a texture for grids of `nPoints` x `nPoints`; with `nLayers` it is an array. */
  texture(nPoints: number, wrap: number, nLayers?: number): GridTexture {
    const { gl } = this;
    const target = nLayers ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D;
    const texture = gl.createTexture();
    gl.bindTexture(target, texture);
    if (nLayers) gl.texStorage3D(target, 1, this.format, nPoints, nPoints, nLayers);
    else gl.texStorage2D(target, 1, this.format, nPoints, nPoints);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(target, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(target, name, wrap);
    const buffers = Array.from({ length: nLayers ?? 1 }, (_, layer) => {
      const buffer = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
      if (nLayers) gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, texture, 0, layer);
      else gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, target, texture, 0);
      return buffer;
    });
    return { texture, buffers };
  }

  /** Compute the elevation, the slopes along x and y, and the downward acceleration over gravity at a time [s]. */
  draw(
    { amplitude, omega, kx, ky, phase }: Components, [x, y]: [number, number], spacing: number, time: number,
    nPoints: number, buffer: WebGLFramebuffer,
  ): void {
    const { gl } = this;
    const n = Math.max(amplitude.length, 1);
    const [alongX, alongY] = [0, 1].map(() => new Float32Array(4 * n * nPoints));
    for (let i = 0; i < amplitude.length; ++i) {
      const angle = kx[i] * x + ky[i] * y - omega[i] * time + phase[i];
      const curvature = (omega[i] * omega[i]) / GRAVITY;
      const offset = 4 * nPoints * i;
      setFactors(alongX, offset, nPoints, 1, angle, kx[i] * spacing, [kx[i], curvature]);
      setFactors(alongY, offset, nPoints, amplitude[i], 0, ky[i] * spacing, [ky[i], 0]);
    }
    [alongX, alongY].forEach((values, i) => {
      gl.activeTexture(gl.TEXTURE0 + [UNITS.factors_x, UNITS.factors_y][i]);
      gl.bindTexture(gl.TEXTURE_2D, this.textures[i]);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, nPoints, n, 0, gl.RGBA, gl.FLOAT, values);
    });
    gl.activeTexture(gl.TEXTURE0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    gl.viewport(0, 0, nPoints, nPoints);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.disable(gl.BLEND);
    gl.bindVertexArray(null);
    gl.useProgram(this.programs.get("wave_grid", {}, "screen"));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

/** The grids of a scene's waves as textures. */
export class WaveGrids {
  /** The grids from fine to coarse. */
  readonly grids: GridTexture;
  /** The single grid of a camera under water. */
  readonly nearGrid: GridTexture;
  /** The places of the grids in use. */
  frames: GridFrame[] = [];
  /** The elevation that waves do not exceed [m]. */
  maxElevation = 0;
  /** The variance of the slopes of all components along an axis. */
  slopeVariance = 0;
  /** True if crests are steep enough for foam somewhere. */
  hasFoam = false;
  private components: Components | null = null;
  private scale = 1;
  private readonly keys = new Map<WebGLFramebuffer, string>(); // what each grid was drawn from

  constructor(
    gl: WebGL2RenderingContext,
    private readonly sums: GridSums,
  ) {
    this.grids = sums.texture(N_POINTS, gl.CLAMP_TO_EDGE, SPACINGS.length);
    this.nearGrid = sums.texture(N_NEAR_POINTS, gl.CLAMP_TO_EDGE);
  }

  /** Take the components of a surface with a factor on their amplitudes; null: the surface is level. */
  set(components: Components | null, scale: number): void {
    if (components === this.components && scale === this.scale) return;
    [this.components, this.scale] = [components, scale];
    this.frames = [];
    this.keys.clear();
    [this.maxElevation, this.slopeVariance, this.hasFoam] = [0, 0, false];
    if (!components) return;
    const amplitudes = [...components.amplitude].map((value) => scale * value);
    const falls = amplitudes.map((value, i) => (value * components.omega[i] ** 2) / GRAVITY);
    this.maxElevation = boundOf(amplitudes, MAX_DEVIATIONS);
    this.slopeVariance = varianceOf(components, scale, () => true);
    this.hasFoam = boundOf(falls, FOAM_DEVIATIONS) > FOAM_THRESHOLD;
  }

  /** Compute the grids at a time [s] around a point of W. */
  update(time: number, centre: number[]): void {
    this.frames = SPACINGS.map((spacing, level) => this.draw(time, centre, spacing, N_POINTS, this.grids.buffers[level]));
  }

  /** Compute the single grid, for a surface that is visible up to a horizontal distance [m]. */
  updateNear(time: number, centre: number[], maxRadius: number): void {
    const minSpacing = maxRadius / (0.5 * N_NEAR_POINTS - 2);
    const spacing = NEAR_SPACINGS.find((candidate) => candidate >= minSpacing) ?? NEAR_SPACINGS.at(-1)!;
    this.frames = [this.draw(time, centre, spacing, N_NEAR_POINTS, this.nearGrid.buffers[0])];
  }

  private draw(
    time: number, centre: number[], spacing: number, nPoints: number, buffer: WebGLFramebuffer,
  ): GridFrame {
    const components = this.components!;
    const isResolved = (number: number) => number * POINTS_PER_WAVE * spacing <= 2 * Math.PI;
    const origin: [number, number] = [0, 1].map(
      (axis) => spacing * (Math.floor(centre[axis] / spacing + 0.5) - nPoints / 2),
    ) as [number, number];
    const key = `${time} ${spacing} ${origin}`;
    if (this.keys.get(buffer) !== key) {
      this.keys.set(buffer, key);
      this.sums.draw(select(components, this.scale, isResolved), origin, spacing, time, nPoints, buffer);
    }
    const roughness = varianceOf(components, this.scale, (number) => !isResolved(number));
    return { origin, spacing, nPoints, roughness };
  }
}

/** Set the factors of a component from an index on: a cosine and a sine times `factor` at each point, and two constants. */
function setFactors(
  values: Float32Array, offset: number, nPoints: number, factor: number, angle: number, step: number,
  constants: [number, number],
): void {
  let [cosine, sine] = [factor * Math.cos(angle), factor * Math.sin(angle)];
  const [turnCosine, turnSine] = [Math.cos(step), Math.sin(step)];
  for (let i = offset; i < offset + 4 * nPoints; i += 4) {
    values[i] = cosine;
    values[i + 1] = sine;
    values[i + 2] = constants[0];
    values[i + 3] = constants[1];
    const nextCosine = cosine * turnCosine - sine * turnSine;
    sine = sine * turnCosine + cosine * turnSine;
    cosine = nextCosine;
  }
}

/** Return the components whose wave number passes a test, with a factor on their amplitudes. */
function select({ amplitude, omega, kx, ky, phase }: Components, scale: number, test: (k: number) => boolean): Components {
  const isKept = (_: number, i: number) => test(Math.hypot(kx[i], ky[i]));
  const [a, b, c, d, e] = [amplitude, omega, kx, ky, phase].map((column) => column.filter(isKept));
  return { amplitude: a.map((value) => scale * value), omega: b, kx: c, ky: d, phase: e };
}

/** Return the variance of the slopes along an axis of the components whose wave number passes a test. */
function varianceOf({ amplitude, kx, ky }: Components, scale: number, test: (k: number) => boolean): number {
  let total = 0;
  for (let i = 0; i < amplitude.length; ++i) {
    const number = Math.hypot(kx[i], ky[i]);
    if (test(number)) total += 0.25 * (scale * amplitude[i] * number) ** 2;
  }
  return total;
}

/** Return what a sum of waves with some amplitudes does not exceed in practice. */
function boundOf(amplitudes: number[], nDeviations: number): number {
  const square = amplitudes.reduce((sum, value) => sum + value * value, 0);
  const total = amplitudes.reduce((sum, value) => sum + value, 0);
  return Math.min(total, nDeviations * Math.sqrt(0.5 * square));
}
