// Where the page looks from: around a point, behind a vehicle, from a camera, from above.
import type { Camera, Head, Place } from "./head";
import {
  fromPose, lensOf, looking, origin, plus, transform, unit, type Lens, type Matrix,
} from "./geometry";
import type { Models } from "./models";
import type { Rays } from "./display/rays";

export type Mode = "orbit" | "chase" | "camera" | "map" | "file";
export const MODES: Mode[] = ["orbit", "chase", "camera", "map", "file"];
const CLEARANCE = 0.9; // of the way to what hides the vehicle from the chase view [1]
const CLOSEST = 0.4; // of that view [m]

export interface Sight {
  worldFromCamera: Matrix;
  lens: Lens;
  observer: boolean;
  camera: Camera | null;
}

export class Views {
  mode: Mode = "orbit";
  camera = 0;
  /** Grows whenever the view was turned or moved. */
  version = 0;
  /** Number of the vehicle that it goes along with. */
  vehicle = 0;
  private held: number[] | null = null; // way of the vehicle beyond which the orbit does not go
  private orbit: Around; // as if the vehicle were where it began
  private file: Around | null = null; // the view of the scene file
  private turn = 0; // of the chase view, off the stern
  /** Of the eye above what the map shows [m]. */
  height = 12;
  private readonly shift = [0, 0]; // of the map

  constructor(
    private readonly head: Head,
    private readonly models: Models,
    private readonly rays: Rays,
  ) {
    this.orbit = aroundOf(head.view);
    this.home();
  }

  /** Go along with a vehicle. */
  follow(vehicle: number): void {
    if (vehicle === this.vehicle) return;
    this.vehicle = vehicle;
    this.version += 1;
  }

  /** Let the orbit stay where it is, or go along with the vehicle again. */
  hold(): void {
    this.held = this.held ? null : this.way();
    this.version += 1;
  }

  /** The first view again. */
  home(): void {
    this.version += 1;
    this.held = null;
    this.orbit = aroundOf(this.head.view);
    this.file = this.head.file_view && aroundOf(this.head.file_view);
    this.turn = 0;
    this.shift.fill(0);
    this.height = Math.max(6, 2 * this.orbit.distance);
  }

  sight(width: number, height: number): Sight {
    const { view, file_view } = this.head;
    const lens = lensOf(width, height, (this.mode === "file" && file_view ? file_view : view).fovy);
    const camera = this.mode === "camera" ? this.head.cameras[this.camera] : undefined;
    if (camera) {
      const own = inside(camera, width, height);
      return { worldFromCamera: this.models.mounted(camera), lens: own, observer: false, camera };
    }
    let place: Matrix;
    if (this.mode === "map") {
      const [x, y] = plus(this.centre(), [...this.shift, 0]);
      place = looking([x, y, this.centre()[2] + this.height], [x, y, this.centre()[2]], [0, 1, 0]);
    } else if (this.mode === "chase" && this.base()) {
      const ahead = this.base()!;
      const heading = Math.atan2(ahead[4], ahead[0]) + Math.PI + this.turn;
      place = this.behind(heading, Math.max(0.15, this.orbit.elevation));
    } else if (this.mode === "file" && this.file) place = around(this.file);
    else place = around({ ...this.orbit, target: plus(this.orbit.target, this.held ?? this.way()) });
    return { worldFromCamera: place, lens, observer: true, camera: null };
  }

  /** Turn by a drag over a share of the view. */
  drag(dx: number, dy: number, shifts: boolean): void {
    this.version += 1;
    if (this.mode === "map" || shifts) return this.move(dx, dy);
    if (this.mode === "chase") this.turn -= 4 * dx;
    else this.turned().azimuth -= 4 * dx;
    const turned = this.turned();
    turned.elevation = clamp(turned.elevation + 3 * dy, -1.55, 1.55);
  }

  zoom(factor: number): void {
    this.version += 1;
    if (this.mode === "map") this.height = clamp(this.height * factor, 0.5, 2000);
    else this.turned().distance = clamp(this.turned().distance * factor, 0.1, 2000);
  }

  private move(dx: number, dy: number): void {
    if (this.mode === "map") {
      const span = 2 * this.height * Math.tan(this.head.view.fovy / 2);
      this.shift[0] -= dx * span;
      this.shift[1] += dy * span;
      return;
    }
    const turned = this.turned();
    const m = around(turned);
    turned.target = plus(turned.target, [m[0], m[4], m[8]], -dx * turned.distance);
    turned.target = plus(turned.target, [m[1], m[5], m[9]], dy * turned.distance);
  }

  /** What a drag turns: the view of the file, or that of orbit and chase. */
  private turned(): Around {
    return this.mode === "file" && this.file ? this.file : this.orbit;
  }

  /** The view from behind the vehicle, nearer where something else is between. */
  private behind(azimuth: number, elevation: number): Matrix {
    const target = this.centre();
    const { distance } = this.orbit;
    const free = around({ target, azimuth, elevation, distance });
    const vehicle = this.head.vehicles[this.vehicle].name;
    const place = (body: string): Matrix => this.models.body(body);
    const aside = 0.05 * distance;
    const shares = [[0, 0], [aside, 0], [-aside, 0], [0, aside], [0, -aside]].map(([x, y]) =>
      this.rays.cast(target, transform(free, [x, y, 0]), place, (body) => body.vehicle === vehicle),
    );
    const share = Math.min(...shares);
    if (share >= 1) return free;
    const nearer = Math.max(Math.min(CLOSEST, distance), CLEARANCE * share * distance);
    return around({ target, azimuth, elevation, distance: nearer });
  }

  private base(): Matrix | null {
    const vehicle = this.head.vehicles[this.vehicle];
    return vehicle ? this.models.body(vehicle.body) : null;
  }

  /** How far the vehicle has come from where it began. */
  private way(): number[] {
    const vehicle = this.head.vehicles[this.vehicle];
    const first = this.head.bodies.find(({ name }) => name === vehicle?.body);
    return first ? plus(this.centre(), first.pose.slice(0, 3), -1) : [0, 0, 0];
  }

  private centre(): number[] {
    const base = this.base();
    return base ? transform(base, [0, 0, 0]) : this.head.view.at;
  }
}

/** A view around a point. */
interface Around {
  target: number[];
  azimuth: number;
  elevation: number;
  distance: number;
}

function aroundOf(view: Place): Around {
  const away = plus(origin(fromPose(view.pose)), view.at, -1);
  const distance = Math.hypot(...away);
  return {
    target: [...view.at],
    azimuth: Math.atan2(away[1], away[0]),
    elevation: Math.asin(away[2] / distance),
    distance,
  };
}

function around({ target, azimuth, elevation, distance }: Around): Matrix {
  const [c, s] = [Math.cos(elevation), Math.sin(elevation)];
  const out = unit([c * Math.cos(azimuth), c * Math.sin(azimuth), s]);
  return looking(plus(target, out, distance), target);
}

/** The camera's pinhole on an image of another size, all of it in there. */
export function inside(camera: Lens, width: number, height: number): Lens {
  const factor = Math.min(height / camera.height, width / camera.width);
  return {
    width,
    height,
    fx: camera.fx * factor,
    fy: camera.fy * factor,
    cx: (width - 1) / 2 + (camera.cx - (camera.width - 1) / 2) * factor,
    cy: (height - 1) / 2 + (camera.cy - (camera.height - 1) / 2) * factor,
    skew: camera.skew * factor,
    near: camera.near,
    far: camera.far,
  };
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(high, Math.max(low, value));
}
