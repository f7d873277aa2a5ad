// The page: the time shown, and what its buttons, keys and a running simulation change.
import type { Controls, Switch } from "./controls";
import { Curves } from "./curves";
import { Keyboard } from "./keys";
import type { Link } from "./live";
import type { Pack } from "./pack";
import { element, indexAt, isUnseen, LevelList, Thrusters, toggleHelp } from "./panels";
import type { Picture, Switches } from "./picture";
import type { Player } from "./player";
import { Hud } from "./display/hud";
import { Quantities } from "./display/quantities";
import type { Rays } from "./display/rays";
import { addSwitches, addViews, markToolbar } from "./display/toolbar";
import { MODES, type Mode, type Views } from "./views";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20];
export class Page implements Controls {
  time = 0;
  isPlaying = false;
  speed = 1;
  readonly switches: Switches = {
    clear: true, pictures: true, state: true, frames: false, labels: false, trails: true, sonars: true, sun: "",
    since: 0,
  };
  private readonly curves = new Curves(element("curves"), (time) => this.seek(time));
  readonly quantities: Quantities;
  private readonly hud: Hud;
  private readonly levels: LevelList;
  private readonly thrusters: Thrusters;
  readonly keyboard: Keyboard;
  private last = performance.now();
  private drawn = "";
  note = ""; // what the page cannot do

  constructor(
    readonly pack: Pack,
    readonly player: Player,
    readonly picture: Picture,
    readonly views: Views,
    readonly link: Link | null,
    rays: Rays,
  ) {
    this.quantities = new Quantities(pack.head, rays);
    this.hud = new Hud(this.quantities, player, (time) => this.seek(time), () => this.draw());
    this.levels = new LevelList(player, (index) => void this.go(index));
    this.thrusters = new Thrusters(pack.head);
    this.keyboard = new Keyboard(this);
    this.build();
    requestAnimationFrame((now) => this.tick(now));
  }

  /** Go to the beginning of a level. */
  async go(index: number): Promise<void> {
    const chosen = this.player.levels[index];
    if (!chosen || this.link) return;
    await this.select(chosen.trial);
    this.seek(chosen.level.start);
  }

  async select(trial: number): Promise<void> {
    if (trial === this.player.trial) return;
    await this.player.select(trial);
    element("message").textContent = isUnseen(this.player) ? "There is no motion of this level." : this.note;
    this.switches.since = 0;
    this.curves.set(this.player.curves);
    const { start, end } = this.player;
    this.levels.mark(start, end);
    Object.assign(element<HTMLInputElement>("time"), { min: String(start), max: String(end) });
  }

  seek(time: number): void {
    if (this.link) return;
    this.time = Math.min(this.player.end, Math.max(this.player.start, time));
    this.draw();
  }

  play(on = !this.isPlaying): void {
    this.isPlaying = on;
    if (on && !this.link && this.time >= this.player.end - 1e-6) this.time = this.player.start;
    this.link?.control(on ? "play" : "pause");
    element("play").textContent = on ? "Pause" : "Play";
  }

  step(direction: number): void {
    this.play(false);
    if (this.link) this.link.control("step");
    else this.seek(this.time + direction / 30);
  }

  /** UWSim's reset: live all goes back where it began, a replay to the beginning of the level. */
  reset(): void {
    if (this.link) this.link.control("reset");
    else this.seek(this.player.levels[indexAt(this.player, this.time)]?.level.start ?? this.player.start);
  }

  setSpeed(speed: number, tell = true): void {
    this.speed = speed;
    const choice = element<HTMLSelectElement>("speed");
    if (![...choice.options].some(({ value }) => value === String(speed))) choice.append(option(speed));
    choice.value = String(speed);
    if (tell) this.link?.control("speed", speed);
  }

  /** What a running simulation says of itself. */
  isTold(paused: boolean, speed: number): void {
    this.isPlaying = !paused;
    element("play").textContent = paused ? "Play" : "Pause";
    this.setSpeed(speed, false);
  }

