// Caustics on the GPU: the maps of the present time, and the uniform block Caustics, as in uwsim.rendering.caustics.caustic_light.
import { origin, type Matrix } from "../../geometry";
import { UNITS } from "../../drawing/shaders";
import { CausticMapper } from "./caustic_map";
import type { CausticsSpec, FocusingMedium, FocusingSurface, TileWaves } from "./spec";
import { computeSwell } from "./swell";

const MAX_LAG = 0.2; // greatest error of the time of maps in views that need not be exact [s]
const MAX_SHARE = 0.3; // greatest share of the wall time that such views spend on maps

/** The caustics of a scene. */
export class CausticLight {
  private readonly maps = new Map<number, WebGLTexture>(); // by the number of layers
  private readonly swell: WebGLTexture;
  private mapper: { depths: string; mapper: CausticMapper } | null = null;
  private mapKey: { mapper: CausticMapper; tile: TileWaves; time: number } | null = null;
  private nextUpdate = 0; // wall time before which maps are not updated for inexact views [ms]
  private swellKey: unknown[] = [];
  private corner = [0, 0]; // the first point of the grid of long waves in W [m]

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly spec: CausticsSpec,
    private readonly format: number,
  ) {
    this.swell = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.swell);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, spec.swell.n_points, spec.swell.n_points);
    this.setFilter(gl.TEXTURE_2D, gl.LINEAR, gl.CLAMP_TO_EDGE);
  }

  /** Update the textures, and return the values of the uniform block; `isExact`: the maps are those of the very time. */
  prepare(
    surface: FocusingSurface, medium: FocusingMedium, depths: number[], m: Matrix, surfaceHeight: number,
    isExact: boolean,
  ): Float32Array<ArrayBuffer> {
    this.updateMaps(surface, depths, isExact);
    if (surface.waves) this.updateSwell(surface, m, surfaceHeight);
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0 + UNITS.caustic_maps);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.maps.get(countLayers(depths.length))!);
    gl.activeTexture(gl.TEXTURE0 + UNITS.swell_map);
    gl.bindTexture(gl.TEXTURE_2D, this.swell);
    gl.activeTexture(gl.TEXTURE0);
    return this.blockValues(medium, depths, m, surfaceHeight);
  }

  private updateMaps({ tile, time }: FocusingSurface, depths: number[], isExact: boolean): void {
    const key = depths.join();
    if (this.mapper?.depths !== key) this.mapper = { depths: key, mapper: new CausticMapper(this.spec, depths) };
    const { mapper } = this.mapper;
    const lag = this.mapKey?.mapper === mapper && this.mapKey.tile === tile ? Math.abs(time - this.mapKey.time) : Infinity;
    const start = performance.now();
    if (lag === 0 || (!isExact && lag <= MAX_LAG && start < this.nextUpdate)) return;
    this.mapKey = { mapper, tile, time };
    this.upload(mapper.compute(tile, time));
    const end = performance.now();
    this.nextUpdate = end + (end - start) * (1 / MAX_SHARE - 1);
  }

  /** Upload maps: four to a layer, of which neighbours have two in common. */
  private upload(maps: Float32Array[]): void {
    const { gl, format } = this;
    const n = this.spec.n_nodes;
    const nLayers = countLayers(maps.length);
    gl.activeTexture(gl.TEXTURE0 + UNITS.caustic_maps);
    const texture = this.maps.get(nLayers) ?? gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
    if (!this.maps.has(nLayers)) {
      this.maps.set(nLayers, texture);
      gl.texStorage3D(gl.TEXTURE_2D_ARRAY, Math.log2(n) + 1, format, n, n, nLayers);
      // between two levels, too: so does the renderer's library when it builds the mipmaps
      this.setFilter(gl.TEXTURE_2D_ARRAY, gl.LINEAR_MIPMAP_LINEAR, gl.REPEAT);
    }
    const texels = new Float32Array(4 * n * n * nLayers);
    for (let layer = 0; layer < nLayers; ++layer)
      for (let channel = 0; channel < 4; ++channel) {
        const map = maps[2 * layer + channel];
        for (let i = 0, place = 4 * n * n * layer + channel; i < map.length; ++i, place += 4) texels[place] = map[i];
      }
    gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, 0, n, n, nLayers, gl.RGBA, gl.FLOAT, texels);
    gl.generateMipmap(gl.TEXTURE_2D_ARRAY);
    gl.activeTexture(gl.TEXTURE0);
  }

  /** Update the grid of long waves, which has the camera's beam in its middle. */
  private updateSwell(surface: FocusingSurface, m: Matrix, surfaceHeight: number): void {
    const { gl, spec } = this;
    const { n_points, spacing } = spec.swell;
    const position = origin(m);
    const depth = Math.max(surfaceHeight - position[2], 0);
    const corner = [0, 1].map(
      (axis) => spacing * Math.floor((position[axis] - depth * spec.drift[axis]) / spacing - 0.5 * n_points),
    );
    const key = [surface.waves, surface.time, surface.scale, ...corner];
    if (key.every((value, i) => value === this.swellKey[i])) return;
    [this.swellKey, this.corner] = [key, corner];
    const values = computeSwell(spec, surface, corner);
    gl.activeTexture(gl.TEXTURE0 + UNITS.swell_map);
    gl.bindTexture(gl.TEXTURE_2D, this.swell);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, n_points, n_points, gl.RGBA, gl.FLOAT, values);
    gl.activeTexture(gl.TEXTURE0);
  }

  private blockValues(
    { loss, shafts }: FocusingMedium, depths: number[], m: Matrix, surfaceHeight: number,
  ): Float32Array<ArrayBuffer> {
    const { edge, drift, swell, n_nodes } = this.spec;
    const depth = surfaceHeight - m[11];
    const gridEdge = (swell.n_points * swell.spacing) / edge;
    const frame = [0, 0, 1 / gridEdge, 1 / edge];
    const rows = [0, 1].flatMap((row) => {
      // the point of the still surface on the refracted beam, in tiles, from the camera frame
      const start = (m[4 * row + 3] - drift[row] * depth) / edge;
      const tile = Math.floor(start);
      frame[row] = 0.5 / swell.n_points - (this.corner[row] / edge - tile) / gridEdge;
      return [...[0, 1, 2].map((axis) => (m[4 * row + axis] + drift[row] * m[8 + axis]) / edge), start - tile];
    });
    const ratio = Math.log2(depths[1] / depths[0]);
    return Float32Array.from([
      ...rows, ...frame, depths[0], 1 / ratio, -Math.log2(depths[0]) / ratio, depths.at(-1)!, ...loss, ...shafts, n_nodes,
    ]);
  }

  private setFilter(target: number, minFilter: number, wrap: number): void {
    const { gl } = this;
    for (const [name, value] of [
      [gl.TEXTURE_MIN_FILTER, minFilter], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
      [gl.TEXTURE_WRAP_S, wrap], [gl.TEXTURE_WRAP_T, wrap],
    ])
      gl.texParameteri(target, name, value);
  }
}

/** Return the number of layers, of four maps each, for a number of maps. */
function countLayers(nMaps: number): number {
  return nMaps / 2 - 1;
}
