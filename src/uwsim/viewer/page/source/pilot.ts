// A human pilot: keys, the first gamepad, and sticks on the screen.
import { element, make } from "./panels";

const REPEAT = 100; // [ms] between messages while anything is held
const POLL = 33; // [ms] between looks at the gamepad
const STICKS = ["Turn and heave", "Surge and sway"];

interface Input {
  keys: string[];
  axes: number[];
  buttons: number[];
  sticks: number[];
}

export class Pilot {
  isOn = false;
  private mapping: Record<string, string> = {};
  private why = ""; // nothing can be steered
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

  /** Which keys and sticks, left and right, do something; and why no vehicle can be steered. */
  enable(on: boolean, mapping: Record<string, string>, sticks: boolean[], why: string): void {
    this.mapping = on ? mapping : {};
    this.why = why;
    this.isOn = on;
    const shown = JSON.stringify([on, sticks, why]);
    if (shown === this.shown) return; // a stick may be held
    this.shown = shown;
    const parts = sticks.map((does, i) => does && this.stick(2 * i, STICKS[i])).filter((part) => part !== false);
    element("pilot").replaceChildren(...parts, ...(why ? [make("p", why)] : []));
    element("pilot").hidden = !on;
  }

  /** Whether a letter is the pilot's, so that the page's own needs Shift. */
  has(key: string): boolean {
    return this.isOn && key in this.mapping;
  }

  takes(event: KeyboardEvent): boolean {
    const key = event.key.toLowerCase();
    if (event.shiftKey || !this.has(key)) return false;
    event.preventDefault();
    this.held.add(key);
    this.look();
    return true;
  }

  help(): { keys: string; does: string }[] {
    const pairs = new Map<string, string[]>(); // axes -> the keys for more and for less of them
    for (const [key, does] of Object.entries(this.mapping)) {
      if (!does.trim()) continue;
      const [axes, way] = unsigned(does);
      const pair = pairs.get(axes) ?? ["", ""];
      pair[way] += (pair[way] && ", ") + key;
      pairs.set(axes, pair);
    }
    if (!pairs.size) return [{ keys: "–", does: this.why || "nobody pilots this simulation" }];
    const rows = [...pairs].map(([does, [more, less]]) => ({ keys: `${more || "–"}  ${less || "–"}`, does: `${does} +, −` }));
    return [...rows, { keys: "Shift", does: "with a letter: the page's own key" }];
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

  private stick(first: number, label: string): HTMLElement {
    const [pad, knob] = [make("div", "", "stick"), make("i")];
    pad.title = label;
    pad.append(knob);
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
    return pad;
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
