// The renderer: it draws a scene through its water with the shaders of uwsim.rendering.renderer.
import type { Head } from "../head";
import { clipFromCamera, inverse, origin, rotationOf, scaleIntrinsics, unit, widenIntrinsics, type Intrinsics } from "../geometry";
import { isOpaque, lampBlockValues, projectorBlockValues, projectorIntrinsics, Shadows } from "./light";
import type { Optics } from "../water/medium";
import type { Models, Piece } from "../models";
import { opticsBlockValues } from "../water/optics";
import { Development } from "../water/development";
import { findVisibleClouds, findVisibleParticles } from "../water/visible_particles";
import { FocusedLight, type FocusedImage } from "../water/caustics/focused_light";
import { SurfacePass } from "../water/surface/surface_pass";
import { frameBlockValues, type RenderState } from "./frame";
import { BLOCKS, Programs, UNITS, type Switches } from "./shaders";
import { isSoftware } from "./pacing";
import { InstanceBlocks } from "./instance_blocks";
import { canSkipMipmaps, findCasters, findLowestPoint, findVisible, type Eye } from "./visibility";

const MAX_BLURRED_PIXELS = 320 * 240; // greatest size of an image that a software renderer blurs [px]
const MAX_LAMPS = 4; // number of lamps that the shaders can light a scene with

