// The inputs of a human pilot: keys, the first gamepad, and on-screen sticks.
import { element, make } from "./panels";

const MESSAGE_PERIOD = 100; // period of messages while an input is active [ms]
const GAMEPAD_PERIOD = 33; // period of reading the gamepad [ms]
const STICK_SIDES = ["left", "right"];
/** The words for the positive and the negative direction of each axis. */
const AXIS_WORDS: Record<string, [string, string]> = {
  surge: ["forward", "back"], sway: ["right", "left"], heave: ["up", "down"], yaw: ["turn right", "left"],
  roll: ["roll right", "left"], pitch: ["pitch up", "down"], lamps: ["lamps brighter", "darker"],
};
const STICK_WORDS: Record<string, string> = { yaw: "turn", sway: "left / right" };
const KEY_HINTS_TIME = 6000; // time from the first key press until the hints disappear [ms]

/** The present input of the pilot. */
interface Input {
  /** The keys that are pressed. */
  keys: string[];
  /** The axes of the gamepad, -1 .. 1. */
  axes: number[];
  /** The buttons of the gamepad, 0 .. 1. */
  buttons: number[];
  /** The on-screen sticks: left x, y, right x, y, -1 .. 1, y up. */
  sticks: number[];
}

/** The fields of the message `state` that concern the pilot. */
export interface PilotState {
  /** True if the simulation accepts the input of a pilot. */
  pilot: boolean;
  /** The signed axes of each key that has an effect, for example `+surge`. */
  mapping: Record<string, string>;
  /** All keys of the pilot, including those without effect on this vehicle. */
  reserved: string[];
  /** The signed axes of the on-screen sticks: left x, y, right x, y; empty: no effect. */
  sticks: string[];
  /** The name of the joint or thruster of an axis such as `joint1`. */
  names: Record<string, string>;
  /** The reason why no vehicle can be steered; empty if one can. */
  why: string;
}

/** The reader of the pilot's inputs; it sends them to the simulation by `send`, whose `isNew` is true if they have changed. */
export class Pilot {
  /** True if the simulation accepts the input of a pilot. */
  isOn = false;
  private mapping: Record<string, string> = {}; // as in PilotState
  private reason = ""; // the reason why no vehicle can be steered
  private names: Record<string, string> = {}; // as in PilotState
  private reservedKeys = new Set<string>(); // all keys of the pilot, including those without effect on this vehicle
  private layout = ""; // the state from which the present elements of the page were made, as a text
  private readonly pressedKeys = new Set<string>();
  private readonly sticks = [0, 0, 0, 0];
  private lastText = ""; // the last input that was sent, as JSON
  private sendTime = 0; // wall time of the last message [ms]

  constructor(private readonly send: (message: object, isNew: boolean) => void) {
    document.addEventListener("keyup", (event) => {
      this.pressedKeys.delete(event.key.toLowerCase());
      this.poll();
    });
    window.addEventListener("blur", () => {
      this.pressedKeys.clear();
      this.poll();
    });
    setInterval(() => this.poll(), GAMEPAD_PERIOD);
  }

  /** Apply the pilot's fields of a message `state`. */
  enable(state: PilotState): void {
    this.isOn = state.pilot;
    this.mapping = state.pilot ? state.mapping : {};
    this.reservedKeys = new Set(state.reserved);
    [this.names, this.reason] = [state.names, state.why];
    const layout = JSON.stringify([state.pilot, state.sticks, state.names, state.why]);
    if (layout === this.layout) return; // replacing a stick would end a drag
    this.layout = layout;
    const sticks = STICK_SIDES.map((side, i) => this.stick(side, 2 * i, state.sticks.slice(2 * i, 2 * i + 2)));
    const parts = [...sticks.filter((part) => part !== null), this.reason ? make("p", this.reason, "why") : this.keyHints()];
    element("pilot").replaceChildren(...parts.filter((part) => part !== null));
    element("pilot").hidden = !state.pilot;
  }

  /** Return true if a key is a key of the pilot; the page's own function of that letter then needs Shift. */
  isReserved(key: string): boolean {
    return this.isOn && this.reservedKeys.has(key);
  }

