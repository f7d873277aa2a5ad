// The media of physical water: their numbers, from the head or from a running simulation, and the medium at a time.
import type { Head } from "../head";
import type { MediumSpec, Optics } from "./medium";
import type { Pack } from "../pack";
import type { Snapshot } from "../snapshot";

const MAX_DEPTH = 3; // optical depth of a view above which it begins with the purest water
const MAX_MEDIA = 64; // greatest number of media in a running simulation

/** Return true if the view of a scene's head begins without fog; physical water is shown while it is clear enough. */
export function beginsClear({ water, view }: Head): boolean {
  const medium = water.media?.[0];
  if (!medium) return true;
  const attenuation = Math.min(...medium.absorption.map((a, i) => a + medium.scattering[i]));
  return attenuation * Math.hypot(...view.at.map((value, i) => value - view.pose[i])) > MAX_DEPTH;
}

/** The media of a scene; there are none under the fog law. */
export class Media {
  private readonly entries: Optics[] = []; // the initial one first
  private readonly clearMedium: Optics | null; // the purest water, which views without fog show

  constructor(pack: Pack) {
    const { media, clear: clearMedium } = pack.head.water;
    for (const medium of media ?? []) this.add(pack, medium);
    this.clearMedium = clearMedium ? readMedium(pack, clearMedium) : null;
  }

  /** Add a medium. */
  add(pack: Pack, medium: MediumSpec): void {
    if (this.entries.length >= MAX_MEDIA) this.entries.splice(1, 1);
    this.entries.push(readMedium(pack, medium));
  }

  /** Return the medium at the time of a snapshot; null: the fog law holds. */
  mediumAt(snapshot: Snapshot): Optics | null {
    if (!this.entries.length) return null;
    const attenuation = snapshot.signal("beam_attenuation");
    const optics = attenuation === undefined ? this.entries[0] : nearestOptics(this.entries, attenuation);
    const stops = snapshot.signal("exposure_level");
    if (stops === undefined) return optics;
    const ratio = 2 ** stops / optics.exposure;
    return { ...optics, exposure: 2 ** stops, clear_exposure: ratio * optics.clear_exposure };
  }

  /** Return the purest water instead of that of the scene, with an exposure for the same daylight. */
  clearOptics(optics: Optics | null): Optics | null {
    return optics && this.clearMedium && { ...this.clearMedium, exposure: optics.clear_exposure };
  }
}

/** Return the entry of the media whose beam attenuation of green [1/m] is nearest to a given one; the newest of equal ones. */
function nearestOptics(media: Optics[], attenuation: number): Optics {
  const distances = media.map(({ absorption, scattering }) => Math.abs(absorption[1] + scattering[1] - attenuation));
  return media[distances.lastIndexOf(Math.min(...distances))];
}

function readMedium(pack: Pack, medium: MediumSpec): Optics {
  const values = pack.numbers(medium.transform.values) as Float32Array;
  return { ...medium, transform: { ...medium.transform, values } };
}
