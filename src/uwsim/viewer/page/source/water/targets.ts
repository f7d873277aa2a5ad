// The textures in which the passes of physical water draw.
import type { Intrinsics } from "../geometry";

/** A texture, or several of one size, in which passes draw. */
export interface Target {
  buffer: WebGLFramebuffer;
  textures: WebGLTexture[];
  width: number;
  height: number;
  depth?: WebGLRenderbuffer;
}

/** The targets of images of one size. */
export interface Targets {
  /** The radiance and the range of surfaces. */
  surfaces: Target;
  /** The same with the water's surface above it; null until it is needed. */
  wateredSurfaces: Target | null;
  colours: Target;
  /** The sum of the particles; null until there are any. */
  particles: Target | null;
  /** The layers, the lamplight and the daylight of clouds of sediment; null until there are any. */
  clouds: Target | null;
  /** The bodies that the surface mirrors; null until there are any. */
  mirror: Target | null;
  /** The light shafts; null until there are any. */
  shafts: Target | null;
  /** The scattered light of the coarse levels: of the first one with the mean light; of all others; of these without the narrowest ... */
  sources: Target[];
  /** Each coarse level after the Gaussian along its rows, and after both with the wider levels. */
  levels: { rows: Target; total: Target }[];
}

/** The targets of images of all sizes, and the textures of the passes. */
export class TargetPool {
  private readonly entries = new Map<string, Targets>();

  constructor(
    private readonly gl: WebGL2RenderingContext,
    /** The format of the textures. */
    readonly format: number,
  ) {}

  /** Return the targets of images of a size with some levels of blur. */
  find({ width, height }: Intrinsics, nLevels: number): Targets {
    const { gl, format } = this;
    const key = `${width} ${height} ${nLevels}`;
    let targets = this.entries.get(key);
    if (targets) return targets;
    if (this.entries.size > 7) this.deleteAll(); // after changes of the window's size
    targets = {
      surfaces: this.depthTarget(width, height), wateredSurfaces: null,
      colours: this.target(width, height, 1, gl.RGBA8), particles: null, clouds: null, shafts: null, mirror: null, sources: [], levels: [],
    };
    let [w, h] = [width, height];
    for (let level = 0; level < Math.max(nLevels, 1); ++level) {
      [w, h] = [Math.ceil(w / 2), Math.ceil(h / 2)];
      const nTextures = level === 0 ? Math.min(nLevels, 1) + 1 : nLevels - level;
      targets.sources.push(this.target(w, h, nTextures, format));
      targets.levels.push({ rows: this.target(w, h, 1, format), total: this.target(w, h, 1, format) });
    }
    this.entries.set(key, targets);
    return targets;
  }

  /** Return a target of radiance and range with a depth buffer. */
  depthTarget(width: number, height: number): Target {
    const { gl } = this;
    const depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    const target = this.target(width, height, 1, this.format);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    return { ...target, depth };
  }

  /** Return a target of one size with some textures. */
  target(width: number, height: number, nTextures: number, format: number): Target {
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

  /** Return a texture that is interpolated. */
  texture(width: number, height: number, format: number): WebGLTexture {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    return texture;
  }

  /** Set all texels of a texture. */
  upload(texture: WebGLTexture, width: number, height: number, values: Float32Array<ArrayBuffer>): void {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA, gl.FLOAT, values);
  }

  private deleteAll(): void {
    const { gl } = this;
    for (const { surfaces, wateredSurfaces, colours, particles, clouds, shafts, mirror, sources, levels } of this.entries.values())
      for (const target of [
        surfaces, colours, ...[wateredSurfaces, particles, clouds, shafts, mirror].filter((target) => target !== null), ...sources,
        ...levels.flatMap(({ rows, total }) => [rows, total]),
      ]) {
        for (const texture of target.textures) gl.deleteTexture(texture);
        gl.deleteFramebuffer(target.buffer);
        if (target.depth) gl.deleteRenderbuffer(target.depth);
      }
    this.entries.clear();
  }
}
