// The parts of the page around the view: levels, timeline, thrusters, help.
import type { Head, Level } from "./head";
import type { Player } from "./player";
import type { Snapshot } from "./snapshot";

/** Return the element of the page with an id. */
export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const node = document.getElementById(id);
  if (!node) throw new Error(`the page has no element ${id}`);
  return node as T;
}

/** Make an element with a text and a CSS class. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K, text = "", className = "",
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  node.textContent = text;
  node.className = className;
  return node;
}

/** Return the CSS class for a status. */
function classOf(status: string): string {
  if (status === "ok") return "ok";
  return status === "lost" || status.includes("error") ? "bad" : "other";
}

/** Return the index of the level of the selected trial at a time [s]; -1 before the first level. */
export function indexAt(player: Player, time: number): number {
  let index = -1;
  player.levels.forEach(({ trial, level }, i) => {
    if (trial === player.trial && level.start <= time + 1e-6) index = i;
  });
  return index;
}

/** Return true if the selected trial has no recorded motion. */
export function hasNoMotion(player: Player): boolean {
  const levels = player.levels.filter(({ trial }) => trial === player.trial);
  return levels.length > 0 && levels.every(({ level }) => level.status === "no motion");
}

/** The list of levels, with the status of the level at the displayed time. */
export class LevelList {
  private readonly list = element("levels");
  private current = -2; // the index of the marked level; -1: none, -2: the list has changed
  private lastLevel: Level | null | undefined = null; // the last level of the list at the last update

  constructor(
    private readonly player: Player,
    private readonly choose: (index: number) => void,
  ) {}

  show(time: number): void {
    if (this.lastLevel !== this.player.levels.at(-1)?.level) this.fill();
    const index = indexAt(this.player, time);
    if (index === this.current) return;
    this.current = index;
    this.list.querySelectorAll("button").forEach((button, i) => {
      button.setAttribute("aria-current", String(i === index));
      if (i !== index || this.list.contains(document.activeElement)) return;
      const top = button.offsetTop - this.list.offsetTop;
      if (top < this.list.scrollTop || top > this.list.scrollTop + this.list.clientHeight - 24)
        this.list.scrollTop = top - this.list.clientHeight / 2;
    });
    const level = this.player.levels[index]?.level;
    const badge = element("now");
    badge.textContent = level ? `${level.label} · ${level.status}` : "";
    badge.className = `badge ${level ? classOf(level.status) : ""}`;
    element("why").textContent = level?.why ?? "";
    element("why").title = level?.why ?? "";
  }

  /** Mark the levels of the selected trial on the timeline from `start` to `end` [s], coloured by status. */
  mark(start: number, end: number): void {
    const marks = element("marks");
    marks.replaceChildren();
    const percentage = (time: number): string => `${(100 * (time - start)) / Math.max(end - start, 1e-9)}%`;
    for (const { trial, level } of this.player.levels) {
      if (trial !== this.player.trial) continue;
      const part = make("i", "", classOf(level.status));
      part.style.left = percentage(level.start);
      part.style.width = percentage(start + level.end - level.start);
      part.title = `${level.label}: ${level.status}`;
      marks.append(part);
    }
  }

  private fill(): void {
    this.lastLevel = this.player.levels.at(-1)?.level;
    this.current = -2;
    element("levels-box").hidden = !this.lastLevel;
    this.list.replaceChildren(
      ...this.player.levels.map(({ level }, i) => {
        const button = make("button");
        button.append(make("span", level.label), make("span", level.status, classOf(level.status)));
        button.title = level.why ?? "";
        button.addEventListener("click", () => this.choose(i));
        const item = make("li");
        item.append(button);
        return item;
      }),
    );
  }
}

/** The bars that show the commands of the thrusters. */
export class Thrusters {
  private readonly bars: { signal: string; bar: HTMLElement; value: HTMLElement }[] = [];

  constructor(head: Head) {
    const container = element("thrusters");
    for (const vehicle of head.vehicles)
      for (const name of vehicle.thrusters) {
        const row = make("div");
        const [track, bar, value] = [make("span", "", "bar"), make("i"), make("output")];
        track.append(bar);
        const label = head.vehicles.length > 1 ? `${vehicle.name} ${name}` : name;
        row.append(make("span", label.replaceAll("_", " ")), track, value);
        container.append(row);
        this.bars.push({ signal: `thrust/${vehicle.name}/${name}`, bar, value });
      }
  }

  show(snapshot: Snapshot): void {
    let hasValues = false;
    for (const { signal, bar, value } of this.bars) {
      const now = snapshot.signal(signal);
      if (now === undefined) continue;
      hasValues = true;
      const width = 50 * Math.min(1, Math.abs(now));
      bar.style.left = `${now < 0 ? 50 - width : 50}%`;
      bar.style.width = `${width}%`;
      value.textContent = `${Math.round(100 * now) || 0} %`;
    }
    element("thrusters-box").hidden = !hasValues;
  }
}

/** Lines of the help: keys and what they do. */
export type Keys = { keys: string; action: string }[];

/** Write the help, with the keys of each group below the group's title. */
export function fillHelp(groups: Record<string, Keys>): void {
  const dialog = element<HTMLDialogElement>("help");
  dialog.replaceChildren();
  const [rows, columns] = [make("div", "", "rows"), make("div", "", "columns")];
  rows.tabIndex = 0; // so that arrow keys scroll it
  rows.append(columns);
  dialog.append(rows);
  for (const [title, keys] of Object.entries(groups)) {
    const list = make("dl");
    for (const entry of keys) list.append(make("dt", entry.keys), make("dd", entry.action));
    const group = make("section");
    group.append(make("h2", title), list);
    columns.append(group);
  }
  const close = make("button", "Close");
  close.addEventListener("click", () => dialog.close());
  dialog.append(close);
}

export function toggleHelp(): void {
  const dialog = element<HTMLDialogElement>("help");
  if (dialog.open) dialog.close();
  else dialog.showModal();
}
