// The page: the displayed time, and the settings that buttons, keys and a running simulation change.
import type { Controls, Switch } from "./controls";
import { Curves } from "./curves";
import { Keyboard } from "./keys";
import type { Connection } from "./live";
import { beginsClear } from "./water/media";
import type { Pack } from "./pack";
import { element, indexAt, hasNoMotion, LevelList, Thrusters, toggleHelp } from "./panels";
import type { Picture, Switches } from "./picture";
import type { Player } from "./player";
import { Hud } from "./display/hud";
import { Quantities } from "./display/quantities";
import type { Rays } from "./display/rays";
import { addSwitches, addViews, markToolbar } from "./display/toolbar";
import { MODES, type Mode, type Views } from "./views";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20]; // real-time factors

export class Page implements Controls {
  time = 0;
  isPlaying = false;
  speed = 1;
  readonly switches: Switches = {
    clear: true, pictures: true, state: true, frames: false, labels: false, trails: true, sonars: true, sun: "",
  };
  private readonly curves = new Curves(element("curves"), (time) => this.seek(time));
  readonly quantities: Quantities;
  private readonly hud: Hud;
  private readonly levels: LevelList;
  private readonly thrusters: Thrusters;
  readonly keyboard: Keyboard;
  private lastTick = performance.now(); // wall time of the last call of `tick` [ms]
  private drawnKey = ""; // the state of the last drawing, as a text
  note = ""; // a message about a limitation of this browser

  constructor(
    readonly pack: Pack,
    readonly player: Player,
    readonly picture: Picture,
    readonly views: Views,
    readonly connection: Connection | null,
    private readonly rays: Rays,
  ) {
    this.switches.clear = beginsClear(pack.head);
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
    const entry = this.player.levels[index];
    if (!entry || this.connection) return;
    await this.select(entry.trial);
    this.seek(entry.level.start);
  }

  /** Select the trial with an index. */
  async select(trial: number): Promise<void> {
    if (trial === this.player.trial) return;
    await this.player.select(trial);
    this.picture.models.select(trial);
    this.rays.trial = trial;
    element("message").textContent = hasNoMotion(this.player) ? "This trial has no recorded motion." : this.note;
    this.curves.set(this.player.curves);
    const { start, end } = this.player;
    this.levels.mark(start, end);
    Object.assign(element<HTMLInputElement>("time"), { min: String(start), max: String(end) });
  }

  seek(time: number): void {
    if (this.connection) return;
    this.time = Math.min(this.player.end, Math.max(this.player.start, time));
    this.draw();
  }

  play(isOn = !this.isPlaying): void {
    this.isPlaying = isOn;
    if (isOn && !this.connection && this.time >= this.player.end - 1e-6) this.time = this.player.start;
    this.connection?.control(isOn ? "play" : "pause");
    element("play").textContent = isOn ? "Pause" : "Play";
  }

  step(direction: number): void {
    this.play(false);
    if (this.connection) this.connection.control("step");
    else this.seek(this.time + direction / 30);
  }

  /** Reset a live simulation to its initial state, as UWSim's key r; in a replay, go to the start of the level. */
  reset(): void {
    if (this.connection) this.connection.control("reset");
    else this.seek(this.player.levels[indexAt(this.player, this.time)]?.level.start ?? this.player.start);
  }

  /** Set the real-time factor; `isSent`: true to send it to the simulation. */
  setSpeed(speed: number, isSent = true): void {
    this.speed = speed;
    const choice = element<HTMLSelectElement>("speed");
    if (![...choice.options].some(({ value }) => value === String(speed))) choice.append(option(speed));
    choice.value = String(speed);
    if (isSent) this.connection?.control("speed", speed);
  }

  /** Show whether the running simulation is paused, and its real-time factor (0: no limit). */
  setState(isPaused: boolean, speed: number): void {
    this.isPlaying = !isPaused;
    element("play").textContent = isPaused ? "Play" : "Pause";
    this.setSpeed(speed, false);
  }

  changeSpeed(direction: number): void {
    const rank = (speed: number) => speed || Infinity; // no limit is the highest factor
    const speeds = this.speeds().filter((speed) => (rank(speed) - rank(this.speed)) * direction > 0);
    const nextSpeed = direction > 0 ? speeds[0] : speeds.at(-1);
    if (nextSpeed !== undefined) this.setSpeed(nextSpeed);
  }

  /** Return the available real-time factors; 0: no limit. */
  private speeds(): number[] {
    return this.connection ? [...SPEEDS, 0] : SPEEDS;
  }

  show(mode: Mode): void {
    if (!this.modes().includes(mode)) return;
    if (mode === "camera" && this.views.mode === "camera")
      this.views.camera = (this.views.camera + 1) % this.pack.head.cameras.length;
    this.views.mode = mode;
    this.refresh();
  }

  /** Return the views that are available in this scene. */
  private modes(): Mode[] {
    const { cameras, file_view } = this.pack.head;
    return MODES.filter((mode) => (mode !== "camera" || cameras.length) && (mode !== "file" || file_view));
  }

  toggle(name: Switch): void {
    this.switches[name] = !this.switches[name];
    if (name === "frames") this.switches.labels = this.switches.frames;
    this.connection?.subscribe(this.switches.pictures);
    this.refresh();
  }

  clearTrails(): void {
    this.player.clearTrails(this.time);
    this.draw();
  }

  toggleTheme(): void {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    this.curves.redraw();
    this.hud.redrawCurves();
    this.connection?.topics.redrawCurves();
  }

  draw(): void {
    if (this.player.isLive) this.time = this.player.end;
    const snapshot = this.player.snapshot(this.time);
    this.hud.show(snapshot, this.views.vehicle, this.switches.state);
    const viewCamera = this.picture.draw(this.player, snapshot, this.views, this.switches);
    if (viewCamera) this.connection?.requestView(viewCamera);
    this.levels.show(this.time);
    this.curves.show(this.time, this.player.curves);
    element("curves-box").hidden = !this.player.curves.length;
    this.connection?.topics.show(this.time);
    this.thrusters.show(snapshot);
    const sections = [...document.querySelectorAll<HTMLElement>("aside > section")];
    document.body.classList.toggle("bare", sections.every(({ hidden }) => hidden));
    element<HTMLInputElement>("time").value = String(this.time);
    element("clock").textContent = this.player.isLive
      ? `${this.time.toFixed(2)} s`
      : `${this.time.toFixed(2)} / ${this.player.end.toFixed(2)} s`;
  }

  private tick(now: number): void {
    requestAnimationFrame((time) => this.tick(time)); // first, so that an error below does not end the animation
    const seconds = Math.min(0.25, (now - this.lastTick) / 1000);
    this.lastTick = now;
    if (this.isPlaying && !this.connection) {
      this.time = Math.min(this.player.end, this.time + seconds * this.speed);
      if (this.time >= this.player.end) this.play(false);
    }
    // draw only if something has changed
    const { clientWidth, clientHeight } = this.picture.canvas;
    const values = [this.time, this.player.end, clientWidth, clientHeight, this.views.version, this.player.version];
    const key = values.join() + JSON.stringify(this.switches);
    if (key !== this.drawnKey && !document.hidden && this.picture.isReady()) {
      this.drawnKey = key;
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

/** Return an option of the list of real-time factors. */
function option(speed: number): HTMLOptionElement {
  return new Option(speed ? `${speed}×` : "fastest", String(speed));
}
