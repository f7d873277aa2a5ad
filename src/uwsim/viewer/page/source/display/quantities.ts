// The state of a vehicle in numbers, and their history: from its motion, and what a simulation sends.
import type { Head } from "../head";
import { fromPose, origin, plus, type Matrix } from "../geometry";
import type { Moment, Player, Samples } from "../player";
import type { Rays } from "./rays";

const DEEPEST = 200; // below the vehicle that its altitude is looked for [m]
const RATE = 5; // of the history [Hz]
const LONGEST = 6000; // samples of a history
const LONGEST_REPLAYED = 1200; // samples of a curve of a replay
const DEGREES = 180 / Math.PI;

/** A number with its name, as `depth`, `joint/Slew` or `force/wrist`. */
export interface Quantity {
  name: string;
  unit: string;
  value: number | null;
}

export type Reading = [name: string, unit: string, value: number | null];

export class Quantities {
  private readonly histories = new Map<string, Samples>();
  private readings: Reading[] = []; // of a running simulation, the newest
  private kept = -Infinity;
  private trial = -1;
  private vehicle = 0;

  constructor(
    private readonly head: Head,
    private readonly rays: Rays,
  ) {}

  /** Take what a simulation says of the vehicle besides its motion; returns whether it is news. */
  hear(readings: Reading[]): boolean {
    const isNews = JSON.stringify(readings) !== JSON.stringify(this.readings);
    this.readings = readings;
    return isNews;
  }

  /** All of a moment; of vehicle number `vehicle`. */
  at(moment: Moment, player: Player, vehicle: number): Quantity[] {
    this.vehicle = vehicle;
    const sent = this.readings.map(([name, unit, value]) => ({ name, unit, value }));
    return [...this.ofMotion(moment, player), ...sent];
  }

  /** Add the quantities of a moment to the histories, a few times a second. */
  keep(time: number, quantities: Quantity[]): void {
    if (time < this.kept) this.histories.clear();
    if (time >= this.kept && time < this.kept + 1 / RATE) return;
    this.kept = time;
    for (const { name, unit, value } of quantities) {
      const history = this.historyOf(name, unit);
      history.times.push(time);
      history.values.push(value);
      if (history.times.length <= LONGEST) continue;
      history.times.splice(0, LONGEST / 2);
      history.values.splice(0, LONGEST / 2);
    }
  }

  /** The curve of a quantity; of a replay that of the whole trial. */
  history({ name, unit }: Quantity, player: Player): Samples {
    if (player.isLive) return this.historyOf(name, unit);
    if (player.trial !== this.trial) this.histories.clear();
    this.trial = player.trial;
    const known = this.histories.get(name);
    if (known) return known;
    const made = this.historyOf(name, unit);
    const length = player.end - player.start;
    const n = Math.max(2, Math.min(LONGEST_REPLAYED, Math.ceil(length * RATE)));
    for (let i = 0; i < n; ++i) {
      const time = player.start + (length * i) / (n - 1);
      const all = this.ofMotion(player.moment(time), player, name);
      made.times.push(time);
      made.values.push(all.find((each) => each.name === name)?.value ?? null);
    }
    return made;
  }

  private historyOf(name: string, unit: string): Samples {
    let history = this.histories.get(name);
    if (!history) this.histories.set(name, (history = { name: titleOf(name), unit, times: [], values: [] }));
    return history;
  }

  /** What follows from poses and currents; `only`: the one that is needed. */
  private ofMotion(moment: Moment, player: Player, only = ""): Quantity[] {
    const vehicle = this.head.vehicles[this.vehicle];
    if (!vehicle) return [];
    const base = placeOf(this.head, moment, vehicle.body);
    const [x, y, z] = origin(base);
    const way = this.wayUp(vehicle.body);
    const heading = Math.atan2(base[0], base[4]) * DEGREES; // W: x east, y north
    const found: Quantity[] = [
      { name: "depth", unit: "m", value: this.head.water.surface_height - z },
      { name: "heading", unit: "deg", value: (Math.round(10 * (heading + 360)) / 10) % 360 },
      { name: "roll", unit: "deg", value: Math.atan2(way * base[9], way * base[10]) * DEGREES },
      { name: "pitch", unit: "deg", value: Math.asin(Math.max(-1, Math.min(1, base[8]))) * DEGREES },
      { name: "speed", unit: "m/s", value: player.speed(vehicle.body, moment.time) },
    ];
    if (!only || only === "altitude")
      found.splice(1, 0, { name: "altitude", unit: "m", value: this.altitude([x, y, z], vehicle.name, moment) });
    const flow = ["x", "y", "z"].map((axis) => moment.signal(`water/${vehicle.name}/${axis}`) ?? 0);
    const current = Math.hypot(...flow);
    if (current >= 5e-3 || only) found.push({ name: "current", unit: "m/s", value: current });
    return found;
  }

  /** 1 where the vehicle's z axis points up when it lies level, -1 where down. */
  private wayUp(body: string): number {
    const first = this.head.bodies.find(({ name }) => name === body);
    return first && fromPose(first.pose)[10] < 0 ? -1 : 1;
  }

  private altitude(at: number[], vehicle: string, moment: Moment): number | null {
    const below = plus(at, [0, 0, -DEEPEST]);
    const place = (body: string): Matrix => placeOf(this.head, moment, body);
    const share = this.rays.cast(at, below, place, (body) => body.vehicle === vehicle);
    return share < 1 ? share * DEEPEST : null;
  }
}

function placeOf(head: Head, moment: Moment, body: string): Matrix {
  const first = head.bodies.find(({ name }) => name === body);
  return moment.poses.get(body) ?? fromPose(first?.pose ?? [0, 0, 0, 1, 0, 0, 0]);
}

/** What a quantity is called on the page: of `joint/Slew` and the like what the file calls it. */
export function titleOf(name: string): string {
  const [kind, own] = [name.split("/")[0], name.slice(name.indexOf("/") + 1)];
  if (own === name || kind === "joint") return own;
  return own.toLowerCase().includes(kind) ? own : `${own} ${kind}`;
}
