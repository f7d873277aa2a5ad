// The quantities of a vehicle's state: those of its motion, and the readings that a running simulation sends.
import type { Head } from "../head";
import { fromPose, origin, plus, type Matrix } from "../geometry";
import type { Player, Samples } from "../player";
import type { Snapshot } from "../snapshot";
import type { Rays } from "./rays";

const MAX_ALTITUDE = 200; // the length of the ray down from the vehicle [m]
const HISTORY_RATE = 5; // greatest rate of the samples of a curve [Hz]
const MAX_SAMPLES = 6000; // greatest number of samples of a curve in a live view
const MAX_REPLAY_SAMPLES = 1200; // greatest number of samples of a curve in a replay
const DEGREES = 180 / Math.PI; // degrees in a radian

/** A quantity of a vehicle's state. */
export interface Quantity {
  /** The name, for example `depth`, `joint/Slew` or `force/wrist`. */
  name: string;
  unit: string;
  /** The value in `unit`; null: there is none at this time. */
  value: number | null;
}

/** A quantity in a message of a running simulation. */
export type Reading = [name: string, unit: string, value: number | null];

/** The quantities of the displayed vehicle, with their curves. */
export class Quantities {
  private readonly histories = new Map<string, Samples>();
  private readings: Reading[] = []; // the newest readings of a running simulation
  private storeTime = -Infinity; // simulation time of the last stored quantities [s]
  private trial = -1; // index of the trial to which the histories belong, in a replay
  private vehicle = 0; // index of the displayed vehicle

  constructor(
    private readonly head: Head,
    private readonly rays: Rays,
  ) {}

  /** Set the readings of the vehicle; return true if they have changed. */
  setReadings(readings: Reading[]): boolean {
    const haveChanged = JSON.stringify(readings) !== JSON.stringify(this.readings);
    this.readings = readings;
    return haveChanged;
  }

  /** Return all quantities of the vehicle with an index at the time of a snapshot. */
  compute(snapshot: Snapshot, player: Player, vehicle: number): Quantity[] {
    this.vehicle = vehicle;
    const readings = this.readings.map(([name, unit, value]) => ({ name, unit, value }));
    return [...this.motionQuantities(snapshot, player), ...readings];
  }

  /** Add the quantities at a simulation time [s] to the histories, at `HISTORY_RATE` at most. */
  store(time: number, quantities: Quantity[]): void {
    if (time < this.storeTime) this.histories.clear();
    if (time >= this.storeTime && time < this.storeTime + 1 / HISTORY_RATE) return;
    this.storeTime = time;
    for (const { name, unit, value } of quantities) {
      const history = this.historyOf(name, unit);
      history.times.push(time);
      history.values.push(value);
      if (history.times.length <= MAX_SAMPLES) continue;
      history.times.splice(0, MAX_SAMPLES / 2);
      history.values.splice(0, MAX_SAMPLES / 2);
    }
  }

  /** Return the curve of a quantity: so far in a live view, over the whole trial in a replay. */
  history({ name, unit }: Quantity, player: Player): Samples {
    if (player.isLive) return this.historyOf(name, unit);
    if (player.trial !== this.trial) this.histories.clear();
    this.trial = player.trial;
    const storedHistory = this.histories.get(name);
    if (storedHistory) return storedHistory;
    const history = this.historyOf(name, unit);
    const length = player.end - player.start;
    const n = Math.max(2, Math.min(MAX_REPLAY_SAMPLES, Math.ceil(length * HISTORY_RATE)));
    for (let i = 0; i < n; ++i) {
      const time = player.start + (length * i) / (n - 1);
      const quantities = this.motionQuantities(player.snapshot(time), player, name);
      history.times.push(time);
      history.values.push(quantities.find((quantity) => quantity.name === name)?.value ?? null);
    }
    return history;
  }

  private historyOf(name: string, unit: string): Samples {
    let history = this.histories.get(name);
    if (!history) this.histories.set(name, (history = { name: titleOf(name), unit, times: [], values: [] }));
    return history;
  }

  /** Compute the quantities that depend on poses and currents; with `onlyName`, the costly altitude only if that is its name. */
  private motionQuantities(snapshot: Snapshot, player: Player, onlyName = ""): Quantity[] {
    const vehicle = this.head.vehicles[this.vehicle];
    if (!vehicle) return [];
    const base = poseOf(this.head, snapshot, vehicle.body);
    const [x, y, z] = origin(base);
    const sign = this.zAxisSign(vehicle.body);
    const heading = Math.atan2(base[0], base[4]) * DEGREES; // W: x east, y north
    const quantities: Quantity[] = [
      { name: "depth", unit: "m", value: this.head.water.surface_height - z },
      { name: "heading", unit: "deg", value: (Math.round(10 * (heading + 360)) / 10) % 360 },
      { name: "roll", unit: "deg", value: Math.atan2(sign * base[9], sign * base[10]) * DEGREES },
      { name: "pitch", unit: "deg", value: Math.asin(Math.max(-1, Math.min(1, base[8]))) * DEGREES },
      { name: "speed", unit: "m/s", value: player.speed(vehicle.body, snapshot.time) },
    ];
    if (!onlyName || onlyName === "altitude")
      quantities.splice(1, 0, { name: "altitude", unit: "m", value: this.altitude([x, y, z], vehicle.name, snapshot) });
    const flow = ["x", "y", "z"].map((axis) => snapshot.signal(`water/${vehicle.name}/${axis}`) ?? 0);
    const current = Math.hypot(...flow);
    if (current >= 5e-3 || onlyName) quantities.push({ name: "current", unit: "m/s", value: current });
    return quantities;
  }

  /** Return 1 if the z axis of the vehicle's base points up in its initial pose, else -1. */
  private zAxisSign(body: string): number {
    const initialBody = this.head.bodies.find(({ name }) => name === body);
    return initialBody && fromPose(initialBody.pose)[10] < 0 ? -1 : 1;
  }

  /** Return the height of a position above the surface below it [m]; null if there is none within `MAX_ALTITUDE`. */
  private altitude(position: number[], vehicle: string, snapshot: Snapshot): number | null {
    const bottom = plus(position, [0, 0, -MAX_ALTITUDE]);
    const bodyPose = (body: string): Matrix => poseOf(this.head, snapshot, body);
    const fraction = this.rays.cast(position, bottom, bodyPose, (body) => body.vehicle === vehicle);
    return fraction < 1 ? fraction * MAX_ALTITUDE : null;
  }
}

/** Return the pose of a body in W. */
function poseOf(head: Head, snapshot: Snapshot, body: string): Matrix {
  const initialBody = head.bodies.find(({ name }) => name === body);
  return snapshot.poses.get(body) ?? fromPose(initialBody?.pose ?? [0, 0, 0, 1, 0, 0, 0]);
}

/** Return the title of a quantity on the page: `Slew` for `joint/Slew`, `wrist force` for `force/wrist`. */
export function titleOf(name: string): string {
  const [kind, title] = [name.split("/")[0], name.slice(name.indexOf("/") + 1)];
  if (title === name || kind === "joint") return title;
  return title.toLowerCase().includes(kind) ? title : `${title} ${kind}`;
}
