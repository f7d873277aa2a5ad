// The passes that add the water's surface, the sky and the air to an image, as in uwsim.rendering.surface.surface_pass.
import { UNITS, type Programs, type Switches } from "../../drawing/shaders";
import { origin, type Intrinsics, type Matrix } from "../../geometry";
import type { Optics } from "../medium";
import type { MovingSurface, SurfaceSpec } from "./spec";
import { HEMISPHERE_SIZE, hemispheres } from "./sky";
import { findMirrorView } from "./mirror";
import { surfaceBlockValues, TILE_SIZE, turnBlock } from "./surface_block";
import { COARSE_STEP, findSurfaceView, SurfaceMesh, type SurfaceView } from "./surface_mesh";
import { GridSums, N_POINTS, WaveGrids, type GridTexture } from "./wave_grids";

const MIN_VISIBLE_SHARE = 0.01; // share of light from the surface below which a camera under water does not see it

/** The view of the bodies that the surface mirrors. */
export interface MirrorView {
  pose: Matrix;
  intrinsics: Intrinsics;
  /** The values of the uniform block Surface for this view. */
  values: Float32Array<ArrayBuffer>;
  /** Returns true for points of W on the side that is mirrored. */
  isMirrored: (point: number[]) => boolean;
  switches: Switches;
}

