// Puts the page together: a replay that lies in it, or a live view.
import { Curves } from "./curves";
import { Keyboard } from "./keys";
import { connect, type Link } from "./live";
import { fromText, unpack, type Pack } from "./pack";
import { element, indexAt, isUnseen, LevelList, make, Thrusters, toggleHelp } from "./panels";
import { graphics, Picture, type Switches } from "./picture";
import { Replay, Stream, type Player } from "./player";
import { expose } from "./testing";
import { MODES, Views, type Mode } from "./views";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20];
const NAMES: Record<Mode, string> = { orbit: "Orbit", chase: "Chase", camera: "Camera", map: "Map" };

export class Page {
  time = 0;
  isPlaying = false;
  speed = 1;
  readonly switches: Switches = {
    clear: true, pictures: true, frames: false, labels: false, trails: true, sonars: true, sun: "",
    since: 0,
  };
  private readonly curves = new Curves(element("curves"), (time) => this.seek(time));
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
  ) {
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
    if (mode === "camera" && !this.pack.head.cameras.length) return;
    if (mode === "camera" && this.views.mode === "camera")
      this.views.camera = (this.views.camera + 1) % this.pack.head.cameras.length;
    this.views.mode = mode;
    this.refresh();
  }

  toggle(name: "clear" | "pictures" | "frames" | "labels" | "trails" | "sonars"): void {
    this.switches[name] = !this.switches[name];
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
  }

  draw(): void {
    if (this.player.isLive) this.time = this.player.end;
    const moment = this.player.moment(this.time);
    const sight = this.picture.draw(this.player, moment, this.views, this.switches);
    if (sight) this.link?.ask(sight);
    this.levels.show(this.time);
    this.curves.show(this.time, this.player.curves);
    this.thrusters.show(moment);
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

  private refresh(): void {
    const { mode, camera } = this.views;
    element("modes").querySelectorAll("button").forEach((button) => {
      button.setAttribute("aria-checked", String(button.dataset.mode === mode));
    });
    element("switches").querySelectorAll("button").forEach((button) => {
      const name = button.dataset.switch as keyof Switches;
      button.setAttribute("aria-pressed", String(this.switches[name]));
    });
    const choice = element<HTMLSelectElement>("camera");
    choice.hidden = mode !== "camera" || this.pack.head.cameras.length < 2;
    choice.value = String(camera);
    this.draw();
  }

  private build(): void {
    for (const mode of MODES) {
      if (mode === "camera" && !this.pack.head.cameras.length) continue;
      const button = make("button", NAMES[mode]);
      button.dataset.mode = mode;
      button.setAttribute("role", "radio");
      button.addEventListener("click", () => this.show(mode));
      element("modes").append(button);
    }
    const switches = [
      ["clear", "Clear water", "Without fog, as an observer would like it (x)"],
      ["pictures", "Cameras", "Images of the cameras (c)"],
      ["frames", "Frames", "Coordinate frames with their names (f)"],
      ["trails", "Trails", "Where bodies have been (t)"],
      ["sonars", "Sonars", "Beams and fans (s)"],
    ] as const;
    for (const [name, text, title] of switches) {
      if (name === "sonars" && !this.pack.head.sensors.length) continue;
      if (name === "pictures" && !this.pack.head.cameras.length) continue;
      const button = make("button", text);
      button.dataset.switch = name;
      button.title = title;
      button.addEventListener("click", () => {
        if (name === "frames") this.switches.labels = !this.switches.frames;
        this.toggle(name);
      });
      element("switches").append(button);
    }
    const cameras = element<HTMLSelectElement>("camera");
    this.pack.head.cameras.forEach(({ name }, i) => cameras.append(new Option(name, String(i))));
    cameras.addEventListener("change", () => {
      this.views.camera = Number(cameras.value);
      this.refresh();
    });
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

async function begin(): Promise<void> {
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  const message = element("message");
  message.textContent = "Loading…";
  try {
    const data = document.getElementById("pack");
    const gl = graphics(element<HTMLCanvasElement>("image"));
    const link = data ? null : await connect(gl === null);
    const pack = link ? link.pack : await unpack(fromText(data!.textContent ?? ""));
    const picture = await Picture.make(gl, pack);
    const player: Player = link ? new Stream(pack.head) : new Replay(pack);
    const page = new Page(pack, player, picture, new Views(pack.head, picture.models), link);
    page.note = gl || link ? "" : "This browser has no WebGL 2: levels and curves alone are shown.";
    message.textContent = page.note;
    link?.begin(page, player as Stream);
    const wanted = Number(new URLSearchParams(location.hash.slice(1)).get("level") ?? 0);
    if (!link) {
      await page.select(player.levels[wanted]?.trial ?? 0);
      page.seek(player.levels[wanted] ? player.levels[wanted].level.start : player.start);
    }
    expose(page);
  } catch (error) {
    message.textContent = error instanceof Error ? error.message : String(error);
    throw error;
  }
}

void begin();
