// Images through physical water: the passes on whole images after the surfaces, as in uwsim.rendering.physical.development.
import type { Optics } from "./medium";
import type { Intrinsics, Matrix } from "../geometry";
import { kernelSwitches, MAX_LEVELS, planBlur, type BlurPlan } from "./blur_plan";
import { N_SHARES, weightTable } from "./blur_weights";
import { openWaterMap, MAP_SIZE } from "./open_water";
import { ParticlePass, type VisibleParticles } from "./particle_pass";
import { CloudPass, EDGE } from "./sediment/cloud_pass";
import type { VisibleClouds } from "./sediment/clouds";
import { TargetPool, type Target, type Targets } from "./targets";
import { UNITS, type Programs, type Switches } from "../drawing/shaders";

const MAX_TABLES = 16; // greatest number of tables of weights that are kept
const OWN_VERTICES = ["scattered", "blurred", "developed"]; // passes whose vertex shader is not screen.vert.glsl
const HALF_FAR = "6e4"; // range of pixels without a surface in half floats [m]

/** The passes of physical water. */
export class Development {
  /** The switches of all programs that depend on the format of the textures. */
  readonly switches: Switches;
  /** The format of the textures. */
  readonly format: number;
  private readonly pool: TargetPool;
  private readonly particlePass: ParticlePass;
  private readonly cloudPass: CloudPass;
  private readonly map: WebGLTexture;
  private readonly tables: { optics: Optics["transform"]; key: string; texture: WebGLTexture }[] = [];
  private table: WebGLTexture | null = null; // the weights of the prepared image
  private currentTargets: Targets | null = null;
  private radiance: WebGLTexture | null = null; // the radiance and the range that are developed