/** The passes of the water's surface. */
export class SurfacePass {
  private readonly sums: GridSums;
  private readonly grids: WaveGrids;
  private readonly ripples: GridTexture;
  private readonly hemispheres: WebGLTexture;
  private readonly fineMesh: SurfaceMesh;
  private readonly coarseMesh: SurfaceMesh; // for a camera under water
  private ripplesKey: unknown[] = []; // the ripples and the time of the tile
  private hemispheresKey: unknown[] = []; // the medium and the light rate of the hemispheres
  private switches: Switches = {};
  private sides: boolean[] = []; // the sides of the surface that are drawn: true is from above
  private isAbove = false; // true if the camera is above the still surface
  private blockValues = new Float32Array(0); // of the uniform block Surface
  private mirror: WebGLTexture | null = null; // the image of mirrored bodies; null: there are none
  private view: SurfaceView = { sectors: [], minRadius: 0, maxRadius: 0 };

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly programs: Programs,
    private readonly spec: SurfaceSpec,
    format: number,
    private readonly formatSwitches: Switches,
  ) {
    this.sums = new GridSums(gl, programs, format);
    this.grids = new WaveGrids(gl, this.sums);
    this.ripples = this.sums.texture(N_POINTS, gl.REPEAT);
    this.hemispheres = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.hemispheres);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, format, HEMISPHERE_SIZE, HEMISPHERE_SIZE, 2);
    for (const [name, value] of [
      [gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
      [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
    ])
      gl.texParameteri(gl.TEXTURE_2D_ARRAY, name, value);
    this.fineMesh = new SurfaceMesh(gl);
    this.coarseMesh = new SurfaceMesh(gl, COARSE_STEP);
  }

  /** Fill the textures before bodies are drawn, and return the values of the uniform block Surface. */
  prepare(
    { time, scale, waves, ripples }: MovingSurface, optics: Optics, surfaceHeight: number, worldFromCamera: Matrix,
    intrinsics: Intrinsics, lightRate: number,
  ): Float32Array<ArrayBuffer> {
    const { grids, spec } = this;
    grids.set(waves, scale);
    const eye = origin(worldFromCamera);
    const height = eye[2] - surfaceHeight;
    const bound = grids.maxElevation + 2 * intrinsics.near;
    this.mirror = null;
    this.isAbove = height > 0;
    this.sides = [...(height > -bound ? [true] : []), ...(height < bound ? [false] : [])];
    this.view = findSurfaceView(worldFromCamera, intrinsics, height, bound);
    if (this.isDirect) this.view.maxRadius = Math.min(this.view.maxRadius, visibleRange(optics));
    this.switches = { ...this.formatSwitches };
    let variance = 0;
    if (waves && this.view.sectors.length) {
      variance = grids.slopeVariance;
      if (this.isDirect) grids.updateNear(time, eye, this.view.maxRadius);
      else grids.update(time, eye);
      this.switches.WAVES = grids.frames.length;
      if (grids.hasFoam) this.switches.FOAM = 1;
    }
    const rippleVariance = ripples ? Math.max(spec.slope_variance - variance, spec.short_wave_variance) : 0;
    if (ripples && rippleVariance > 0) {
      if (this.ripplesKey[0] !== ripples || this.ripplesKey[1] !== time) {
        this.ripplesKey = [ripples, time];
        this.sums.draw(ripples, [0, 0], TILE_SIZE / N_POINTS, time, N_POINTS, this.ripples.buffers[0]);
      }
      this.switches.RIPPLES = 1;
    }
    this.updateHemispheres(optics, lightRate);
    this.blockValues = surfaceBlockValues(
      spec, optics, grids, height, rippleVariance, worldFromCamera, intrinsics, lightRate,
    );
    return this.blockValues;
  }

  /** Return the view of bodies that the surface mirrors; null: it mirrors none, or is not visible. */
  mirrorView(optics: Optics, surfaceHeight: number, worldFromCamera: Matrix, lens: Intrinsics): MirrorView | null {
    if (!this.spec.mirror || !this.view.sectors.length) return null;
    const maxRange = this.isAbove ? lens.far : visibleRange(optics);
    const hasWaves = this.switches.WAVES !== undefined;
    const { pose, intrinsics } = findMirrorView(worldFromCamera, lens, surfaceHeight, maxRange, hasWaves);
    const values = turnBlock(this.blockValues, pose);
    const isMirrored = ([, , z]: number[]) => (this.isAbove ? z > surfaceHeight : z < surfaceHeight);
    return { pose, intrinsics, values, isMirrored, switches: { MIRROR: this.isAbove ? 1 : 2 } };
  }

  /** Set the image of mirrored bodies. */
  setMirror(mirror: WebGLTexture): void {
    this.mirror = mirror;
  }

  /** True if the whole camera is under water: the surface is drawn among the bodies. */
  get isDirect(): boolean {
    return this.sides.length === 1 && !this.sides[0];
  }

  /** Draw the surface from below among opaque bodies, after the background. */
  drawAmong(): void {
    this.useTextures();
    this.drawSides({ DIRECT: 1 });
    this.gl.depthFunc(this.gl.LEQUAL);
  }

  /**
   * Draw the sky, the bodies, and the surface into the current framebuffer, from the image of bodies.
   *
   * `hasBodiesAbove`: true if a body reaches above the still surface, which mirrors it.
   */
  draw(hasBodiesAbove: boolean): void {
    const { gl } = this;
    this.useTextures();
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.bindVertexArray(null);
    gl.useProgram(this.programs.get("air", this.switches, "screen"));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    this.drawSides(hasBodiesAbove && !this.spec.mirror ? { BODIES_ABOVE: 1 } : {});
    gl.depthFunc(gl.LEQUAL);
  }

  /** Draw the visible sides of the surface; the image is upside down for WebGL. */
  private drawSides(switches: Switches): void {
    const { gl } = this;
    gl.enable(gl.CULL_FACE);
    gl.frontFace(gl.CW);
    for (const isAbove of this.sides) {
      gl.cullFace(isAbove ? gl.BACK : gl.FRONT);
      const side: Switches = isAbove ? { ABOVE: 1 } : {};
      if (this.mirror && isAbove === this.isAbove) side.MIRROR = 1;
      gl.useProgram(this.programs.get("water_surface", { ...this.switches, ...switches, ...side }));
      (this.isDirect ? this.coarseMesh : this.fineMesh).draw(this.view);
    }
    gl.cullFace(gl.BACK);
    gl.disable(gl.CULL_FACE);
  }

  private useTextures(): void {
    const { gl } = this;
    for (const [unit, target, texture] of [
      [UNITS.wave_grids, gl.TEXTURE_2D_ARRAY, this.grids.grids.texture],
      [UNITS.wave_grid, gl.TEXTURE_2D, this.grids.nearGrid.texture],
      [UNITS.ripple_tile, gl.TEXTURE_2D, this.ripples.texture],
      [UNITS.hemispheres, gl.TEXTURE_2D_ARRAY, this.hemispheres],
      [UNITS.mirror_image, gl.TEXTURE_2D, this.mirror],
    ] as const) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(target, texture);
    }
    gl.activeTexture(gl.TEXTURE0);
  }

  private updateHemispheres(optics: Optics, lightRate: number): void {
    const { gl } = this;
    const key = [optics.transform, lightRate];
    if (key.every((value, i) => value === this.hemispheresKey[i])) return;
    this.hemispheresKey = key;
    const values = hemispheres(optics, this.spec.sky, lightRate);
    gl.activeTexture(gl.TEXTURE0 + UNITS.hemispheres);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.hemispheres);
    const size = HEMISPHERE_SIZE;
    gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, 0, size, size, 2, gl.RGBA, gl.FLOAT, values);
    gl.activeTexture(gl.TEXTURE0);
  }
}

/** Return the range beyond which less than `MIN_VISIBLE_SHARE` of light arrives [m]. */
function visibleRange({ absorption, scattering, field }: Optics): number {
  const ranges = Array.from({ length: 48 }, (_, step) => 2 * 1.25 ** step);
  const visibleRanges = ranges.filter((range) =>
    absorption.some((a, i) => {
      const wideLoss = field[0] + field[1] * Math.sqrt(a * range);
      return Math.exp(-range * (a + wideLoss * scattering[i])) > MIN_VISIBLE_SHARE;
    }),
  );
  return visibleRanges.length ? visibleRanges.at(-1)! * 1.25 : ranges[0];
}
