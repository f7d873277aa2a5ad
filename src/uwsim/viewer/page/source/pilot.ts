// The inputs of a human pilot: keys, the first gamepad, and sticks on the screen.
import { element, make } from "./panels";

const REPEAT = 100; // period of messages while an input is active [ms]
const POLL = 33; // period of reading the gamepad [ms]
const SIDES = ["left", "right"];
/** The words for the positive and the negative direction of the axes. */
const AXIS_WORDS: Record<string, [string, string]> = {
  surge: ["forward", "back"], sway: ["right", "left"], heave: ["up", "down"], yaw: ["turn right", "left"],
  roll: ["roll right", "left"], pitch: ["pitch up", "down"], lamps: ["lamps brighter", "darker"],
};
const STICK_WORDS: Record<string, string> = { yaw: "turn", sway: "left / right" };
const KEYLINE_TIME = 6000; // time from the first input until the line of keys disappears [ms]

interface Input {
  keys: string[];
  axes: number[];
  buttons: number[];
  sticks: number[];
}

/** The pilot's part of the state of a running simulation. */
export interface PilotState {
  pilot: boolean;
  mapping: Record<string, string>;
  reserved: string[];
  sticks: string[];
  names: Record<string, string>;
  why: string;
}

export class Pilot {
  isOn = false;
  private mapping: Record<string, string> = {}; // key -> its axes
  private reason = ""; // why no vehicle can be steered
  private names: Record<string, string> = {}; // axis -> name of its joint or thruster
  private reservedKeys = new Set<string>(); // all letters of the pilot, also those without effect on this vehicle
  private layout = ""; // what the present elements of the page were made for
  private readonly pressedKeys = new Set<string>();
  private readonly sticks = [0, 0, 0, 0];
  private lastText = "";
  private sendTime = 0;

  constructor(private readonly send: (message: object, isNew: boolean) => void) {
    document.addEventListener("keyup", (event) => {
      this.pressedKeys.delete(event.key.toLowerCase());
      this.poll();
    });
    window.addEventListener("blur", () => {
      this.pressedKeys.clear();
      this.poll();
    });
    setInterval(() => this.poll(), POLL);
  }

  /** Apply the pilot's part of the state of a simulation. */
  enable(state: PilotState): void {
    this.isOn = state.pilot;
    this.mapping = state.pilot ? state.mapping : {};
    this.reservedKeys = new Set(state.reserved);
    [this.names, this.reason] = [state.names, state.why];
    const layout = JSON.stringify([state.pilot, state.sticks, state.names, state.why]);
    if (layout === this.layout) return; // a stick may be held
    this.layout = layout;
    const sticks = SIDES.map((side, i) => this.stick(side, 2 * i, state.sticks.slice(2 * i, 2 * i + 2)));
    const parts = [...sticks.filter((part) => part !== null), this.reason ? make("p", this.reason, "why") : this.line()];
    element("pilot").replaceChildren(...parts.filter((part) => part !== null));
    element("pilot").hidden = !state.pilot;
  }

  /** Return true if a letter is a key of the pilot: the page's function of that letter needs Shift. */
  isReserved(key: string): boolean {
    return this.isOn && this.reservedKeys.has(key);
  }

  takeKey(event: KeyboardEvent): boolean {
    const key = event.key.toLowerCase();
    if (event.shiftKey || !this.isReserved(key)) return false;
    event.preventDefault();
    if (!(key in this.mapping)) return true; // it has no effect on this vehicle
    this.pressedKeys.add(key);
    this.poll();
    this.hideLine();
    return true;
  }

  help(): { keys: string; action: string }[] {
    const pairs = this.pairs();
    if (!pairs.length) return [{ keys: "–", action: this.reason || "this simulation has no pilot" }];
    const rows = pairs.map(({ axes, plusKeys, minusKeys }) => ({
      keys: `${plusKeys || "–"}  ${minusKeys || "–"}`, action: `${this.namesOf(axes)} +, −`,
    }));
    return [...rows, { keys: "Shift", action: "with a letter: the page's own key" }];
  }

  /** Return the axes with the keys of their positive and negative direction. */
  private pairs(): { axes: string; plusKeys: string; minusKeys: string }[] {
    const pairs = new Map<string, string[]>();
    for (const [key, targets] of Object.entries(this.mapping)) {
      if (!targets.trim()) continue;
      const [axes, way] = splitSign(targets);
      const pair = pairs.get(axes) ?? ["", ""];
      pair[way] += (pair[way] && ", ") + key;
      pairs.set(axes, pair);
    }
    return [...pairs].map(([axes, [plusKeys, minusKeys]]) => ({ axes, plusKeys, minusKeys }));
  }

