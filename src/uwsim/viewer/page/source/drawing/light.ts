// Lamps and the projector, and the shadow maps of all lights, as in uwsim.rendering.lights.
import type { Lamp, Projector } from "../head";
import {
  clipFromCamera, columns, inverse, origin, product, type Intrinsics, type Matrix, matrix,
} from "../geometry";
import type { Piece } from "../models";
import { maskSwitches } from "./material";
import { Programs, UNITS } from "./shaders";
import type { InstanceBlocks } from "./instance_blocks";
import { findVisible, fitSunView, TEXTURE_FROM_CLIP } from "./visibility";

const SMALL_MAP = 512; // edge of the sun's smaller shadow map [texel]
const LARGE_MAP = 1024; // edge of the sun's larger shadow map [texel]
const FINE_TEXEL = 0.008; // largest size of a texel for which the smaller map is used [m]
const LAMP_MAP_SIZE = 512; // edge of a lamp's shadow map [texel]
const MAX_HALF_ANGLE = (80 * Math.PI) / 180; // greatest half angle of the cone that a lamp's shadow map covers [rad]
const LAMP_MARGIN = 1.02; // ratio of the field of view of a lamp's shadow map to the lamp's cone
const MAX_SIDE = 1024; // longest side of a projector's shadow map [texel]

/** A lamp that is on. */
export interface ActiveLamp {
  /** The lamp with its present intensity. */
  lamp: Lamp;
  /** The index of the lamp in the head. */
  index: number;
  worldFromLamp: Matrix;
}

/** A depth texture that shaders compare depths with, and its framebuffer. */
export class DepthMap {
  readonly texture: WebGLTexture;
  private readonly buffer: WebGLFramebuffer;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    readonly width: number,
    readonly height: number,
  ) {
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, width, height);
    for (const [name, value] of [
      [gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE],
      [gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL],
      [gl.TEXTURE_MIN_FILTER, gl.LINEAR],
      [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
      [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
      [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
    ])
      gl.texParameteri(gl.TEXTURE_2D, name, value);
    this.buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.buffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.texture, 0);
    gl.drawBuffers([gl.NONE]);
    this.begin(0, 0, width, height);
  }

  /** Clear a rectangle of the map, and draw into that rectangle from now on [texel]. */
  begin(x: number, y: number, width: number, height: number): void {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.buffer);
    gl.viewport(x, y, width, height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(x, y, width, height);
    gl.depthMask(true);
    gl.clearDepth(1);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.disable(gl.SCISSOR_TEST);
  }
}

/** The shadow maps of the sun, lamps and projector, and the values that shaders need to read them. */
export class Shadows {
  private readonly suns: Record<number, DepthMap>; // the shadow maps of the sun by their edge [texel]
  /** The shadow map of the sun that was drawn last. */
  sunMap: DepthMap;
  /** The transform from W to the texture coordinates of `sunMap` and the depth in it. */
  textureFromWorld = matrix([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
  /** The distance by which surfaces are lifted along their normals, so that they do not shade themselves [m]. */
  lift = 0;
  /** The shadow maps of up to four lamps, as the quarters of one texture. */
  lampMaps: DepthMap | null = null;
  projectorMap: DepthMap | null = null;
  private sunKey = ""; // what `sunMap` was drawn from, as a text
  private readonly lampKeys: string[] = []; // what each lamp's shadow map was drawn from, as a text

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly programs: Programs,
    private readonly instanceBlocks: InstanceBlocks,
  ) {
    const maps = [SMALL_MAP, LARGE_MAP].map((size) => [size, new DepthMap(gl, size, size)]);
    this.suns = Object.fromEntries(maps) as Record<number, DepthMap>;
    this.sunMap = this.suns[SMALL_MAP];
  }

  /** Draw the sun's shadow map if casters or the version of the poses have changed; `sun` points towards the sun in W. */
  updateSunShadows(casters: Piece[], sun: number[], version: number): void {
    const key = `${version} ${sun} ${casters.map((p) => `${p.instance.index}.${p.firstIndex}`)}`;
    if (key === this.sunKey) return;
    this.sunKey = key;
    const [clipFromWorld, edge] = fitSunView(casters, sun);
    const size = edge / SMALL_MAP <= FINE_TEXEL ? SMALL_MAP : LARGE_MAP;
    this.sunMap = this.suns[size];
    this.textureFromWorld = product(TEXTURE_FROM_CLIP, clipFromWorld);
    this.lift = (1.5 * edge) / size;
    this.sunMap.begin(0, 0, size, size);
    this.draw(casters, clipFromWorld);
  }

  /** Draw the shadow maps of the lamps that have changed. */
  updateLampShadows(lamps: ActiveLamp[], pieces: Piece[], version: number): void {
    this.lampMaps ??= new DepthMap(this.gl, 2 * LAMP_MAP_SIZE, 2 * LAMP_MAP_SIZE);
    lamps.forEach(({ lamp, worldFromLamp }, tile) => {
      const key = lamp.shadow ? `${version} ${lamp.half_angle} ${worldFromLamp}` : "none";
      if (key === this.lampKeys[tile]) return;
      this.lampKeys[tile] = key;
      const [column, row] = [tile % 2, tile >> 1];
      this.lampMaps!.begin(LAMP_MAP_SIZE * column, LAMP_MAP_SIZE * row, LAMP_MAP_SIZE, LAMP_MAP_SIZE);
      if (lamp.shadow) this.drawShadowMap(worldFromLamp, lampIntrinsics(lamp), pieces);
    });
  }

  /** Draw the shadow map of the projector. */
  updateProjectorShadows(worldFromProjector: Matrix, intrinsics: Intrinsics, pieces: Piece[]): void {
    this.projectorMap ??= new DepthMap(this.gl, intrinsics.width, intrinsics.height);
    this.projectorMap.begin(0, 0, intrinsics.width, intrinsics.height);
    this.drawShadowMap(worldFromProjector, intrinsics, pieces);
  }

  /** Draw the shadow map of a light with a pose and intrinsics. */
  private drawShadowMap(worldFromLight: Matrix, intrinsics: Intrinsics, pieces: Piece[]): void {
    const clip = clipFromCamera(intrinsics, true);
    const casters = findVisible(pieces, { worldFromCamera: worldFromLight, clip, intrinsics });
    this.draw(casters.filter(isOpaque), product(clip, inverse(worldFromLight)), true);
  }

  /** Draw the depths of pieces into the current map. */
  private draw(casters: Piece[], clipFromWorld: Matrix, isFlipped = false): void {
    const gl = this.gl;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1.5, 2);
    this.instanceBlocks.fill(clipFromWorld);
    for (const piece of casters) {
      const { texture, visual } = piece.instance;
      const mask = texture ? maskSwitches(visual.material) : {};
      gl.useProgram(this.programs.get("shadow", mask));
      if (mask.ALPHA_TEST) {
        gl.activeTexture(gl.TEXTURE0 + UNITS.base_map);
        gl.bindTexture(gl.TEXTURE_2D, texture);
      }
      this.instanceBlocks.drawPiece(piece, isFlipped);
    }
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }
}

