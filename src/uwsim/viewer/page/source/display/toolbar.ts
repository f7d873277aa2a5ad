// The toolbar: buttons that select the view, and buttons that show or hide parts of it.
import type { Controls, Switch } from "../controls";
import { element, make } from "../panels";
import type { Mode } from "../views";

const VIEWS: Record<Mode, [label: string, tooltip: string]> = {
  orbit: ["Orbit", "Orbit around the vehicle (o)"],
  chase: ["Chase", "From behind the vehicle (b)"],
  camera: ["Camera", "Image of a camera (v)"],
  map: ["Map", "From above, north up (m)"],
  file: ["File", "From the <camera> of the scene file (p)"],
};
const SWITCHES: Record<Exclude<Switch, "labels">, [label: string, tooltip: string]> = {
  clear: ["Clear water", "Water without fog (x)"],
  state: ["State", "Depth, heading, joints and more; a click on a number draws its curve (z)"],
  pictures: ["Cameras", "Images of the cameras (c)"],
  frames: ["Frames", "Coordinate frames with their names (f)"],
  trails: ["Trails", "Trails of bodies (t)"],
  sonars: ["Sonars", "Beams and fans (s)"],
};

/** Add a button for each view, and the list of the cameras. */
export function addViews(page: Controls, modes: Mode[], cameras: string[]): void {
  for (const mode of modes) {
    const [label, tooltip] = VIEWS[mode];
    const button = make("button", label);
    button.title = tooltip;
    button.dataset.mode = mode;
    button.setAttribute("role", "radio");
    button.addEventListener("click", () => page.show(mode));
    element("modes").append(button);
  }
  const choice = element<HTMLSelectElement>("camera");
  cameras.forEach((name, i) => choice.append(new Option(name, String(i))));
  choice.addEventListener("change", () => {
    page.views.camera = Number(choice.value);
    page.refresh();
  });
}

/** Add a button for each switch that applies to the scene. */
export function addSwitches(page: Controls): void {
  const { sensors, cameras, vehicles } = page.pack.head;
  const subjects: Record<string, number> = { // the number of items that a switch shows or hides
    sonars: sensors.length, pictures: cameras.length, state: vehicles.length,
  };
  for (const [name, [label, tooltip]] of Object.entries(SWITCHES)) {
    if (subjects[name] === 0) continue;
    const button = make("button", label);
    button.dataset.switch = name;
    button.title = tooltip;
    button.addEventListener("click", () => page.toggle(name as Switch));
    element("switches").append(button);
  }
}

/** Mark the active view and the switches that are on. */
export function markToolbar({ views, switches, pack }: Controls): void {
  for (const button of element("modes").querySelectorAll("button"))
    button.setAttribute("aria-checked", String(button.dataset.mode === views.mode));
  for (const button of element("switches").querySelectorAll("button"))
    button.setAttribute("aria-pressed", String(switches[button.dataset.switch as Switch]));
  const choice = element<HTMLSelectElement>("camera");
  choice.hidden = views.mode !== "camera" || pack.head.cameras.length < 2;
  choice.value = String(views.camera);
}
