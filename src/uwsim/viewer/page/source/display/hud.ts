// The head-up display: the values of the vehicle's state, over the view; a click on a value shows its curve.
import { Curves } from "../curves";
import { element, make } from "../panels";
import type { Player, Samples } from "../player";
import type { Snapshot } from "../snapshot";
import { titleOf, type Quantities, type Quantity } from "./quantities";

const DISPLAY_PERIOD = 100; // least time between two updates in a live view [ms]
const INITIAL_CURVES = ["depth", "speed"]; // curves that a live view without measures shows initially
/** The signs of units that are not written as they are. */
const UNIT_SIGNS: Record<string, string> = { deg: "°", "1": "×" };

/** The elements of a value on the page. */
interface Cell {
  button: HTMLButtonElement;
  value: HTMLElement;
}

/** The head-up display. */
export class Hud {
  private readonly cells = new Map<string, Cell>(); // by the name of the quantity
  private readonly selection = new Set<string>(); // names of the quantities whose curves are shown
  private readonly curves: Curves;
  private hasSelection = false; // true after the initial selection or a selection by the user
  private displayTime = 0; // wall time of the last update [ms]
  private isUpdatePending = false;
  private lastState: [Snapshot, number, boolean] | null = null; // the last arguments of `show`
  private values: Quantity[] = [];

  constructor(
    private readonly quantities: Quantities,
    private readonly player: Player,
    seek: (time: number) => void,
    private readonly redraw: () => void,
  ) {
    this.curves = new Curves(element("state"), seek);
  }

  /** Show the state of the vehicle with an index at the time of a snapshot; hide the display if `isOn` is false. */
  show(snapshot: Snapshot, vehicle: number, isOn: boolean): void {
    this.lastState = [snapshot, vehicle, isOn];
    const now = performance.now();
    const isDue = now - this.displayTime >= DISPLAY_PERIOD || !this.player.isLive;
    if (isDue) {
      this.displayTime = now;
      this.values = this.quantities.compute(snapshot, this.player, vehicle);
      if (this.player.isLive) this.quantities.store(snapshot.time, this.values);
      this.values.forEach((quantity) => this.fill(quantity));
    }
    else if (!this.isUpdatePending) {
      this.isUpdatePending = true; // show this state later if no newer state arrives
      setTimeout(() => {
        this.isUpdatePending = false;
        this.show(...this.lastState!);
      }, DISPLAY_PERIOD);
    }
    element("hud").hidden = !isOn || !this.values.length;
    if (!this.hasSelection && this.values.length) this.selectInitial();
    const curves = this.selectedCurves();
    element("state-box").hidden = !curves.length;
    if (curves.length) this.curves.show(snapshot.time, curves);
  }

  /** Draw the curves again, in the colours of the present theme. */
  redrawCurves(): void {
    this.curves.redraw();
  }

  /** Select the initial curves, if there are no measures. */
  private selectInitial(): void {
    this.hasSelection = true;
    if (this.player.isLive && !this.player.curves.length && !this.player.levels.length)
      INITIAL_CURVES.forEach((name) => this.selection.add(name));
    this.mark();
  }

  private selectedCurves(): Samples[] {
    const quantities = this.values.filter(({ name }) => this.selection.has(name));
    return quantities.map((quantity) => this.quantities.history(quantity, this.player));
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
      if (!this.selection.delete(name)) this.selection.add(name);
      this.hasSelection = true;
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
      button.setAttribute("aria-pressed", String(this.selection.has(name)));
  }
}

/** Return the text of a value with its unit, on which the number of digits depends. */
export function textOf(value: number | null, unit: string): string {
  if (value === null) return "–";
  const digits = { deg: 1, m: 2, "m/s": 2, N: 1, "%": 0 }[unit] ?? 2;
  const text = value.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");
  const sign = UNIT_SIGNS[unit] ?? ` ${unit}`;
  return `${text.replace("-", "−")}${sign}`;
}