  faster(direction: number): void {
    const all = this.speeds();
    const next = all[all.indexOf(this.speed) + direction];
    if (next !== undefined) this.setSpeed(next);
  }

  /** Those to choose from; 0: as fast as a simulation can. */
  private speeds(): number[] {
    return this.link ? [...SPEEDS, 0] : SPEEDS;
  }

  show(mode: Mode): void {
    if (!this.modes().includes(mode)) return;
    if (mode === "camera" && this.views.mode === "camera")
      this.views.camera = (this.views.camera + 1) % this.pack.head.cameras.length;
    this.views.mode = mode;
    this.refresh();
  }

  /** The views that this scene has. */
  private modes(): Mode[] {
    const { cameras, file_view } = this.pack.head;
    return MODES.filter((mode) => (mode !== "camera" || cameras.length) && (mode !== "file" || file_view));
  }

  toggle(name: Switch): void {
    this.switches[name] = !this.switches[name];
    if (name === "frames") this.switches.labels = this.switches.frames;
    this.link?.subscribe(this.switches.pictures);
    this.refresh();
  }

  /** The point from which trails are drawn on. */
  clearTrails(): void {
    const body = this.pack.head.vehicles[0]?.body ?? "";
    this.switches.since = this.player.trail(body, this.time).length;
  }

  theme(): void {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    this.curves.redraw();
    this.hud.repaint();
    this.link?.topics.repaint();
  }

  draw(): void {
    if (this.player.isLive) this.time = this.player.end;
    const moment = this.player.moment(this.time);
    this.hud.show(moment, this.views.vehicle, this.switches.state);
    const sight = this.picture.draw(this.player, moment, this.views, this.switches);
    if (sight) this.link?.ask(sight);
    this.levels.show(this.time);
    this.curves.show(this.time, this.player.curves);
    element("curves-box").hidden = !this.player.curves.length;
    this.link?.topics.show(this.time);
    this.thrusters.show(moment);
    const sections = [...document.querySelectorAll<HTMLElement>("aside > section")];
    document.body.classList.toggle("bare", sections.every(({ hidden }) => hidden));
    element<HTMLInputElement>("time").value = String(this.time);
    element("clock").textContent = this.player.isLive
      ? `${this.time.toFixed(2)} s`
      : `${this.time.toFixed(2)} / ${this.player.end.toFixed(2)} s`;
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next)); // first: what fails once is not the end
    const passed = Math.min(0.25, (now - this.last) / 1000);
    this.last = now;
    if (this.isPlaying && !this.link) {
      this.time = Math.min(this.player.end, this.time + passed * this.speed);
      if (this.time >= this.player.end) this.play(false);
    }
    // a page that nothing happens on costs nothing
    const { clientWidth, clientHeight } = this.picture.canvas;
    const state = [this.time, this.player.end, clientWidth, clientHeight, this.views.version, this.player.version];
    const key = state.join() + JSON.stringify(this.switches);
    if (key !== this.drawn && !document.hidden && this.picture.isReady()) {
      this.drawn = key;
      this.draw();
    }
  }

  refresh(): void {
    markToolbar(this);
    this.draw();
  }

  private build(): void {
    addViews(this, this.modes(), this.pack.head.cameras.map(({ name }) => name));
    addSwitches(this);
    const speeds = element<HTMLSelectElement>("speed");
    speeds.append(...this.speeds().map(option));
    speeds.addEventListener("change", () => this.setSpeed(Number(speeds.value)));
    this.setSpeed(1, false);
    const line = element<HTMLInputElement>("time");
    line.addEventListener("input", () => this.seek(Number(line.value)));
    element("play").addEventListener("click", () => this.play());
    element("step").addEventListener("click", () => this.step(1));
    element("back").addEventListener("click", () => this.step(-1));
    element("back").hidden = element("line").hidden = this.player.isLive;
    element("help-button").addEventListener("click", toggleHelp);
    this.refresh();
  }
}

function option(speed: number): HTMLOptionElement {
  return new Option(speed ? `${speed}×` : "fastest", String(speed));
}
