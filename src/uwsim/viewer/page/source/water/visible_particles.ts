// The particles and clouds in the view of a camera.
import type { RenderState } from "../drawing/frame";
import type { Intrinsics } from "../geometry";
import type { VisibleParticles } from "./particle_pass";
import { findParticles, type ParticlesSpec } from "./particles";
import { findClouds, type VisibleClouds } from "./sediment/clouds";

/** Return the particles in the view of a state; null: none are drawn. */
export function findVisibleParticles(
  spec: ParticlesSpec | null | undefined, { drift, worldFromCamera, water }: RenderState, lens: Intrinsics,
): VisibleParticles | null {
  if (!spec?.classes.length || !drift) return null;
  return { spec, records: findParticles(spec, drift, worldFromCamera, lens, water.surface_height) };
}

/** Return the clouds of sediment in the view of a state; null: there are none. */
export function findVisibleClouds(
  spec: ParticlesSpec | null | undefined, { drift, puffs, worldFromCamera }: RenderState,
): VisibleClouds | null {
  if (!spec?.sediment || !puffs || !drift) return null;
  return findClouds(spec.sediment, puffs, drift.time, drift.velocity, worldFromCamera);
}