  /** Return axes, with joints and thrusters by their names in the vehicle's files. */
  private namesOf(axes: string): string {
    return axes.split(" ").map((axis) => {
      const name = this.names[axis.replace("-", "")];
      return name ? axis.replace(/[a-z]+\d*/, name) : axis;
    }).join(" ");
  }

  /** Return the line of keys, which is shown until the first input. */
  private line(): HTMLElement | null {
    const pairs = this.pairs();
    if (!pairs.length) return null;
    const line = make("div", "", "keyline");
    for (const { axes, plusKeys, minusKeys } of pairs) {
      const part = make("span");
      const words = AXIS_WORDS[axes]?.join(" / ") ?? this.namesOf(axes);
      for (const key of [plusKeys, minusKeys]) if (key) part.append(make("kbd", key.toUpperCase()));
      part.append(` ${words}`);
      line.append(part);
    }
    const rest = make("span");
    rest.append(make("kbd", "?"), " all keys");
    const close = make("button", "×");
    close.setAttribute("aria-label", "Hide the line of keys");
    close.addEventListener("click", () => line.remove());
    line.append(rest, close);
    return line;
  }

  private hideLine(): void {
    const line = element("pilot").querySelector(".keyline");
    if (line && !line.classList.contains("leaves")) {
      line.classList.add("leaves");
      setTimeout(() => line.remove(), KEYLINE_TIME);
    }
  }

  private input(): Input {
    const pad = navigator.getGamepads?.().find((gamepad) => gamepad !== null);
    return {
      keys: [...this.pressedKeys].sort(),
      axes: pad ? pad.axes.map(roundValue) : [],
      buttons: pad ? pad.buttons.map(({ value }) => roundValue(value)) : [],
      sticks: this.sticks.map(roundValue),
    };
  }

  private poll(): void {
    if (!this.isOn) return;
    const input = this.input();
    const text = JSON.stringify(input);
    const now = performance.now();
    const isAtRest = !input.keys.length && ![...input.axes, ...input.buttons, ...input.sticks].some(Boolean);
    if (text === this.lastText && (isAtRest || now - this.sendTime < REPEAT)) return;
    const isNew = text !== this.lastText;
    this.lastText = text;
    this.sendTime = now;
    this.send({ type: "input", ...input }, isNew);
  }

  /** Return a stick with its label; null if it has no effect. */
  private stick(side: string, index: number, axes: string[]): HTMLElement | null {
    if (!axes.some((targets) => targets.trim())) return null;
    const [box, label] = [make("div", "", `thumb ${side}`), make("div", "", "label")];
    const signs = ["↔", "↕"];
    axes.forEach((targets, i) => {
      if (targets.trim()) label.prepend(make("span", `${signs[i]} ${this.stickWords(targets)}`));
    });
    const [pad, knob] = [make("div", "", "stick"), make("i")];
    pad.title = label.innerText;
    pad.append(knob);
    box.append(label, pad);
    const set = (x: number, y: number): void => {
      const length = Math.max(1, Math.hypot(x, y));
      this.sticks[index] = x / length;
      this.sticks[index + 1] = y / length;
      knob.style.transform = `translate(${(35 * x) / length}px, ${(-35 * y) / length}px)`;
      this.poll();
    };
    const move = (event: PointerEvent): void => {
      if (!pad.hasPointerCapture(event.pointerId)) return;
      const box = pad.getBoundingClientRect();
      const half = box.width / 2;
      set((event.clientX - box.left - half) / half, -(event.clientY - box.top - half) / half);
    };
    pad.addEventListener("pointerdown", (event) => {
      pad.setPointerCapture(event.pointerId);
      move(event);
    });
    pad.addEventListener("pointermove", move);
    for (const name of ["pointerup", "pointercancel"]) pad.addEventListener(name, () => set(0, 0));
    return box;
  }

  private stickWords(targets: string): string {
    const [axes] = splitSign(targets);
    return STICK_WORDS[axes] ?? AXIS_WORDS[axes]?.join(" / ") ?? this.namesOf(axes);
  }
}

/** Return targets with the sign of the first axis removed from all, and 0 if it was +, 1 if it was -. */
function splitSign(targets: string): [string, 0 | 1] {
  const parts = targets.trim().split(/\s+/);
  const flips = parts[0].startsWith("-");
  const axes = parts.map((part) => (part.startsWith("-") !== flips ? "-" : "") + part.replace(/^[+-]+/, ""));
  return [axes.join(" "), flips ? 1 : 0];
}

function roundValue(value: number): number {
  return Math.round(value * 1000) / 1000;
}
