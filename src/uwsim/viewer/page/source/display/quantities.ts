// Quantities of a vehicle's state, from its motion and from a simulation's readings, with their history.
import type { Head } from "../head";
import { fromPose, origin, plus, type Matrix } from "../geometry";
import type { Snapshot, Player, Samples } from "../player";
import type { Rays } from "./rays";

const MAX_ALTITUDE = 200; // the length of the ray down from the vehicle [m]
const HISTORY_RATE = 5; // [Hz]
const MAX_SAMPLES = 6000; // samples of a history
const MAX_REPLAY_SAMPLES = 1200; // samples of a curve of a replay
const DEGREES = 180 / Math.PI;

/** A quantity; its name is as `depth`, `joint/Slew` or `force/wrist`. */
export interface Quantity {
  name: string;
  unit: string;
  value: number | null;
}

export type Reading = [name: string, unit: string, value: number | null];

export class Quantities {
  private readonly histories = new Map<string, Samples>();
  private readings: Reading[] = []; // the newest, of a running simulation
  private storeTime = -Infinity; // simulation time of the last stored quantities [s]
  private trial = -1;
  private vehicle = 0;

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

  /** Return all quantities of a vehicle, by its index, in a snapshot. */
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

  /** Return the curve of a quantity; in a replay, the curve of the whole trial. */
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

  /** Compute quantities from poses and currents; `onlyName` may name the only one that is needed. */
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

  private altitude(position: number[], vehicle: string, snapshot: Snapshot): number | null {
    const bottom = plus(position, [0, 0, -MAX_ALTITUDE]);
    const bodyPose = (body: string): Matrix => poseOf(this.head, snapshot, body);
    const share = this.rays.cast(position, bottom, bodyPose, (body) => body.vehicle === vehicle);
    return share < 1 ? share * MAX_ALTITUDE : null;
  }
}

/** Return the matrix from a body to W. */
function poseOf(head: Head, snapshot: Snapshot, body: string): Matrix {
  const initialBody = head.bodies.find(({ name }) => name === body);
  return snapshot.poses.get(body) ?? fromPose(initialBody?.pose ?? [0, 0, 0, 1, 0, 0, 0]);
}

/** Return the title of a quantity on the page: of `joint/Slew` only the name in the vehicle's file. */
export function titleOf(name: string): string {
  const [kind, title] = [name.split("/")[0], name.slice(name.indexOf("/") + 1)];
  if (title === name || kind === "joint") return title;
  return title.toLowerCase().includes(kind) ? title : `${title} ${kind}`;
}
