// The materials of surfaces besides their base colour, as in uwsim.rendering.materials.maps.
import type { Head, Mesh } from "../head";
import type { Material } from "./entries";
import type { Pack } from "../pack";
import { UNITS, type Switches } from "./shaders";

/** The switch of each map, by its name in the shaders. */
const MAP_SWITCHES: Record<string, string> = {
  normal_map: "NORMAL_MAP",
  finish_map: "FINISH_MAP",
  emission_map: "EMISSION_MAP",
};
const TABLE_EDGE = 32; // the number of cosines and of roughnesses in the table of reflectances

/** The attributes of vertices for materials: name in the shaders, components, and type; the arrays of a mesh have them. */
export const MATERIAL_ATTRIBUTES = [
  ["tangent", "tangents", 4, "SHORT"],
  ["finish", "finish", 3, "FLOAT"],
  ["emission", "emissions", 3, "FLOAT"],
] as const;

/** Return the switches of the shaders for a material; `isPhysical`: in physical water. */
function materialSwitches(material: Material, isPhysical: boolean, isTextured: boolean): Switches {
  const switches: Switches = {};
  if ("normal_map" in material.maps) switches.NORMAL_MAP = 1;
  if (isPhysical) {
    switches.MICROFACET = 1;
    if ("finish_map" in material.maps) switches.FINISH_MAP = 1;
    if (material.emits) switches.EMISSION = 1;
    if (material.emits && "emission_map" in material.maps) switches.EMISSION_MAP = 1;
  }
  if (isTextured) Object.assign(switches, maskSwitches(material));
  return switches;
}

/** Return the switches of the shaders for the holes of a textured surface. */
export function maskSwitches(material: Material | undefined): Switches {
  if (!material || material.cutoff === null) return {};
  return { ALPHA_TEST: Math.max(1, Math.min(255, Math.round(255 * material.cutoff))) };
}

/** Call a function for each attribute of a mesh that only materials need. */
export function addMaterialAttributes(
  mesh: Mesh, add: (name: string, components: number, type: "SHORT" | "FLOAT", ref: Mesh["positions"]) => void,
): void {
  for (const [name, entry, components, type] of MATERIAL_ATTRIBUTES) {
    const ref = mesh[entry];
    if (ref) add(name, components, type, ref);
  }
}

/** The maps of materials on the GPU, and their binding. */
export class MaterialMaps {
  private readonly samplers: WebGLSampler[];
  private readonly table: WebGLTexture | null;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    pack: Pack,
    /** The textures of the head. */
    private readonly images: readonly WebGLTexture[],
    private readonly textures: Head["textures"],
  ) {
    this.samplers = [gl.CLAMP_TO_EDGE, gl.REPEAT].map((wrap) => {
      const sampler = gl.createSampler();
      gl.samplerParameteri(sampler, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST);
      gl.samplerParameteri(sampler, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
      gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_S, wrap);
      gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_T, wrap);
      return sampler;
    });
    const { reflectance } = pack.head;
    this.table = reflectance ? uploadTable(gl, pack.numbers(reflectance) as Float32Array) : null;
  }

  /** Return the switches for a surface, and bind its maps; `plainSamplers`: samplers without mipmaps, or null for mipmaps. */
  use(material: Material | undefined, surface: Switches, plainSamplers: readonly WebGLSampler[] | null): Switches {
    if (!material) return surface;
    const gl = this.gl;
    const switches = { ...surface, ...materialSwitches(material, "PHYSICAL" in surface, "TEXTURED" in surface) };
    for (const [name, index] of Object.entries(material.maps)) {
      if (!(MAP_SWITCHES[name] in switches)) continue;
      const repeats = Number(this.textures[index].repeats);
      this.bindTexture(UNITS[name], this.images[index]);
      gl.bindSampler(UNITS[name], (plainSamplers ?? this.samplers)[repeats]);
    }
    if (switches.MICROFACET && this.table) this.bindTexture(UNITS.reflectance_table, this.table);
    return switches;
  }

  /** Return the samplers of base colours, or null for their own: in UWSim's image model, normals hide where levels change. */
  baseSamplers(surface: Switches): readonly WebGLSampler[] | null {
    const hidesLevels = "NORMAL_MAP" in surface && !("PHYSICAL" in surface || "ALPHA_TEST" in surface);
    return hidesLevels ? this.samplers : null;
  }

  /** Unbind the samplers of all maps, whose units other passes use. */
  release(): void {
    for (const name of Object.keys(MAP_SWITCHES)) this.gl.bindSampler(UNITS[name], null);
  }

  private bindTexture(unit: number, texture: WebGLTexture): void {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
    this.gl.activeTexture(this.gl.TEXTURE0);
  }
}

/** Upload the table of reflectances, four numbers for each pair of roughness and cosine, in half precision. */
function uploadTable(gl: WebGL2RenderingContext, numbers: Float32Array): WebGLTexture {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, TABLE_EDGE, TABLE_EDGE, 0, gl.RGBA, gl.FLOAT, numbers);
  for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
  for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
  return texture;
}
