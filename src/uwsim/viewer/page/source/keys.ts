// Keys and the pointer. UWSim's keys are kept: 1 2 3, c, f, r, t, y.
import type { Controls } from "./controls";
import { element, fillHelp, toggleHelp } from "./panels";

const SUNS = ["clear", "dusk", "cloudy"];
const TURN = 0.03; // share of the view a key turns by

export class Keyboard {
  private dragged: { x: number; y: number; shifts: boolean } | null = null;

  constructor(private readonly page: Controls) {
    const view = element("view");
    document.addEventListener("keydown", (event) => this.press(event));
    view.addEventListener("keydown", (event) => this.turn(event));
    view.addEventListener("pointerdown", (event) => {
      if ((event.target as Element).closest("button, .stick")) return;
      view.setPointerCapture(event.pointerId);
      const shifts = event.button !== 0 || event.shiftKey;
      this.dragged = { x: event.clientX, y: event.clientY, shifts };
    });
    view.addEventListener("pointermove", (event) => this.drag(event));
    view.addEventListener("pointerup", () => (this.dragged = null));
    view.addEventListener("pointercancel", () => (this.dragged = null));
    view.addEventListener("contextmenu", (event) => event.preventDefault());
    view.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        page.views.zoom(Math.exp(0.001 * event.deltaY));
      },
      { passive: false },
    );
    this.help();
  }

  /** Write the list of keys; those of a pilot are known later. */
  help(): void {
    fillHelp(this.groups());
  }

  private drag(event: PointerEvent): void {
    if (!this.dragged) return;
    const size = element("view").clientHeight;
    const [dx, dy] = [event.clientX - this.dragged.x, event.clientY - this.dragged.y];
    this.page.views.drag(dx / size, dy / size, this.dragged.shifts);
    Object.assign(this.dragged, { x: event.clientX, y: event.clientY });
  }

  /** Arrow keys in the view turn it; with Shift they move it. */
  private turn(event: KeyboardEvent): void {
    const ways: Record<string, [number, number]> = {
      ArrowLeft: [TURN, 0], ArrowRight: [-TURN, 0], ArrowUp: [0, TURN], ArrowDown: [0, -TURN],
    };
    const way = ways[event.key];
    if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.page.views.drag(way[0], way[1], event.shiftKey);
  }

  private press(event: KeyboardEvent): void {
    const { page } = this;
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const target = event.target as HTMLElement;
    const isField = target instanceof HTMLSelectElement || target instanceof HTMLInputElement;
    if (isField && !/^[a-z?]$/.test(event.key)) return;
    if (event.key === " " && target instanceof HTMLButtonElement) return;
    if (/^(Home|End)$/.test(event.key) && element("help").contains(target)) return; // they scroll it
    if (page.link?.takes(event)) return;
    // with Shift, too: where somebody pilots, a letter alone may be the pilot's
    const key = event.shiftKey ? event.key.toLowerCase() : event.key;
    const act = this.actions()[key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  private actions(): Record<string, () => void> {
    const { page } = this;
    const jump = (direction: number) => () => {
      const now = page.player.levels.findIndex(
        ({ trial, level }) => trial === page.player.trial && level.end > page.time,
      );
      void page.go(Math.max(0, (now < 0 ? page.player.levels.length - 1 : now) + direction));
    };
    const sun = (number: number) => () => {
      page.switches.sun = SUNS[number];
      page.draw();
    };
    return {
      " ": () => page.play(),
      ",": () => page.step(-1),
      ".": () => page.step(1),
      ArrowLeft: () => page.seek(page.time - 1),
      ArrowRight: () => page.seek(page.time + 1),
      Home: () => page.seek(page.player.start),
      End: () => page.seek(page.player.end),
      "[": jump(-1),
      "]": jump(1),
      "<": () => page.faster(-1),
      ">": () => page.faster(1),
      o: () => page.show("orbit"),
      b: () => page.show("chase"),
      v: () => page.show("camera"),
      m: () => page.show("map"),
      p: () => page.show("file"),
      z: () => page.toggle("state"),
      h: () => page.views.home(),
      k: () => page.views.hold(),
      r: () => page.reset(),
      "+": () => page.views.zoom(0.9),
      "=": () => page.views.zoom(0.9),
      "-": () => page.views.zoom(1.1),
      x: () => page.toggle("clear"),
      c: () => page.toggle("pictures"),
      f: () => page.toggle("frames"),
      l: () => page.toggle("labels"),
      t: () => page.toggle("trails"),
      y: () => page.clearTrails(),
      s: () => page.toggle("sonars"),
      n: () => page.theme(),
      "1": sun(0),
      "2": sun(1),
      "3": sun(2),
      "?": toggleHelp,
    };
  }

  private groups(): Record<string, { keys: string; does: string }[]> {
    const { page } = this;
    const reset = page.link ? "vehicles and objects back where they began" : "begin of the level";
    const steps = [
      { keys: ", .", does: "one row back, on" },
      { keys: "← →", does: "one second back, on (in the view: turn it)" },
      { keys: "[ ]", does: "level before, after" },
      { keys: "Home End", does: "begin, end" },
    ];
    const own = {
      Time: [
        { keys: "space", does: "play, pause" },
        ...(page.link ? [{ keys: ".", does: "one step on" }] : steps),
        { keys: "< >", does: "slower, faster" },
        ...(page.link && !page.link.resets ? [] : [{ keys: "r", does: reset }]),
      ],
      View: [
        { keys: "o b v m", does: "orbit, behind the vehicle, next camera, map from above" },
        ...(page.pack.head.file_view ? [{ keys: "p", does: "the camera of the scene file" }] : []),
        { keys: "k", does: "orbit goes along with the vehicle, or stays" },
        { keys: "arrows, drag", does: "turn; with Shift or the right button: move" },
        { keys: "+ -, wheel", does: "nearer, farther" },
        { keys: "h", does: "first view again" },
        { keys: "x", does: "clear water, or the fog as it is" },
        { keys: "1 2 3", does: "clear sky, dusk, cloudy" },
      ],
      Shown: [
        { keys: "c", does: "images of the cameras" },
        { keys: "z", does: "state of the vehicle; a click on a number draws its curve" },
        { keys: "f l", does: "frames, names" },
        { keys: "t y", does: "trails; begin them anew" },
        { keys: "s", does: "beams and fans of sonars" },
        { keys: "n", does: "light or dark" },
        { keys: "?", does: "these keys" },
      ],
    };
    if (!page.link) return own;
    const pilot = page.link.pilot;
    for (const row of Object.values(own).flat())
      row.keys = row.keys.split(" ").map((key) => (pilot.has(key) ? `Shift+${key}` : key)).join(" ");
    return { ...own, ...page.link.help() };
  }
}
