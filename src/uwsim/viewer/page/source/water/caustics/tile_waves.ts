// The waves of the tile of short waves, as in uwsim.rendering.caustics.wave_tile, ripples and swell.
import type { Head } from "../../head";
import type { Pack } from "../../pack";
import type { Snapshot } from "../../snapshot";
import { readComponents } from "../surface/moving_surface";
import type { Components } from "../surface/spec";
import type { ComplexGrid } from "./fft";
import type { CausticsSpec, FocusingSurface, TileWaves } from "./spec";

const GRAVITY = 9.81;
const PHASE_UNIT = (2 * Math.PI) / 65536;

/** The surfaces that focus light in the trials of a scene, which may have different seeds. */
export class FocusingSurfaces {
  private trial = -1;
  private ripples: TileWaves | null = null; // those of `trial`, as the waves of the scene
  private waves: Components | null = null;
  private tile: TileWaves | null = null; // the ripples with the short waves of the scene
  private scale = NaN; // the factor on the waves in `tile`

  constructor(
    private readonly pack: Pack,
    private readonly head: Head,
  ) {}

  /** Return the surface of a trial at the time of a snapshot; null: it focuses no light. */
  surfaceAt(trial: number, snapshot: Snapshot): FocusingSurface | null {
    const { caustics: spec, trials } = this.head;
    if (!spec) return null;
    if (!this.ripples || trial !== this.trial) {
      const { phases, waves } = trials?.[trial]?.caustics ?? spec;
      this.trial = trial;
      this.ripples = readRipples(this.pack, spec, this.pack.numbers(phases));
      this.waves = readComponents(this.pack, waves);
      this.tile = null;
    }
    const scale = snapshot.signal("wave_scale") ?? spec.scale;
    if (!this.tile || scale !== this.scale) {
      this.tile = this.waves ? join(this.ripples, findShortWaves(spec, this.waves, scale)) : this.ripples;
      this.scale = scale;
    }
    return { time: snapshot.time, scale, tile: this.tile, waves: this.waves };
  }
}

function readRipples(pack: Pack, spec: CausticsSpec, phases: ArrayLike<number>): TileWaves {
  const [columns, rows] = [spec.columns, spec.rows].map((ref) => pack.numbers(ref) as Int16Array);
  const unit = (2 * Math.PI) / spec.edge;
  return {
    columns, rows,
    amplitude: Float64Array.from(pack.numbers(spec.amplitudes), (value) => spec.amplitude * value),
    omega: Float64Array.from(columns, (column, i) => {
      const k = unit * Math.hypot(column, rows[i]);
      return Math.sqrt(GRAVITY * k + spec.tension * k ** 3);
    }),
    phase: Float64Array.from(phases, (value) => PHASE_UNIT * value),
  };
}

/** Return the waves of a scene that a tile can have, with the nearest wave vectors of its lattice; slopes remain. */
function findShortWaves({ edge, wave_lengths }: CausticsSpec, c: Components, scale: number): TileWaves {
  const unit = (2 * Math.PI) / edge;
  const lengths = Array.from(c.kx, (kx, i) => (2 * Math.PI) / Math.hypot(kx, c.ky[i]));
  const indices = [...lengths.keys()].filter((i) => lengths[i] < wave_lengths[1] && lengths[i] >= wave_lengths[0]);
  const columns = Int16Array.from(indices, (i) => roundEven(c.kx[i] / unit));
  const rows = Int16Array.from(indices, (i) => roundEven(c.ky[i] / unit));
  return {
    columns, rows,
    amplitude: Float64Array.from(
      indices, (i, n) => (scale * c.amplitude[i] * 2 * Math.PI) / lengths[i] / (unit * Math.hypot(columns[n], rows[n])),
    ),
    omega: Float64Array.from(indices, (i) => c.omega[i]),
    phase: Float64Array.from(indices, (i) => c.phase[i]),
  };
}

function roundEven(value: number): number {
  return Math.abs(value % 1) === 0.5 ? 2 * Math.round(value / 2) : Math.round(value);
}

function join(a: TileWaves, b: TileWaves): TileWaves {
  const numbers = (key: "amplitude" | "omega" | "phase") => Float64Array.from([...a[key], ...b[key]]);
  return {
    columns: Int16Array.from([...a.columns, ...b.columns]), rows: Int16Array.from([...a.rows, ...b.rows]),
    amplitude: numbers("amplitude"), omega: numbers("omega"), phase: numbers("phase"),
  };
}

/** Set a grid to the spectrum of the slopes at a time [s]: along x + i along y, for an inverse transform without a factor. */
export function fillSpectrum(
  { columns, rows, amplitude, omega, phase }: TileWaves, edge: number, n: number, time: number, spectrum: ComplexGrid,
): void {
  const { reals, imaginaries } = spectrum;
  reals.fill(0);
  imaginaries.fill(0);
  const mask = n - 1;
  for (let wave = 0; wave < columns.length; ++wave) {
    const [i, j] = [columns[wave], rows[wave]];
    const halfSlope = (amplitude[wave] * Math.PI) / edge;
    const angle = phase[wave] - omega[wave] * time;
    const x = halfSlope * Math.cos(angle);
    const y = halfSlope * Math.sin(angle);
    const place = (j & mask) * n + (i & mask);
    const opposite = (-j & mask) * n + (-i & mask);
    reals[place] += -i * y - j * x;
    imaginaries[place] += i * x - j * y;
    reals[opposite] += -i * y + j * x;
    imaginaries[opposite] += -i * x - j * y;
  }
}
