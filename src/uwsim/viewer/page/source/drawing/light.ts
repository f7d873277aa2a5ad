// Lamps, a projector, and the shadow maps of them and of the sun, as in uwsim.rendering.lights.
import type { Lamp, Projector } from "../head";
import {
  clipFromCamera, columns, inverse, origin, product, type Lens, type Matrix, matrix,
} from "../geometry";
import type { Piece } from "../models";
import { Programs } from "./shaders";
import type { Slots } from "./slots";
import { fit, findVisible, TO_TEXTURE } from "./visibility";

const SMALL_MAP = 512; // edge of the sun's shadow map [texel]
const LARGE_MAP = 1024; // its edge if texels of the small map are too large [texel]
const FINE_TEXEL = 0.008; // largest texel of the small map [m]
const TILE = 512; // edge of a lamp's shadow map [texel]
const MAX_HALF_ANGLE = (80 * Math.PI) / 180; // of a lamp with a shadow map [rad]
const LAMP_MARGIN = 1.02; // ratio of the field of a lamp's map to the lamp's cone
const MAX_SIDE = 1024; // longest side of a projector's shadow map [texel]

/** A lamp that is on; its intensity is the present one. */
export interface ActiveLamp {
  lamp: Lamp;
  worldFromLamp: Matrix;
}

/** A depth texture with its framebuffer. */
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

  /** Clear a part of the map, and draw there from now on. */
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

/** The shadow maps of sun, lamps and projector, and the values with which shaders read them. */
export class Shadows {
  private readonly suns: Record<number, DepthMap>;
  sunMap: DepthMap;
  textureFromWorld = matrix([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
  lift = 0;
  lampMaps: DepthMap | null = null;
  projectorMap: DepthMap | null = null;
  private sunKey = "";
  private readonly lampKeys: string[] = [];

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly programs: Programs,
    private readonly slots: Slots,
  ) {
    const maps = [SMALL_MAP, LARGE_MAP].map((size) => [size, new DepthMap(gl, size, size)]);
    this.suns = Object.fromEntries(maps) as Record<number, DepthMap>;
    this.sunMap = this.suns[SMALL_MAP];
  }

  castSun(casters: Piece[], sun: number[], version: number): void {
    const key = `${version} ${sun} ${casters.map((p) => `${p.instance.number}.${p.firstIndex}`)}`;
    if (key === this.sunKey) return;
    this.sunKey = key;
    const [clip, edge] = fit(casters, sun);
    const size = edge / SMALL_MAP <= FINE_TEXEL ? SMALL_MAP : LARGE_MAP;
    this.sunMap = this.suns[size];
    this.textureFromWorld = product(TO_TEXTURE, clip);
    this.lift = (1.5 * edge) / size;
    this.sunMap.begin(0, 0, size, size);
    this.draw(casters, clip);
  }

  castLamps(lamps: ActiveLamp[], pieces: Piece[], version: number): void {
    this.lampMaps ??= new DepthMap(this.gl, 2 * TILE, 2 * TILE);
    lamps.forEach(({ lamp, worldFromLamp }, tile) => {
      const key = lamp.shadow ? `${version} ${lamp.half_angle} ${worldFromLamp}` : "none";
      if (key === this.lampKeys[tile]) return;
      this.lampKeys[tile] = key;
      this.lampMaps!.begin(TILE * (tile % 2), TILE * (tile >> 1), TILE, TILE);
      if (lamp.shadow) this.castFrom(worldFromLamp, lampLens(lamp), pieces);
    });
  }

  castProjector(worldFromProjector: Matrix, lens: Lens, pieces: Piece[]): void {
    this.projectorMap ??= new DepthMap(this.gl, lens.width, lens.height);
    this.projectorMap.begin(0, 0, lens.width, lens.height);
    this.castFrom(worldFromProjector, lens, pieces);
  }

  private castFrom(worldFromLight: Matrix, lens: Lens, pieces: Piece[]): void {
    const clip = clipFromCamera(lens, true);
    const casters = findVisible(pieces, { worldFromCamera: worldFromLight, clip, lens });
    this.draw(casters.filter(isOpaque), product(clip, inverse(worldFromLight)), true);
  }

  private draw(casters: Piece[], clipFromWorld: Matrix, isFlipped = false): void {
    const gl = this.gl;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1.5, 2);
    gl.useProgram(this.programs.get("shadow", {}));
    this.slots.fill(clipFromWorld);
    for (const piece of casters) this.slots.drawPiece(piece, isFlipped);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }
}

export function isOpaque(piece: Piece): boolean {
  return piece.instance.visual.opacity >= 1;
}

function lampLens(lamp: Lamp): Lens {
  const focal = TILE / 2 / (LAMP_MARGIN * Math.tan(Math.min(lamp.half_angle, MAX_HALF_ANGLE)));
  const c = (TILE - 1) / 2;
  return { width: TILE, height: TILE, fx: focal, fy: focal, cx: c, cy: c, skew: 0, near: 0.1, far: 20 };
}

export function projectorLens(projector: Projector, columns: number, rows: number): Lens {
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
export function lampBlock(lamps: ActiveLamp[], worldFromCamera: Matrix): Float32Array<ArrayBuffer> {
  const block = new Float32Array(4 * 16 + 3 * 16);
  const cameraFromWorld = inverse(worldFromCamera);
  lamps.forEach(({ lamp, worldFromLamp }, tile) => {
    const [x, y] = [0.25 + 0.5 * (tile % 2), 0.25 + 0.5 * (tile >> 1)];
    const tileFromClip = matrix([0.25, 0, 0, x, 0, 0.25, 0, y, 0, 0, 0.5, 0.5, 0, 0, 0, 1]);
    const map = product(tileFromClip, clipFromCamera(lampLens(lamp), true));
    block.set(columns(product(product(map, inverse(worldFromLamp)), worldFromCamera)), 16 * tile);
    const cameraFromLamp = product(cameraFromWorld, worldFromLamp);
    const cosOuter = Math.cos(lamp.half_angle);
    const cosInner = Math.cos((1 - lamp.softness) * lamp.half_angle);
    const texel = (2 * LAMP_MARGIN * Math.tan(lamp.half_angle)) / TILE;
    const m = cameraFromLamp;
    block.set([...origin(m), cosOuter], 64 + 4 * tile);
    block.set([m[2], m[6], m[10], 1 / Math.max(cosInner - cosOuter, 1e-5)], 80 + 4 * tile);
    block.set([...lamp.colour.map((c) => c * lamp.intensity), 1.5 * texel], 96 + 4 * tile);
  });
  return block;
}

/** Return the values of the uniform block Projector (projector.glsl). */
export function projectorBlock(
  projector: Projector, worldFromProjector: Matrix, lens: Lens, worldFromCamera: Matrix,
): Float32Array<ArrayBuffer> {
  const projectorFromCamera = product(inverse(worldFromProjector), worldFromCamera);
  const map = product(TO_TEXTURE, clipFromCamera(lens, true));
  const m = inverse(projectorFromCamera);
  return Float32Array.from([
    ...columns(product(map, projectorFromCamera)),
    ...origin(m), projector.laser ? 1 : 0,
    m[2], m[6], m[10], 1.5 / Math.min(lens.fx, lens.fy),
  ]);
}
