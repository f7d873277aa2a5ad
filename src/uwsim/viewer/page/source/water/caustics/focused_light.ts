// The sunlight that a moving surface focuses, in an image, as in uwsim.rendering.caustics.focused_light.
import type { RenderState } from "../../drawing/frame";
import type { Switches } from "../../drawing/shaders";
import type { Optics } from "../medium";
import { CausticLight } from "./caustic_light";
import { findDepths } from "./caustic_map";
import type { CausticsSpec } from "./spec";

/** What an image with focused sunlight needs. */
export interface FocusedImage {
  /** The values of the uniform block Caustics. */
  values: Float32Array<ArrayBuffer>;
  /** The switches of surfaces. */
  surfaces: Switches;
  /** The switches of the pass of light shafts; null: there are none. */
  shafts: Switches | null;
}

/** The caustics and the light shafts of a scene. */
export class FocusedLight {
  private readonly caustics: CausticLight;

  constructor(
    gl: WebGL2RenderingContext,
    private readonly spec: CausticsSpec,
    format: number,
  ) {
    this.caustics = new CausticLight(gl, spec, format);
  }

  /** Update and bind the maps for an image with the lowest point of the ground at a height [m]; null: no light is focused. */
  prepare(
    { focusing, worldFromCamera, water, isExact }: RenderState, optics: Optics, floorHeight: number,
  ): FocusedImage | null {
    const { spec, caustics } = this;
    const medium = optics.caustics;
    if (!medium || !focusing) return null;
    const depths = findDepths(spec.maps, medium.lost_depth, water.surface_height - floorHeight);
    const values = caustics.prepare(focusing, medium, depths, worldFromCamera, water.surface_height, isExact === true);
    const switches: Switches = { N_SLICES: depths.length, ...(focusing.waves ? { SWELL: 1 } : {}) };
    return {
      values,
      surfaces: spec.has_caustics ? { CAUSTICS: 1, ...switches } : {},
      shafts: spec.shafts && { ...spec.shafts, ...switches },
    };
  }
}