export class Renderer {
  private readonly isSoftware: boolean;
  private readonly programs: Programs;
  private readonly instanceBlocks: InstanceBlocks;
  private readonly shadows: Shadows;
  private readonly blocks: Record<string, WebGLBuffer> = {};
  private readonly samplers: WebGLSampler[];
  private readonly development: Development | null; // the passes of physical water, if the scene has it
  private readonly surfacePass: SurfacePass | null; // the passes of the water's surface, if images show it
  private surfaceValues = new Float32Array(0); // of the uniform block Surface
  private readonly focusedLight: FocusedLight | null; // caustics and light shafts, if the surface focuses light

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly head: Head,
    private readonly models: Models,
  ) {
    this.isSoftware = isSoftware(gl);
    this.programs = new Programs(gl);
    this.instanceBlocks = new InstanceBlocks(gl, models);
    this.shadows = new Shadows(gl, this.programs, this.instanceBlocks);
    const { nodes } = head.water;
    this.development = nodes ? Development.make(gl, this.programs, nodes) : null;
    this.surfacePass =
      head.surface && this.development
        ? new SurfacePass(gl, this.programs, head.surface, this.development.format, this.development.switches)
        : null;
    this.focusedLight =
      head.caustics && this.development ? new FocusedLight(gl, head.caustics, this.development.format) : null;
    this.samplers = [gl.CLAMP_TO_EDGE, gl.REPEAT].map((wrap) => {
      const sampler = gl.createSampler();
      gl.samplerParameteri(sampler, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
      gl.samplerParameteri(sampler, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
      gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_S, wrap);
      gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_T, wrap);
      return sampler;
    });
  }

  /** True if physical water is drawn with the fog law, because this browser cannot draw into textures of floats. */
  get lacksFloats(): boolean {
    return Boolean(this.head.water.nodes) && !this.development;
  }

  /** Draw an image into a framebuffer (null: the canvas), with the image's lower left corner at the pixel `corner` [px]. */
  draw(state: RenderState, target: WebGLFramebuffer | null, corner: [number, number], isFlipped = false): void {
    if (state.optics && this.development) this.drawPhysical(state, state.optics, target, corner, isFlipped);
    else this.drawSurfaces(state, target, corner, isFlipped, {});
  }

  /** Draw an image through physical water: surfaces without water first, then passes on the whole image. */
  private drawPhysical(
    state: RenderState, optics: Optics, target: WebGLFramebuffer | null, corner: [number, number], isFlipped: boolean,
  ): void {
    const development = this.development!;
    const { worldFromCamera, water } = state;
    const isFast = this.isSoftware && !state.isExact;
    // without multisampling, edges are smooth if each pixel is the mean of four
    const samples = this.isSoftware || state.isExact || devicePixelRatio >= 2 ? 1 : 2;
    const { width, height } = state.intrinsics;
    const hasBlur = optics.blur && !(isFast && width * height > MAX_BLURRED_PIXELS);
    const margin = [width, height].map((n) => Math.round(hasBlur ? optics.blur_margin * n : 0)) as [number, number];
    const intrinsics = scaleIntrinsics(widenIntrinsics(state.intrinsics, ...margin), samples);
    const plan = development.plan(intrinsics, hasBlur);
    const lamps = state.lamps.slice(0, MAX_LAMPS);
    const depth = water.surface_height - origin(worldFromCamera)[2];
    const surfacePass = state.surface ? this.surfacePass : null;
    if (surfacePass) {
      this.surfaceValues = surfacePass.prepare(
        state.surface!, optics, water.surface_height, worldFromCamera, intrinsics, water.light_rate,
      );
      this.fill("Surface", this.surfaceValues);
    }
    const surfaces = development.prepare(
      optics, worldFromCamera, intrinsics, plan, depth, water.light_rate, surfacePass !== null,
    );
    this.fill("Optics", opticsBlockValues(optics, intrinsics, lamps, water.light_rate, plan.reach));
    const isDirect = surfacePass?.isDirect;
    const plainLaw = { PHYSICAL: 1, ...(surfacePass ? { SKY: 1 } : {}), ...development.switches };
    if (surfacePass) this.drawMirror(state, optics, surfacePass, intrinsics, plainLaw);
    const focusing = this.focusLight(state, optics);
    const law = { ...plainLaw, ...focusing?.surfaces };
    this.drawSurfaces(
      { ...state, intrinsics, grey: false }, surfaces, [0, 0], true, law, () => isDirect && surfacePass!.drawAmong(),
    );
    if (lamps.length) development.drawLampPoints(lamps.length);
    if (surfacePass && !isDirect) {
      const isAbove = ({ corners }: Piece) => corners.some((corner) => corner[2] > water.surface_height);
      development.drawOver(() => surfacePass.draw(this.shownPieces(state).some(isAbove)));
    }
    this.gl.disable(this.gl.DEPTH_TEST);
    const particles = findVisibleParticles(this.head.particles, state, intrinsics);
    const clouds = findVisibleClouds(this.head.particles, state);
    const image = development.develop(
      optics, intrinsics, plan, lamps.length, state.grey === true, particles, clouds, focusing?.shafts ?? null,
    );
    development.present(image, target, corner, state.intrinsics, margin, isFlipped);
  }

  /** Draw the bodies that the water's surface mirrors, if there are any. */
  private drawMirror(state: RenderState, optics: Optics, surfacePass: SurfacePass, lens: Intrinsics, law: Switches): void {
    const { surface_height } = state.water;
    const mirror = surfacePass.mirrorView(optics, surface_height, state.worldFromCamera, lens);
    if (!mirror) return;
    const { pose, intrinsics, values, isMirrored } = mirror;
    const eye: Eye = { worldFromCamera: pose, clip: clipFromCamera(intrinsics, true), intrinsics };
    const pieces = this.shownPieces(state).filter(({ corners }) => corners.some(isMirrored));
    if (!findVisible(pieces, eye).length) return;
    const view = { ...state, worldFromCamera: pose, intrinsics, grey: false };
    const focusing = state.surface!.waves ? null : this.focusLight(view, optics);
    const target = this.development!.mirrorTarget(intrinsics);
    this.fill("Surface", values);
    this.drawSurfaces(view, target.buffer, [0, 0], true, { ...law, ...mirror.switches, ...focusing?.surfaces });
    this.fill("Surface", this.surfaceValues);
    surfacePass.setMirror(target.textures[0]);
  }

  /** Prepare caustics and light shafts; return what the image needs of them (null: nothing). */
  private focusLight(state: RenderState, optics: Optics): FocusedImage | null {
    const focusing = this.focusedLight?.prepare(state, optics, findLowestPoint(this.models)) ?? null;
    if (focusing) this.fill("Caustics", focusing.values);
    return focusing;
  }

  /**
   * Draw surfaces and background with some switches of the law of the water: none for the fog law.
   *
   * `drawAmong` draws between opaque and transparent surfaces.
   */
  private drawSurfaces(
    state: RenderState, target: WebGLFramebuffer | null, corner: [number, number], isFlipped: boolean, law: Switches,
    drawAmong: () => void = () => undefined,
  ): void {
    const { gl } = this;
    const { worldFromCamera, intrinsics, water } = state;
    const clip = clipFromCamera(intrinsics, isFlipped);
    const eye: Eye = { worldFromCamera, clip, intrinsics };
    const pieces = this.shownPieces(state);
    const visiblePieces = findVisible(pieces, eye);
    const switches: Switches = { COLOUR: 0, ...law };
    const isFoggy = water.fog > 0;
    if (!law.PHYSICAL && !isFoggy) switches.NO_FOG = 1;
    if (!law.PHYSICAL && isFoggy && water.clip && !state.isExternal) switches.FOG_CLIP = 1;
    if (state.grey) switches.GREY = 1;
    if (state.isExternal) Object.assign(switches, law.SKY ? { POLISHED: 1 } : { AIR: 1, POLISHED: 1 });
    if (state.isExternal && !this.isSoftware) switches.SOFT = 1;
    const sun = law.PHYSICAL ? state.optics!.sun : unit(this.head.suns[water.sun].direction);
    const maxHullHeight = law.PHYSICAL ? water.surface_height : -Infinity;
    const shadows = water.shadows ? findCasters(this.models, pieces, visiblePieces, sun, eye, maxHullHeight) : null;
    if (shadows?.casters.length) {
      this.shadows.updateSunShadows(shadows.casters, sun, this.models.version);
      switches.SHADOWS = 1;
    }
    if (shadows?.hasHulls) switches.HULLS = 1;
    this.bind(UNITS.shadow_map, this.shadows.sunMap.texture);
    this.lightScene(state, pieces, switches);
    this.fill("Frame", frameBlockValues(state, this.head, clip, sun, this.shadows));
    this.instanceBlocks.fill(inverse(worldFromCamera), rotationOf(worldFromCamera));
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(corner[0], corner[1], intrinsics.width, intrinsics.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(corner[0], corner[1], intrinsics.width, intrinsics.height);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.disable(gl.BLEND);
    for (const piece of visiblePieces.filter(isOpaque)) this.drawPiece(piece, eye, switches, isFlipped);
    this.drawBackground(state.grey ? { COLOUR: 0, GREY: 1, ...law } : { COLOUR: 0, ...law });
    drawAmong();
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);
    gl.depthMask(false);
    for (const piece of visiblePieces.filter((piece) => !isOpaque(piece)).reverse()) {
      const opacity = Math.round(255 * piece.instance.visual.opacity);
      if (opacity > 0) this.drawPiece(piece, eye, { ...switches, OPACITY: opacity }, isFlipped);
    }
    this.models.maps?.release();
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindVertexArray(null);
  }

  private shownPieces({ isExternal }: RenderState): Piece[] {
    return this.models.instances
      .filter(({ visual, isPresent }) => isPresent && (isExternal || !visual.hidden))
      .flatMap(({ pieces }) => pieces);
  }

  private lightScene(state: RenderState, pieces: Piece[], switches: Switches): void {
    const lamps = state.lamps.slice(0, MAX_LAMPS);
    if (lamps.length) {
      switches.LAMPS = lamps.length;
      this.shadows.updateLampShadows(lamps, pieces, this.models.version);
      this.bind(UNITS.lamp_maps, this.shadows.lampMaps!.texture);
      this.fill("Lamps", lampBlockValues(lamps, state.worldFromCamera));
    }
    const { projector } = this.head;
    if (!projector) return;
    switches.PROJECTOR = 1;
    const { width, height } = this.head.textures[projector.pattern];
    const worldFromProjector = this.models.worldFromMount(projector);
    const intrinsics = projectorIntrinsics(projector, width, height);
    this.shadows.updateProjectorShadows(worldFromProjector, intrinsics, pieces);
    this.bind(UNITS.projector_map, this.shadows.projectorMap!.texture);
    this.bind(UNITS.projector_pattern, this.models.patterns[0]);
    this.fill("Projector", projectorBlockValues(projector, worldFromProjector, intrinsics, state.worldFromCamera));
  }

  private drawPiece(piece: Piece, eye: Eye, switches: Switches, isFlipped: boolean): void {
    const [{ gl }, { texture, repeats, visual }] = [this, piece.instance];
    const plainSamplers = canSkipMipmaps(piece, eye) ? this.samplers : null;
    const surface = this.models.maps!.use(visual.material, texture ? { ...switches, TEXTURED: 1 } : switches, plainSamplers);
    if (texture) {
      const samplers = plainSamplers ?? this.models.maps!.baseSamplers(surface);
      this.bind(UNITS.base_map, texture);
      gl.bindSampler(UNITS.base_map, samplers && samplers[Number(repeats)]);
    }
    gl.useProgram(this.programs.get("surface", surface));
    this.instanceBlocks.drawPiece(piece, isFlipped);
  }

  private drawBackground(switches: Switches): void {
    const { gl } = this;
    gl.bindSampler(UNITS.base_map, null);
    gl.disable(gl.CULL_FACE);
    gl.bindVertexArray(null);
    gl.useProgram(this.programs.get("background", switches));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  private fill(name: string, values: Float32Array<ArrayBuffer>): void {
    const { gl } = this;
    this.blocks[name] ??= gl.createBuffer();
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.blocks[name]);
    gl.bufferData(gl.UNIFORM_BUFFER, values, gl.STREAM_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, BLOCKS[name], this.blocks[name]);
  }

  private bind(unit: number, texture: WebGLTexture): void {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
    this.gl.activeTexture(this.gl.TEXTURE0);
  }
}
