// The textures in which the passes of physical water draw.

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
  /** The scattered light of the coarse levels: of the first one with the mean light; of all others; of these without the narrowest ... */
  sources: Target[];
  /** Each coarse level after the Gaussian along its rows, and after both with the wider levels. */
  levels: { rows: Target; total: Target }[];
}
