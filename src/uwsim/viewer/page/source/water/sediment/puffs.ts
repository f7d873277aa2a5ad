// Clouds of sediment as Gaussian puffs that move, grow and settle, as in uwsim.particles.puffs.

/** The columns of a puff: centre 3 [m], variance [m2], mass [kg], velocity of the jet 3 [m/s], height of the floor, time of birth [s], number. */
export type Puff = number[];
export const [VARIANCE, MASS, VELOCITY, FLOOR, BIRTH, NUMBER, N_COLUMNS] = [3, 4, 5, 8, 9, 10, 11];
const MAX_PUFFS = 96;
const DECAY_TIME = 2; // the time in which the velocity of the jet falls to 1/e [s]
const ENTRAINMENT = 0.25; // growth of a puff's width over the way of its jet
const MIN_MASS = 1e-5; // the mass below which a puff counts as settled [kg]
const TOLERANCE = 1e-3; // greatest error of recorded times [s]

/** The sediment of a scene in the head; viewer/particles.py documents it. */
export interface SedimentSpec {
  key: string; settling_speed: number; diffusivity: number; scattering: number; colour: number[];
  /** The time between births of puffs [s]. */
  period: number;
}

/** The puffs of a scene at a time [s]. */
export interface Puffs {
  time: number;
  puffs: Puff[];
}

/** A puff that is born, or the removal of all puffs (null), at a time [s]. */
export interface Birth {
  time: number;
  puff: Puff | null;
}

/** Return puffs at a later time [s], in water that moves with a velocity [m/s]. */
export function predictPuffs(spec: SedimentSpec, { time, puffs }: Puffs, endTime: number, water: number[]): Puff[] {
  const step = endTime - time;
  if (step <= 0) return puffs;
  const decay = Math.exp(-step / DECAY_TIME);
  return puffs.map((puff0) => {
    const puff = puff0.slice();
    let square = 0;
    for (let axis = 0; axis < 3; ++axis) {
      const way = puff0[VELOCITY + axis] * DECAY_TIME * (1 - decay);
      square += way * way;
      puff[axis] += way + water[axis] * step;
      puff[VELOCITY + axis] *= decay;
    }
    puff[2] = Math.max(puff[2] - spec.settling_speed * step, puff[FLOOR]);
    puff[VARIANCE] = (Math.sqrt(puff0[VARIANCE]) + ENTRAINMENT * Math.sqrt(square)) ** 2 + 2 * spec.diffusivity * step;
    const [width, height] = [Math.sqrt(puff[VARIANCE]), puff[2] - puff[FLOOR]];
    const rate = (spec.settling_speed * Math.sqrt(2 / Math.PI)) / width;
    puff[MASS] *= Math.exp(-step * rate * Math.exp(-0.5 * (height / width) ** 2));
    return puff;
  });
}

/** The puffs of a recorded trial, which follow from their births. */
export class RecordedPuffs {
  private state: Puffs = { time: 0, puffs: [] };
  private nextBirth = 0; // index of the first birth that is not in the state

  constructor(
    private readonly spec: SedimentSpec,
    private readonly births: Birth[],
    /** Returns the velocity of the water at a time [m/s]. */
    private readonly waterAt: (time: number) => number[],
  ) {}

  /** Return the puffs at the last period before or at a time [s]. */
  puffsAt(time: number): Puffs {
    if (time < this.state.time) [this.state, this.nextBirth] = [{ time: 0, puffs: [] }, 0];
    const { births, spec } = this;
    for (;;) {
      const birthTime = births[this.nextBirth]?.time ?? Infinity;
      const isBirth = !this.state.puffs.length || birthTime < this.state.time + spec.period + TOLERANCE;
      const stepTime = isBirth ? birthTime : this.state.time + spec.period;
      if (stepTime > time) return this.state;
      const puffs = predictPuffs(spec, this.state, stepTime, this.waterAt(stepTime));
      this.state = { time: stepTime, puffs: puffs.filter((puff) => puff[MASS] >= MIN_MASS) };
      for (; births[this.nextBirth]?.time <= stepTime; ++this.nextBirth) this.add(births[this.nextBirth]);
    }
  }

  private add({ puff }: Birth): void {
    const { puffs } = this.state;
    if (!puff) puffs.length = 0;
    else {
      if (puffs.length === MAX_PUFFS) puffs.splice(0, 2, mergePuffs(puffs[0], puffs[1]));
      puffs.push(puff);
    }
  }
}

/** Return a puff with the mass, the centre, the variance and the momentum of two. */
function mergePuffs(first: Puff, second: Puff): Puff {
  const mass = first[MASS] + second[MASS];
  const share = second[MASS] / mass;
  const puff = first.map((value, i) => (1 - share) * value + share * second[i]);
  const square = [0, 1, 2].reduce((sum, axis) => sum + (second[axis] - first[axis]) ** 2, 0);
  puff[VARIANCE] += (share * (1 - share) * square) / 3;
  [puff[MASS], puff[BIRTH], puff[NUMBER]] = [mass, first[BIRTH], second[NUMBER]];
  return puff;
}
