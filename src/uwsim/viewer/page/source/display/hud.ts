// The head-up display: the state of the vehicle in a line over the view, each number with a curve.
import { Curves } from "../curves";
import { element, make } from "../panels";
import type { Moment, Player, Samples } from "../player";
import { titleOf, type Quantities, type Quantity } from "./quantities";

const PERIOD = 100; // between two displays [ms]
const AT_FIRST = ["depth", "speed"]; // curves of a page that has no others
const UNITS: Record<string, string> = { deg: "°", "1": "×" };

interface Cell {
  button: HTMLButtonElement;
  value: HTMLElement;
}

export class Hud {
  private readonly cells = new Map<string, Cell>();
  private readonly chosen = new Set<string>();
  private readonly curves: Curves;
  private hasChosen = false; // by hand, or from the first on
  private drawn = 0;
  private isLate = false;
  private last: [Moment, number, boolean] | null = null;
  private shown: Quantity[] = [];

  constructor(
    private readonly quantities: Quantities,
    private readonly player: Player,
    seek: (time: number) => void,
    private readonly redraw: () => void,
  ) {
    this.curves = new Curves(element("state"), seek);
  }

  /** Show a moment; `vehicle` is the number of the vehicle. */
  show(moment: Moment, vehicle: number, isOn: boolean): void {
    this.last = [moment, vehicle, isOn];
    const now = performance.now();
    const isDue = now - this.drawn >= PERIOD || !this.player.isLive;
    if (isDue) {
      this.drawn = now;
      this.shown = this.quantities.at(moment, this.player, vehicle);
      if (this.player.isLive) this.quantities.keep(moment.time, this.shown);
      this.shown.forEach((each) => this.fill(each));
    }
    else if (!this.isLate) {
      this.isLate = true; // what was not shown now is shown soon, even if nothing more comes
      setTimeout(() => {
        this.isLate = false;
        this.show(...this.last!);
      }, PERIOD);
    }
    element("hud").hidden = !isOn || !this.shown.length;
    if (!this.hasChosen && this.shown.length) this.chooseFirst();
    const curves = this.chosenCurves();
    element("state-box").hidden = !curves.length;
    if (curves.length) this.curves.show(moment.time, curves);
  }

  /** Draw the curves again, in the colours of now. */
  repaint(): void {
    this.curves.redraw();
  }

  /** Without measures the curves of a few quantities are there from the beginning. */
  private chooseFirst(): void {
    this.hasChosen = true;
    if (this.player.isLive && !this.player.curves.length && !this.player.levels.length)
      AT_FIRST.forEach((name) => this.chosen.add(name));
    this.mark();
  }

  private chosenCurves(): Samples[] {
    const chosen = this.shown.filter(({ name }) => this.chosen.has(name));
    return chosen.map((each) => this.quantities.history(each, this.player));
  }

  private fill({ name, unit, value }: Quantity): void {
    const cell = this.cells.get(name) ?? this.cell(name);
    cell.value.textContent = textOf(value, unit);
  }

  private cell(name: string): Cell {
    const button = make("button", "", name.startsWith("joint/") ? "joint" : "");
    const value = make("output");
    button.append(make("span", titleOf(name)), value);
    button.title = `${titleOf(name)}: show or hide its curve`;
    button.addEventListener("click", () => {
      if (!this.chosen.delete(name)) this.chosen.add(name);
      this.hasChosen = true;
      this.mark();
      this.redraw();
    });
    const cell = { button, value };
    this.cells.set(name, cell);
    this.mark();
    element("hud").append(button);
    return cell;
  }

  private mark(): void {
    for (const [name, { button }] of this.cells)
      button.setAttribute("aria-pressed", String(this.chosen.has(name)));
  }
}

/** A value with as many digits as its unit needs. */
export function textOf(value: number | null, unit: string): string {
  if (value === null) return "–";
  const digits = { deg: 1, m: 2, "m/s": 2, N: 1, "%": 0 }[unit] ?? 2;
  const text = value.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");
  const sign = UNITS[unit] ?? ` ${unit}`;
  return `${text.replace("-", "−")}${sign}`;
}
