// Keys and the pointer. The keys 1 2 3, c, f, r, t, y have the same functions as in UWSim.
import type { Controls } from "./controls";
import { element, fillHelp, toggleHelp } from "./panels";

const SUNS = ["clear", "dusk", "cloudy"];
const KEY_DRAG = 0.03; // the drag that is equivalent to one press of an arrow key, as a fraction of the view's height

/** The actions of keys and of the pointer. */
export class Keyboard {
  private dragState: { x: number; y: number; isPan: boolean } | null = null;

  constructor(private readonly page: Controls) {
    const view = element("view");
    document.addEventListener("keydown", (event) => this.onKeyDown(event));
    view.addEventListener("keydown", (event) => this.turnView(event));
    view.addEventListener("pointerdown", (event) => {
      if ((event.target as Element).closest("button, .stick")) return;
      view.setPointerCapture(event.pointerId);
      const isPan = event.button !== 0 || event.shiftKey;
      this.dragState = { x: event.clientX, y: event.clientY, isPan };
    });
    view.addEventListener("pointermove", (event) => this.drag(event));
    view.addEventListener("pointerup", () => (this.dragState = null));
    view.addEventListener("pointercancel", () => (this.dragState = null));
    view.addEventListener("contextmenu", (event) => event.preventDefault());
    view.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        page.views.zoom(Math.exp(0.001 * event.deltaY));
      },
      { passive: false },
    );
    this.showHelp();
  }

  /** Write the help; called again when the server has sent the pilot's keys. */
  showHelp(): void {
    fillHelp(this.groups());
  }

  private drag(event: PointerEvent): void {
    if (!this.dragState) return;
    const size = element("view").clientHeight;
    const [dx, dy] = [event.clientX - this.dragState.x, event.clientY - this.dragState.y];
    this.page.views.drag(dx / size, dy / size, this.dragState.isPan);
    Object.assign(this.dragState, { x: event.clientX, y: event.clientY });
  }

  /** Rotate the view with the arrow keys; move it with Shift and the arrow keys. */
  private turnView(event: KeyboardEvent): void {
    const steps: Record<string, [number, number]> = {
      ArrowLeft: [KEY_DRAG, 0], ArrowRight: [-KEY_DRAG, 0], ArrowUp: [0, KEY_DRAG], ArrowDown: [0, -KEY_DRAG],
    };
    const step = steps[event.key];
    if (!step || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.page.views.drag(step[0], step[1], event.shiftKey);
  }

  private onKeyDown(event: KeyboardEvent): void {
    const { page } = this;
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const target = event.target as HTMLElement;
    const isField = target instanceof HTMLSelectElement || target instanceof HTMLInputElement;
    if (isField && !/^[a-z?]$/.test(event.key)) return;
    if (event.key === " " && target instanceof HTMLButtonElement) return;
    if (/^(Home|End)$/.test(event.key) && element("help").contains(target)) return; // these keys scroll the help
    if (page.connection?.handlePilotKey(event)) return;
    // with Shift, a letter has the page's function even if it is a key of the pilot
    const key = event.shiftKey ? event.key.toLowerCase() : event.key;
    const action = this.actions()[key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  private actions(): Record<string, () => void> {
    const { page } = this;
    const jump = (direction: number) => () => {
      const now = page.player.levels.findIndex(
        ({ trial, level }) => trial === page.player.trial && level.end > page.time,
      );
      void page.go(Math.max(0, (now < 0 ? page.player.levels.length - 1 : now) + direction));
    };
    const sun = (index: number) => () => {
      page.switches.sun = SUNS[index];
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
      "<": () => page.changeSpeed(-1),
      ">": () => page.changeSpeed(1),
      o: () => page.show("orbit"),
      b: () => page.show("chase"),
      v: () => page.show("camera"),
      m: () => page.show("map"),
      p: () => page.show("file"),
      z: () => page.toggle("state"),
      h: () => page.views.restoreInitial(),
      k: () => page.views.toggleFollowing(),
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
      n: () => page.toggleTheme(),
      "1": sun(0),
      "2": sun(1),
      "3": sun(2),
      "?": toggleHelp,
    };
  }

  private groups(): Record<string, { keys: string; action: string }[]> {
    const { page } = this;
    const reset = page.connection ? "reset vehicles and objects" : "start of the level";
    const steps = [
      { keys: ", .", action: "one row back, forward" },
      { keys: "← →", action: "one second back, forward (in the view: rotate it)" },
      { keys: "[ ]", action: "previous, next level" },
      { keys: "Home End", action: "start, end" },
    ];
    const groups = {
      Time: [
        { keys: "space", action: "play, pause" },
        ...(page.connection ? [{ keys: ".", action: "one step" }] : steps),
        { keys: "< >", action: "slower, faster" },
        ...(page.connection && !page.connection.allowsReset ? [] : [{ keys: "r", action: reset }]),
      ],
      View: [
        { keys: "o b v m", action: "orbit, behind the vehicle, next camera, map from above" },
        ...(page.pack.head.file_view ? [{ keys: "p", action: "the camera of the scene file" }] : []),
        { keys: "k", action: "orbit follows the vehicle, or stays" },
        { keys: "arrows, drag", action: "rotate; with Shift or the right button: move" },
        { keys: "+ -, wheel", action: "nearer, farther" },
        { keys: "h", action: "first view" },
        { keys: "x", action: "clear water, or the scene's fog" },
        { keys: "1 2 3", action: "clear sky, dusk, cloudy" },
      ],
      Shown: [
        { keys: "c", action: "images of the cameras" },
        { keys: "z", action: "state of the vehicle; a click on a number draws its curve" },
        { keys: "f l", action: "frames, names" },
        { keys: "t y", action: "trails; restart them" },
        { keys: "s", action: "beams and fans of sonars" },
        { keys: "n", action: "light or dark colours" },
        { keys: "?", action: "these keys" },
      ],
    };
    if (!page.connection) return groups;
    const pilot = page.connection.pilot;
    for (const row of Object.values(groups).flat())
      row.keys = row.keys.split(" ").map((key) => (pilot.isReserved(key) ? `Shift+${key}` : key)).join(" ");
    return { ...groups, ...page.connection.helpGroups() };
  }
}