  /** Apply a key of the pilot; return false if the key is not the pilot's. */
  handlePilotKey(event: KeyboardEvent): boolean {
    const key = event.key.toLowerCase();
    if (event.shiftKey || !this.isReserved(key)) return false;
    event.preventDefault();
    if (!(key in this.mapping)) return true; // the key has no effect on this vehicle
    this.pressedKeys.add(key);
    this.poll();
    this.hideKeyHints();
    return true;
  }

  /** Return the lines of the help for the pilot's keys. */
  help(): { keys: string; action: string }[] {
    const pairs = this.keyPairs();
    if (!pairs.length) return [{ keys: "–", action: this.reason || "this simulation has no pilot" }];
    const rows = pairs.map(({ axes, plusKeys, minusKeys }) => ({
      keys: `${plusKeys || "–"}  ${minusKeys || "–"}`, action: `${this.namesOf(axes)} +, −`,
    }));
    return [...rows, { keys: "Shift", action: "with a letter: the page's own key" }];
  }

  /** Return the axes with the keys for their positive and their negative direction. */
  private keyPairs(): { axes: string; plusKeys: string; minusKeys: string }[] {
    const pairs = new Map<string, string[]>();
    for (const [key, targets] of Object.entries(this.mapping)) {
      if (!targets.trim()) continue;
      const [axes, direction] = splitSign(targets);
      const pair = pairs.get(axes) ?? ["", ""];
      pair[direction] += (pair[direction] && ", ") + key;
      pairs.set(axes, pair);
    }
    return [...pairs].map(([axes, [plusKeys, minusKeys]]) => ({ axes, plusKeys, minusKeys }));
  }

  /** Return the text of some axes, with the names of joints and thrusters from the vehicle's files. */
  private namesOf(axes: string): string {
    return axes.split(" ").map((axis) => {
      const name = this.names[axis.replace("-", "")];
      return name ? axis.replace(/[a-z]+\d*/, name) : axis;
    }).join(" ");
  }

  /** Return the key hints, a line that is shown until the first key press; null if no key has an effect. */
  private keyHints(): HTMLElement | null {
    const pairs = this.keyPairs();
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

  private hideKeyHints(): void {
    const line = element("pilot").querySelector(".keyline");
    if (line && !line.classList.contains("leaves")) {
      line.classList.add("leaves");
      setTimeout(() => line.remove(), KEY_HINTS_TIME);
    }
  }

  /** Read the present input. */
  private input(): Input {
    const pad = navigator.getGamepads?.().find((gamepad) => gamepad !== null);
    return {
      keys: [...this.pressedKeys].sort(),
      axes: pad ? pad.axes.map(roundValue) : [],
      buttons: pad ? pad.buttons.map(({ value }) => roundValue(value)) : [],
      sticks: this.sticks.map(roundValue),
    };
  }

  /** Send the present input if it has changed, and at `MESSAGE_PERIOD` while it is active. */
  private poll(): void {
    if (!this.isOn) return;
    const input = this.input();
    const text = JSON.stringify(input);
    const now = performance.now();
    const isAtRest = !input.keys.length && ![...input.axes, ...input.buttons, ...input.sticks].some(Boolean);
    if (text === this.lastText && (isAtRest || now - this.sendTime < MESSAGE_PERIOD)) return;
    const isNew = text !== this.lastText;
    this.lastText = text;
    this.sendTime = now;
    this.send({ type: "input", ...input }, isNew);
  }

  /** Return an on-screen stick with its label; null if both of its axes have no effect. `index` is that of x in `sticks`. */
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

/** Return signed axes multiplied by the sign of the first one, and 0 if that sign is +, 1 if it is -. */
function splitSign(targets: string): [string, 0 | 1] {
  const parts = targets.trim().split(/\s+/);
  const flips = parts[0].startsWith("-");
  const axes = parts.map((part) => (part.startsWith("-") !== flips ? "-" : "") + part.replace(/^[+-]+/, ""));
  return [axes.join(" "), flips ? 1 : 0];
}

function roundValue(value: number): number {
  return Math.round(value * 1000) / 1000;
}