export function isOpaque(piece: Piece): boolean {
  return piece.instance.visual.opacity >= 1;
}

/** Return the intrinsics of a lamp's shadow map. */
function lampIntrinsics(lamp: Lamp): Intrinsics {
  const focal = LAMP_MAP_SIZE / 2 / (LAMP_MARGIN * Math.tan(Math.min(lamp.half_angle, MAX_HALF_ANGLE)));
  const c = (LAMP_MAP_SIZE - 1) / 2;
  const [width, height] = [LAMP_MAP_SIZE, LAMP_MAP_SIZE];
  return { width, height, fx: focal, fy: focal, cx: c, cy: c, skew: 0, near: 0.1, far: 20 };
}

/** Return the intrinsics of a projector's shadow map, for a pattern of some columns and rows [px]. */
export function projectorIntrinsics(projector: Projector, columns: number, rows: number): Intrinsics {
  const scale = MAX_SIDE / Math.max(rows, columns);
  const width = Math.max(1, Math.round(scale * columns));
  const height = Math.max(1, Math.round(scale * rows));
  const half = Math.tan(projector.fovy / 2);
  return {
    width, height, fx: width / 2 / ((half * columns) / rows), fy: height / 2 / half,
    cx: (width - 1) / 2, cy: (height - 1) / 2, skew: 0, near: 0.1, far: 20,
  };
}

/** Return the values of the uniform block Lamps (lamps.glsl), for at most four lamps. */
export function lampBlockValues(lamps: ActiveLamp[], worldFromCamera: Matrix): Float32Array<ArrayBuffer> {
  const block = new Float32Array(4 * 16 + 3 * 16);
  const cameraFromWorld = inverse(worldFromCamera);
  lamps.forEach(({ lamp, worldFromLamp }, tile) => {
    const [x, y] = [0.25 + 0.5 * (tile % 2), 0.25 + 0.5 * (tile >> 1)];
    const tileFromClip = matrix([0.25, 0, 0, x, 0, 0.25, 0, y, 0, 0, 0.5, 0.5, 0, 0, 0, 1]);
    const map = product(tileFromClip, clipFromCamera(lampIntrinsics(lamp), true));
    block.set(columns(product(product(map, inverse(worldFromLamp)), worldFromCamera)), 16 * tile);
    const cameraFromLamp = product(cameraFromWorld, worldFromLamp);
    const cosOuter = Math.cos(lamp.half_angle);
    const cosInner = Math.cos((1 - lamp.softness) * lamp.half_angle);
    const texel = (2 * LAMP_MARGIN * Math.tan(lamp.half_angle)) / LAMP_MAP_SIZE;
    const m = cameraFromLamp;
    block.set([...origin(m), cosOuter], 64 + 4 * tile);
    block.set([m[2], m[6], m[10], 1 / Math.max(cosInner - cosOuter, 1e-5)], 80 + 4 * tile);
    block.set([...lamp.colour.map((c) => c * lamp.intensity), 1.5 * texel], 96 + 4 * tile);
  });
  return block;
}

/** Return the values of the uniform block Projector (projector.glsl). */
export function projectorBlockValues(
  projector: Projector, worldFromProjector: Matrix, intrinsics: Intrinsics, worldFromCamera: Matrix,
): Float32Array<ArrayBuffer> {
  const projectorFromCamera = product(inverse(worldFromProjector), worldFromCamera);
  const map = product(TEXTURE_FROM_CLIP, clipFromCamera(intrinsics, true));
  const m = inverse(projectorFromCamera);
  return Float32Array.from([
    ...columns(product(map, projectorFromCamera)),
    ...origin(m), projector.laser ? 1 : 0,
    m[2], m[6], m[10], 1.5 / Math.min(intrinsics.fx, intrinsics.fy),
  ]);
}
