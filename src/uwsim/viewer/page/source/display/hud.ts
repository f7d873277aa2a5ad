// The head-up display: numbers of the vehicle's state over the view; a click on one shows its curve.
import { Curves } from "../curves";
import { element, make } from "../panels";
import type { Snapshot, Player, Samples } from "../player";
import { titleOf, type Quantities, type Quantity } from "./quantities";

const DISPLAY_PERIOD = 100; // between two updates [ms]
const INITIAL_CURVES = ["depth", "speed"]; // shown initially in a live view without measures
const UNITS: Record<string, string> = { deg: "°", "1": "×" };

interface Cell {
  button: HTMLButtonElement;
  value: HTMLElement;
}

export class Hud {
  private readonly cells = new Map<string, Cell>();
  private readonly selection = new Set<string>();
  private readonly curves: Curves;
  private hasSelection = false; // true after the initial selection, or one by the user
  private displayTime = 0; // of the last update [ms]
  private isUpdatePending = false;
  private lastState: [Snapshot, number, boolean] | null = null;
  private values: Quantity[] = [];

  constructor(
    private readonly quantities: Quantities,
    private readonly player: Player,
    seek: (time: number) => void,
    private readonly redraw: () => void,
  ) {
    this.curves = new Curves(element("state"), seek);
  }

  /** Show the state of a vehicle, by its index, in a snapshot. */
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
      this.isUpdatePending = true; // show it later, even if no other state follows
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

  /** Draw the curves again, in the present colours. */
  repaint(): void {
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

/** Return the text of a value, with a number of digits that depends on its unit. */
export function textOf(value: number | null, unit: string): string {
  if (value === null) return "–";
  const digits = { deg: 1, m: 2, "m/s": 2, N: 1, "%": 0 }[unit] ?? 2;
  const text = value.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");
  const sign = UNITS[unit] ?? ` ${unit}`;
  return `${text.replace("-", "−")}${sign}`;
}
