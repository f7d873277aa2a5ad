// A human pilot: keys, the first gamepad, and sticks on the screen.
import { element, make } from "./panels";

const REPEAT = 100; // [ms] between messages while anything is held
const POLL = 33; // [ms] between looks at the gamepad
const SIDES = ["left", "right"];
/** What axes do, for more and for less of them. */
const WORDS: Record<string, [string, string]> = {
  surge: ["forward", "back"], sway: ["right", "left"], heave: ["up", "down"], yaw: ["turn right", "left"],
  roll: ["roll right", "left"], pitch: ["pitch up", "down"], lamps: ["lamps brighter", "darker"],
};
const ON_STICKS: Record<string, string> = { yaw: "turn", sway: "left / right" };
const QUIET = 6000; // after the first input the line of keys is gone [ms]

interface Input {
  keys: string[];
  axes: number[];
  buttons: number[];
  sticks: number[];
}

/** What a running simulation says of its piloting. */
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
  private mapping: Record<string, string> = {};
  private why = ""; // nothing can be steered
  private names: Record<string, string> = {}; // axis -> name of the joint or thruster it moves
  private reserved = new Set<string>(); // letters that are the pilot's, whatever the vehicle has
  private shown = "";
  private readonly held = new Set<string>();
  private readonly sticks = [0, 0, 0, 0];
  private last = "";
  private sent = 0;

  constructor(private readonly send: (message: object, isNews: boolean) => void) {
    document.addEventListener("keyup", (event) => {
      this.held.delete(event.key.toLowerCase());
      this.look();
    });
    window.addEventListener("blur", () => {
      this.held.clear();
      this.look();
    });
    setInterval(() => this.look(), POLL);
  }

  /** Take what a simulation says of its piloting. */
  enable(state: PilotState): void {
    this.isOn = state.pilot;
    this.mapping = state.pilot ? state.mapping : {};
    this.reserved = new Set(state.reserved);
    [this.names, this.why] = [state.names, state.why];
    const shown = JSON.stringify([state.pilot, state.sticks, state.names, state.why]);
    if (shown === this.shown) return; // a stick may be held
    this.shown = shown;
    const sticks = SIDES.map((side, i) => this.stick(side, 2 * i, state.sticks.slice(2 * i, 2 * i + 2)));
    const parts = [...sticks.filter((part) => part !== null), this.why ? make("p", this.why, "why") : this.line()];
    element("pilot").replaceChildren(...parts.filter((part) => part !== null));
    element("pilot").hidden = !state.pilot;
  }

  /** Whether a letter is the pilot's, so that the page's own needs Shift; the same for all vehicles. */
  has(key: string): boolean {
    return this.isOn && this.reserved.has(key);
  }

  takes(event: KeyboardEvent): boolean {
    const key = event.key.toLowerCase();
    if (event.shiftKey || !this.has(key)) return false;
    event.preventDefault();
    if (!(key in this.mapping)) return true; // this vehicle has nothing that it moves
    this.held.add(key);
    this.look();
    this.hideLine();
    return true;
  }

  help(): { keys: string; does: string }[] {
    const pairs = this.pairs();
    if (!pairs.length) return [{ keys: "–", does: this.why || "nobody pilots this simulation" }];
    const rows = pairs.map(({ axes, more, less }) => ({
      keys: `${more || "–"}  ${less || "–"}`, does: `${this.named(axes)} +, −`,
    }));
    return [...rows, { keys: "Shift", does: "with a letter: the page's own key" }];
  }

  /** What keys move, each with the keys for more and for less of it. */
  private pairs(): { axes: string; more: string; less: string }[] {
    const pairs = new Map<string, string[]>();
    for (const [key, does] of Object.entries(this.mapping)) {
      if (!does.trim()) continue;
      const [axes, way] = unsigned(does);
      const pair = pairs.get(axes) ?? ["", ""];
      pair[way] += (pair[way] && ", ") + key;
      pairs.set(axes, pair);
    }
    return [...pairs].map(([axes, [more, less]]) => ({ axes, more, less }));
  }

  /** Axes, with the names of joints and thrusters as in the files. */
  private named(axes: string): string {
    return axes.split(" ").map((axis) => {
      const name = this.names[axis.replace("-", "")];
      return name ? axis.replace(/[a-z]+\d*/, name) : axis;
    }).join(" ");
  }

  /** The keys in a line, until somebody has begun to pilot. */
  private line(): HTMLElement | null {
    const pairs = this.pairs();
    if (!pairs.length) return null;
    const line = make("div", "", "keyline");
    for (const { axes, more, less } of pairs) {
      const part = make("span");
      const words = WORDS[axes]?.join(" / ") ?? this.named(axes);
      for (const key of [more, less]) if (key) part.append(make("kbd", key.toUpperCase()));
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
      setTimeout(() => line.remove(), QUIET);
    }
  }

  private input(): Input {
    const pad = navigator.getGamepads?.().find((each) => each !== null);
    return {
      keys: [...this.held].sort(),
      axes: pad ? pad.axes.map(rounded) : [],
      buttons: pad ? pad.buttons.map(({ value }) => rounded(value)) : [],
      sticks: this.sticks.map(rounded),
    };
  }

  private look(): void {
    if (!this.isOn) return;
    const input = this.input();
    const text = JSON.stringify(input);
    const now = performance.now();
    const rests = !input.keys.length && ![...input.axes, ...input.buttons, ...input.sticks].some(Boolean);
    if (text === this.last && (rests || now - this.sent < REPEAT)) return;
    const isNews = text !== this.last;
    this.last = text;
    this.sent = now;
    this.send({ type: "input", ...input }, isNews);
  }

  /** A stick with its label; null where it moves nothing. */
  private stick(side: string, first: number, axes: string[]): HTMLElement | null {
    if (!axes.some((does) => does.trim())) return null;
    const [box, label] = [make("div", "", `thumb ${side}`), make("div", "", "label")];
    const signs = ["↔", "↕"];
    axes.forEach((does, i) => {
      if (does.trim()) label.prepend(make("span", `${signs[i]} ${this.stickWords(does)}`));
    });
    const [pad, knob] = [make("div", "", "stick"), make("i")];
    pad.title = label.innerText;
    pad.append(knob);
    box.append(label, pad);
    const set = (x: number, y: number): void => {
      const length = Math.max(1, Math.hypot(x, y));
      this.sticks[first] = x / length;
      this.sticks[first + 1] = y / length;
      knob.style.transform = `translate(${(35 * x) / length}px, ${(-35 * y) / length}px)`;
      this.look();
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

  private stickWords(does: string): string {
    const [axes] = unsigned(does);
    return ON_STICKS[axes] ?? WORDS[axes]?.join(" / ") ?? this.named(axes);
  }
}

/** What a key moves, for more of the first axis; and 0 if it does that, 1 if the opposite. */
function unsigned(does: string): [string, 0 | 1] {
  const targets = does.trim().split(/\s+/);
  const flips = targets[0].startsWith("-");
  const axes = targets.map((each) => (each.startsWith("-") !== flips ? "-" : "") + each.replace(/^[+-]+/, ""));
  return [axes.join(" "), flips ? 1 : 0];
}

function rounded(value: number): number {
  return Math.round(value * 1000) / 1000;
}
