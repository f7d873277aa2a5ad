// The entries of the head on materials, as in uwsim.viewer.models, and references to arrays.
/** A reference to an array: offset of its first byte from the end of the JSON, number of elements, their type. */
export type Ref = [number, number, string];

/** The arrays of a mesh with a material. */
export interface MaterialArrays {
  /** Tangents of the vertices, i2 / 32767, with 1 or -1 as the fourth number; absent without a normal map. */
  tangents?: Ref;
  /** Roughness, share of metal and scale of the normal map, f4; absent without a material. */
  finish?: Ref;
  /** Emitted radiance, f4; absent without a material. */
  emissions?: Ref;
}

/** The properties of a surface besides its base colour. */
export interface Material {
  /** The index in `textures` of each map, by its name in the shaders. */
  maps: Record<string, number>;
  /** The alpha below which there is a hole; null: no holes. */
  cutoff: number | null;
  /** True if it emits light. */
  emits: boolean;
}
