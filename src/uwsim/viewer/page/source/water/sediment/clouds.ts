// What a camera sees of clouds of sediment, as in uwsim.simulation.scenery.scene_sediment.
import { transform, inverse, type Matrix } from "../../geometry";
import { hashCell, parseWord, uniform } from "../hash64";
import { BIRTH, MASS, NUMBER, predictPuffs, VARIANCE, type Puffs, type SedimentSpec } from "./puffs";

const N_LUMPS = 6; // number of lumps in which a puff is drawn
const LUMP_WIDTH = 0.42; // width of a lump over that of its puff
const BIRTH_TIME = 0.5; // time over which a new puff appears [s]
const MAX_REACH = 40; // distance beyond which a puff is not drawn [m]
const FIRST_NUMBER = 5; // index of the first random number of a puff's lumps

/** The numbers of a lump: centre 3 in the camera's frame and width [m], optical depth through the centre. */
export const LUMP_LENGTH = 5;

/** The clouds before a camera. */
export interface VisibleClouds {
  /** The lumps, `LUMP_LENGTH` numbers each. */
  lumps: Float32Array<ArrayBuffer>;
  /** The albedo of a thick cloud in daylight. */
  colour: number[];
}

/** Return the clouds before a camera at a time [s]; null if there are none. */
export function findClouds(
  spec: SedimentSpec, state: Puffs, time: number, waterVelocity: number[], worldFromCamera: Matrix,
): VisibleClouds | null {
  const cameraFromWorld = inverse(worldFromCamera);
  const key = parseWord(spec.key);
  const lumps: number[] = [];
  for (const puff of predictPuffs(spec, state, time, waterVelocity)) {
    const puffWidth = Math.sqrt(puff[VARIANCE]);
    const width = LUMP_WIDTH * puffWidth;
    const share = Math.min(Math.max(time - puff[BIRTH], 0) / BIRTH_TIME, 1) / N_LUMPS;
    const depth = (spec.scattering * puff[MASS] * share) / (2 * Math.PI * width * width);
    if (depth <= 1e-4) continue;
    for (const offset of drawOffsets(hashCell(key, puff[NUMBER]))) {
      const place = transform(cameraFromWorld, offset.map((value, axis) => puff[axis] + puffWidth * value));
      if (place[2] < 3 * width && Math.hypot(...place) < MAX_REACH) lumps.push(...place, width, depth);
    }
  }
  return lumps.length ? { lumps: Float32Array.from(lumps), colour: spec.colour } : null;
}

/** Return the places of the lumps of a puff in its widths; their mean is 0. */
function drawOffsets(word: [number, number]): number[][] {
  const numbers = Array.from({ length: N_LUMPS }, (_, lump) =>
    [0, 1, 2].map((axis) => uniform(word, FIRST_NUMBER + 3 * lump + axis)),
  );
  const means = [0, 1, 2].map((axis) => numbers.reduce((sum, row) => sum + row[axis], 0) / N_LUMPS);
  const scale = Math.sqrt((12 * (1 - LUMP_WIDTH ** 2) * N_LUMPS) / (N_LUMPS - 1));
  return numbers.map((row) => row.map((value, axis) => scale * (value - means[axis])));
}
