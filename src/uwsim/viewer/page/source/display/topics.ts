// The topics of a running simulation that the user has selected: the values of the newest message, and their curves.
import { Curves } from "../curves";
import { element, make } from "../panels";
import type { Samples } from "../player";

const MAX_SAMPLES = 3000; // greatest number of samples of a curve
const MAX_TOPICS = 16; // greatest number of selected topics, a limit of the server

/** The fields of a message of a topic. */
export interface TopicMessage {
  type: "topic";
  /** The name of the topic. */
  name: string;
  /** The simulation time at which the message was published [s]. */
  time: number;
  fields: [path: string, value: number | string | null][];
  /** True if further fields have been left out. */
  is_cut: boolean;
}

/** The selected topics. */
export class Topics {
  private readonly cards = new Map<string, Card>();
  private types: Record<string, string> = {}; // message type by topic

  /** `request` sends the names of all selected topics to the simulation. */
  constructor(private readonly request: (names: string[]) => void) {
    const choice = element<HTMLSelectElement>("topic");
    choice.addEventListener("change", () => {
      this.add(choice.value);
      choice.value = "";
    });
  }

  /** Set the names and types of all topics. */
  list(topics: [name: string, type: string][]): void {
    this.types = Object.fromEntries(topics);
    const choice = element<HTMLSelectElement>("topic");
    const options = topics.map(([name, type]) => new Option(`${name}  (${type.replace("/msg/", "/")})`, name));
    choice.replaceChildren(new Option("Show a topic…", ""), ...options);
    element("topics-box").hidden = !topics.length;
  }

  showMessage(message: TopicMessage): void {
    this.cards.get(message.name)?.showMessage(message);
  }

  /** Draw the curves of all selected topics, with the cursor at a time [s]. */
  show(time: number): void {
    for (const card of this.cards.values()) card.show(time);
  }

  redrawCurves(): void {
    for (const card of this.cards.values()) card.curves.redraw();
  }

  /** Select a topic. */
  add(name: string): void {
    if (!name || this.cards.has(name) || this.cards.size >= MAX_TOPICS) return;
    const card = new Card(name, this.types[name] ?? "", () => {
      this.cards.delete(name);
      this.request([...this.cards.keys()]);
    });
    this.cards.set(name, card);
    element("topics").append(card.box);
    this.request([...this.cards.keys()]);
  }
}

/** The part of the page that shows a topic. */
class Card {
  readonly box = make("div", "", "topic");
  readonly curves: Curves;
  private readonly rows = new Map<string, { row: HTMLElement; value: HTMLElement }>();
  private readonly samples = new Map<string, Samples>();
  private readonly selection = new Set<string>();
  private readonly table = make("div", "", "fields");
  private readonly note = make("p", "No message yet. A topic without a subscriber may have none.", "none");

  constructor(name: string, type: string, close: () => void) {
    const [head, button, plots] = [make("h3"), make("button", "×"), make("div")];
    button.title = `Hide ${name}`;
    button.setAttribute("aria-label", button.title);
    button.addEventListener("click", () => {
      this.box.remove();
      close();
    });
    const title = make("span", name);
    title.title = type;
    head.append(title, button);
    this.box.append(head, this.note, this.table, plots);
    this.curves = new Curves(plots, () => {});
  }

  showMessage({ time, fields, is_cut }: TopicMessage): void {
    this.note.textContent = is_cut ? "The first fields of the message:" : "";
    this.note.hidden = !is_cut;
    for (const [path, value] of fields) {
      const isFirst = this.samples.size === 0;
      if (typeof value === "number") this.store(path, time, value);
      if (isFirst && this.samples.size) this.selection.add(path);
      const row = this.rows.get(path) ?? this.row(path, typeof value === "number");
      row.value.textContent = typeof value === "number" ? String(Number(value.toPrecision(6))) : (value ?? "–");
    }
    this.mark();
  }

  show(time: number): void {
    const entries = [...this.samples].filter(([path]) => this.selection.has(path));
    this.curves.show(time, entries.map(([, samples]) => samples));
  }

  private store(path: string, time: number, value: number): void {
    let samples = this.samples.get(path);
    if (!samples) this.samples.set(path, (samples = { name: path, unit: "", times: [], values: [] }));
    if (time <= (samples.times.at(-1) ?? -1)) return;
    samples.times.push(time);
    samples.values.push(value);
    if (samples.times.length <= MAX_SAMPLES) return;
    samples.times.splice(0, MAX_SAMPLES / 2);
    samples.values.splice(0, MAX_SAMPLES / 2);
  }

  private row(path: string, isNumber: boolean): { row: HTMLElement; value: HTMLElement } {
    const [row, value] = [make(isNumber ? "button" : "div", "", "field"), make("output")];
    row.append(make("span", path), value);
    if (isNumber) {
      row.title = "Show or hide its curve";
      row.addEventListener("click", () => {
        if (!this.selection.delete(path)) this.selection.add(path);
        this.mark();
      });
    }
    this.table.append(row);
    const cells = { row, value };
    this.rows.set(path, cells);
    return cells;
  }

  private mark(): void {
    for (const [path, { row }] of this.rows)
      if (row instanceof HTMLButtonElement) row.setAttribute("aria-pressed", String(this.selection.has(path)));
  }
}