  private constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly programs: Programs,
    private readonly nodes: number[],
    isHalf: boolean,
  ) {
    this.format = isHalf ? gl.RGBA16F : gl.RGBA32F;
    this.switches = isHalf ? { FAR: HALF_FAR } : {};
    this.particlePass = new ParticlePass(gl, programs);
    this.cloudPass = new CloudPass(gl, programs);
    this.pool = new TargetPool(gl, this.format);
    this.map = this.pool.texture(MAP_SIZE[0], MAP_SIZE[1], this.format);
  }

  /** Return the passes, with floats or half floats; null if this browser cannot draw into either. */
  static make(gl: WebGL2RenderingContext, programs: Programs, nodes: number[]): Development | null {
    const names = ["EXT_color_buffer_float", "OES_texture_float_linear", "EXT_float_blend"];
    if (names.every((name) => gl.getExtension(name))) return new Development(gl, programs, nodes, false);
    if (!gl.getExtension("EXT_color_buffer_float") && !gl.getExtension("EXT_color_buffer_half_float")) return null;
    return new Development(gl, programs, nodes, true);
  }

  /** Return the plan of the blur of an image. */
  plan(intrinsics: Intrinsics, hasBlur: boolean): BlurPlan {
    return planBlur(intrinsics, this.nodes, hasBlur);
  }

  /** Set the open water and the weights of an image, and return the target of its surfaces. */
  prepare(
    optics: Optics, worldFromCamera: Matrix, intrinsics: Intrinsics, plan: BlurPlan, depth: number, lightRate: number,
    hasSurface: boolean,
  ): WebGLFramebuffer {
    this.table = plan.deviations.length ? this.tableOf(optics, plan) : null;
    this.pool.upload(this.map, MAP_SIZE[0], MAP_SIZE[1], openWaterMap(optics, worldFromCamera, intrinsics, depth, lightRate, hasSurface));
    this.bind(UNITS.open_water_map, this.map);
    if (this.table) this.bind(UNITS.weight_table, this.table);
    this.currentTargets = this.pool.find(intrinsics, plan.deviations.length);
    this.radiance = this.currentTargets.surfaces.textures[0];
    return this.currentTargets.surfaces.buffer;
  }

  /** Return the target of the bodies that the surface mirrors in the prepared image. */
  mirrorTarget({ width, height }: Intrinsics): Target {
    const targets = this.currentTargets!;
    if (!targets.mirror) {
      const { gl } = this;
      targets.mirror = this.pool.depthTarget(width, height);
      gl.bindTexture(gl.TEXTURE_2D, targets.mirror.textures[0]);
      // ranges are not to be mixed
      for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    }
    return targets.mirror;
  }

  /** Add the lamps that the camera sees to the surfaces in the current framebuffer. */
  drawLampPoints(nLamps: number): void {
    const { gl } = this;
    gl.useProgram(this.programs.get("lamp_point", { COLOUR: 0, LAMPS: nLamps, ...this.switches }));
    gl.depthMask(false);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.ONE, gl.ONE, gl.ONE, gl.ZERO);
    gl.drawArrays(gl.POINTS, 0, nLamps);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
  }

  /** Draw into a second image, of which the image of surfaces is the source; it is developed instead. */
  drawOver(draw: () => void): void {
    const { gl } = this;
    const targets = this.currentTargets!;
    const { width, height } = targets.surfaces;
    const target = (targets.wateredSurfaces ??= this.pool.depthTarget(width, height));
    this.bind(UNITS.surface_image, targets.surfaces.textures[0]);
    this.begin(target);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    draw();
    this.radiance = target.textures[0];
  }

  /**
   * Draw the finished image of prepared surfaces; row 0 of the texture is the top.
   *
   * `shafts` are the switches of the pass of light shafts; null: there are none.
   */
  develop(
    optics: Optics, intrinsics: Intrinsics, plan: BlurPlan, nLamps: number, grey: boolean,
    particles: VisibleParticles | null, clouds: VisibleClouds | null, shafts: Switches | null,
  ): WebGLTexture {
    const targets = this.pool.find(intrinsics, plan.deviations.length);
    const nVeils = optics.lamp_veil ? nLamps : 0;
    const switches: Switches = this.table ? { BLUR: 1 } : {};
    if (plan.spreads.length || nVeils) {
      this.drawScattered(targets, plan, nVeils);
      this.bind(UNITS.level_0, targets.levels[0].total.textures[0]);
      switches.SCATTERED = 1;
    }
    this.bind(UNITS.surface_image, this.radiance!);
    if (particles) {
      const target = (targets.particles ??= this.pool.target(intrinsics.width, intrinsics.height, 1, this.format));
      this.begin(target);
      this.particlePass.draw(particles, nLamps, this.switches);
      this.bind(UNITS.particle_image, target.textures[0]);
      switches.PARTICLES = 1;
    }
    if (clouds) {
      const size = [intrinsics.width, intrinsics.height].map((length) => Math.ceil(length / EDGE));
      const target = (targets.clouds ??= this.pool.target(size[0], size[1], 3, this.format));
      this.begin(target);
      this.cloudPass.draw(clouds, nLamps, this.switches);
      target.textures.forEach((texture, i) => this.bind(UNITS.cloud_layers_map + i, texture));
      switches.CLOUDS = 1;
    }
    if (shafts) {
      const size = [intrinsics.width, intrinsics.height].map((length) => Math.ceil(length / Number(shafts.RATIO)));
      const target = (targets.shafts ??= this.pool.target(size[0], size[1], 1, this.format));
      this.draw("light_shafts", shafts, target);
      this.bind(UNITS.shaft_image, target.textures[0]);
      switches.SHAFTS = shafts.RATIO;
    }
    if (optics.linear) switches.LINEAR = 1;
    if (grey) switches.GREY = 1;
    this.draw("developed", switches, targets.colours);
    return targets.colours.textures[0];
  }

  /**
   * Draw a finished image into a framebuffer (null: the canvas), with its lower left corner at the pixel `corner`.
   *
   * `margin`: the columns and rows on each side of the image that are left out [px].
   */
  present(
    image: WebGLTexture, target: WebGLFramebuffer | null, corner: [number, number], { width, height }: Intrinsics,
    margin: [number, number], isFlipped: boolean,
  ): void {
    const { gl } = this;
    this.bind(UNITS.level_0, image);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(corner[0], corner[1], width, height);
    gl.viewport(corner[0] - margin[0], corner[1] - margin[1], width + 2 * margin[0], height + 2 * margin[1]);
    gl.useProgram(this.programs.get("presented", isFlipped ? {} : { FLIPPED: 1 }, "presented"));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.SCISSOR_TEST);
  }

  /** Draw the light that coarse levels scatter, and the lamps' veil, into the total of the first level. */
  private drawScattered({ sources, levels }: Targets, plan: BlurPlan, nVeils: number): void {
    const nLevels = plan.spreads.length;
    this.bind(UNITS.surface_image, this.radiance!);
    this.draw("scattered", { N_LEVELS: Math.min(nLevels, 1) }, sources[0]);
    if (nLevels > 1) {
      this.bind(UNITS.surface_image, sources[0].textures[1]);
      this.draw("scattered", { WIDE: 1, N_LEVELS: nLevels - 1 }, sources[1]);
    }
    for (let i = 2; i < sources.length; ++i) {
      sources[i - 1].textures.slice(1).forEach((texture, unit) => this.bind(UNITS.level_0 + unit, texture));
      this.draw("reduced", { N_LEVELS: sources[i].textures.length }, sources[i]);
    }
    for (let i = levels.length - 1; i >= 0; --i) {
      const spread = plan.spreads[i] ?? 0;
      const switches = kernelSwitches(spread);
      this.bind(UNITS.level_0, sources[i].textures[0]);
      if (spread > 0) {
        this.draw("blurred_rows", { ...switches }, levels[i].rows);
        this.bind(UNITS.level_0, levels[i].rows.textures[0]);
      }
      if (i + 1 < levels.length) {
        this.bind(UNITS.level_1, levels[i + 1].total.textures[0]);
        switches.WIDER = 1;
      }
      if (i === 0 && nVeils) {
        this.bind(UNITS.level_2, sources[0].textures.at(-1)!);
        switches.LAMPS = nVeils;
      }
      if (!nLevels) switches.VEIL_ONLY = 1;
      this.draw("blurred", switches, levels[i].total);
    }
  }

  private begin(target: Target): void {
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, target.buffer);
    this.gl.viewport(0, 0, target.width, target.height);
  }

  private draw(effect: string, switches: Switches, target: Target): void {
    const { gl } = this;
    this.begin(target);
    const vertex = OWN_VERTICES.includes(effect) ? effect : "screen";
    gl.useProgram(this.programs.get(effect, { ...this.switches, ...switches }, vertex));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  private bind(unit: number, texture: WebGLTexture): void {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
    this.gl.activeTexture(this.gl.TEXTURE0);
  }

  /** Return the weights of a medium for a plan as a texture. */
  private tableOf(optics: Optics, plan: BlurPlan): WebGLTexture {
    const key = plan.deviations.join();
    const entry = this.tables.find((table) => table.key === key && table.optics === optics.transform);
    if (entry) return entry.texture;
    if (this.tables.length >= MAX_TABLES) this.gl.deleteTexture(this.tables.shift()!.texture);
    const texture = this.pool.texture(N_SHARES, 1 + MAX_LEVELS, this.format);
    this.pool.upload(texture, N_SHARES, 1 + MAX_LEVELS, weightTable(optics, plan, 1 + MAX_LEVELS));
    this.tables.push({ optics: optics.transform, key, texture });
    return texture;
  }
}
