// Images through physical water: the passes on whole images after the surfaces, as in uwsim.rendering.physical.development.
import type { Optics } from "./medium";
import type { Intrinsics, Matrix } from "../geometry";
import { kernelSwitches, MAX_LEVELS, planBlur, type BlurPlan } from "./blur_plan";
import { N_RANGES, weightTable } from "./blur_weights";
import { openWaterMap, MAP_SIZE } from "./open_water";
import { ParticlePass, type VisibleParticles } from "./particle_pass";
import type { Target, Targets } from "./targets";
import { UNITS, type Programs, type Switches } from "../drawing/shaders";

const MAX_TABLES = 16; // greatest number of tables of weights that are kept
const HALF_FAR = "6e4"; // range of pixels without a surface in half floats [m]

/** The passes of physical water. */
export class Development {
  /** The switches of all programs that depend on the format of the textures. */
  readonly switches: Switches;
  /** The format of the textures. */
  readonly format: number;
  private readonly particlePass: ParticlePass;
  private readonly map: WebGLTexture;
  private readonly tables: { optics: Optics["transform"]; key: string; texture: WebGLTexture }[] = [];
  private table: WebGLTexture | null = null; // the weights of the prepared image
  private readonly targets = new Map<string, Targets>();
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
    this.map = this.texture(MAP_SIZE[0], MAP_SIZE[1], this.format);
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
    this.upload(this.map, MAP_SIZE[0], MAP_SIZE[1], openWaterMap(optics, worldFromCamera, intrinsics, depth, lightRate, hasSurface));
    this.bind(UNITS.open_water_map, this.map);
    if (this.table) this.bind(UNITS.weight_table, this.table);
    this.currentTargets = this.targetsOf(intrinsics, plan);
    this.radiance = this.currentTargets.surfaces.textures[0];
    return this.currentTargets.surfaces.buffer;
  }

  /** Draw into a second image, of which the image of surfaces is the source; it is developed instead. */
  drawOver(draw: () => void): void {
    const { gl } = this;
    const targets = this.currentTargets!;
    const { width, height } = targets.surfaces;
    const target = (targets.wateredSurfaces ??= this.depthTarget(width, height));
    this.bind(UNITS.surface_image, targets.surfaces.textures[0]);
    this.begin(target);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    draw();
    this.radiance = target.textures[0];
  }

  /** Draw the finished image of prepared surfaces; row 0 of the texture is the top. */
  develop(
    optics: Optics, intrinsics: Intrinsics, plan: BlurPlan, nLamps: number, grey: boolean,
    particles: VisibleParticles | null,
  ): WebGLTexture {
    const targets = this.targetsOf(intrinsics, plan);
    const nVeils = optics.lamp_veil ? nLamps : 0;
    const switches: Switches = this.table ? { BLUR: 1 } : {};
    if (plan.spreads.length || nVeils) {
      this.drawScattered(targets, plan, nVeils);
      this.bind(UNITS.level_0, targets.levels[0].total.textures[0]);
      switches.SCATTERED = 1;
    }
    this.bind(UNITS.surface_image, this.radiance!);
    if (particles) {
      const target = (targets.particles ??= this.target(intrinsics.width, intrinsics.height, 1, this.format));
      this.begin(target);
      this.particlePass.draw(particles, nLamps, this.switches);
      this.bind(UNITS.particle_image, target.textures[0]);
      switches.PARTICLES = 1;
    }
    if (optics.linear) switches.LINEAR = 1;
    if (grey) switches.GREY = 1;
    this.draw("developed", switches, targets.colours);
    return targets.colours.textures[0];
  }

  /** Draw a finished image into a framebuffer (null: the canvas), with its lower left corner at the pixel `corner`. */
  present(
    image: WebGLTexture, target: WebGLFramebuffer | null, corner: [number, number], { width, height }: Intrinsics,
    isFlipped: boolean,
  ): void {
    const { gl } = this;
    this.bind(UNITS.level_0, image);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(corner[0], corner[1], width, height);
    gl.useProgram(this.programs.get("presented", isFlipped ? {} : { FLIPPED: 1 }, "presented"));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
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
    gl.useProgram(this.programs.get(effect, { ...this.switches, ...switches }, "screen"));
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
    const texture = this.texture(N_RANGES, 1 + MAX_LEVELS, this.format);
    this.upload(texture, N_RANGES, 1 + MAX_LEVELS, weightTable(optics, plan, 1 + MAX_LEVELS));
    this.tables.push({ optics: optics.transform, key, texture });
    return texture;
  }

  private targetsOf({ width, height }: Intrinsics, plan: BlurPlan): Targets {
    const { gl, format } = this;
    const nLevels = plan.deviations.length;
    const key = `${width} ${height} ${nLevels}`;
    let targets = this.targets.get(key);
    if (targets) return targets;
    if (this.targets.size > 7) this.deleteTargets(); // after changes of the window's size
    targets = {
      surfaces: this.depthTarget(width, height), wateredSurfaces: null,
      colours: this.target(width, height, 1, gl.RGBA8), particles: null, sources: [], levels: [],
    };
    let [w, h] = [width, height];
    for (let level = 0; level < Math.max(nLevels, 1); ++level) {
      [w, h] = [Math.ceil(w / 2), Math.ceil(h / 2)];
      const nTextures = level === 0 ? Math.min(nLevels, 1) + 1 : nLevels - level;
      targets.sources.push(this.target(w, h, nTextures, format));
      targets.levels.push({ rows: this.target(w, h, 1, format), total: this.target(w, h, 1, format) });
    }
    this.targets.set(key, targets);
    return targets;
  }

  /** Return a target of radiance and range with a depth buffer. */
  private depthTarget(width: number, height: number): Target {
    const { gl } = this;
    const depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    const target = this.target(width, height, 1, this.format);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    return { ...target, depth };
  }

  private target(width: number, height: number, nTextures: number, format: number): Target {
    const { gl } = this;
    const textures = Array.from({ length: nTextures }, () => this.texture(width, height, format));
    const buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    textures.forEach((texture, i) =>
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, texture, 0),
    );
    gl.drawBuffers(textures.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    return { buffer, textures, width, height };
  }

  private texture(width: number, height: number, format: number): WebGLTexture {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    return texture;
  }

  private upload(texture: WebGLTexture, width: number, height: number, values: Float32Array<ArrayBuffer>): void {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA, gl.FLOAT, values);
  }

  private deleteTargets(): void {
    const { gl } = this;
    for (const { surfaces, wateredSurfaces, colours, particles, sources, levels } of this.targets.values())
      for (const target of [surfaces, colours, ...[wateredSurfaces, particles].filter((target) => target !== null), ...sources, ...levels.flatMap(({ rows, total }) => [rows, total])]) {
        for (const texture of target.textures) gl.deleteTexture(texture);
        gl.deleteFramebuffer(target.buffer);
        if (target.depth) gl.deleteRenderbuffer(target.depth);
      }
    this.targets.clear();
  }
}
