// The moving surface of physical water at a time.
import type { Head, Ref } from "../../head";
import type { Pack } from "../../pack";
import type { Snapshot } from "../../snapshot";
import type { Components, MovingSurface } from "./spec";

/** The surfaces of a scene in its trials, which may have different seeds. */
export class MovingSurfaces {
  private trial = -1;
  private current: Pick<MovingSurface, "waves" | "ripples"> | null = null; // those of `trial`

  constructor(
    private readonly pack: Pack,
    private readonly head: Head,
  ) {}

  /** Return the surface of a trial at the time of a snapshot; null: images do not show it. */
  surfaceAt(trial: number, snapshot: Snapshot): MovingSurface | null {
    const { surface, trials } = this.head;
    if (!surface) return null;
    if (!this.current || trial !== this.trial) {
      const spec = trials?.[trial]?.surface ?? surface;
      this.trial = trial;
      this.current = { waves: readComponents(this.pack, spec.waves), ripples: readComponents(this.pack, spec.ripples) };
    }
    return { ...this.current, time: snapshot.time, scale: snapshot.signal("wave_scale") ?? surface.scale };
  }
}

/** Return the components of waves from a pack. */
export function readComponents(pack: Pack, ref: Ref | null): Components | null {
  if (!ref) return null;
  const values = pack.numbers(ref) as Float32Array;
  const n = values.length / 5;
  const [amplitude, omega, kx, ky, phase] = [0, 1, 2, 3, 4].map((i) => values.subarray(n * i, n * (i + 1)));
  return { amplitude, omega, kx, ky, phase };
}
