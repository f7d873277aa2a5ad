// Where the page looks from: around a point, behind a vehicle, from a camera, from above.
import type { Camera, Head } from "./head";
import {
  fromPose, lensOf, looking, origin, plus, transform, unit, type Lens, type Matrix,
} from "./geometry";
import type { Models } from "./models";

export type Mode = "orbit" | "chase" | "camera" | "map";
export const MODES: Mode[] = ["orbit", "chase", "camera", "map"];

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
  private vehicle = 0; // that it goes along with
  private held: number[] | null = null; // way of the vehicle beyond which the orbit does not go
  private azimuth = 0;
  private elevation = 0.4;
  private distance = 5;
  private target: number[]; // as if the vehicle were where it began
  private turn = 0; // of the chase view, off the stern
  private height = 12;
  private readonly shift = [0, 0]; // of the map

  constructor(
    private readonly head: Head,
    private readonly models: Models,
  ) {
    this.target = head.view.at;
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
    const place = fromPose(this.head.view.pose);
    const away = plus(origin(place), this.head.view.at, -1);
    this.target = [...this.head.view.at];
    this.distance = Math.hypot(...away);
    this.azimuth = Math.atan2(away[1], away[0]);
    this.elevation = Math.asin(away[2] / this.distance);
    this.turn = 0;
    this.shift.fill(0);
    this.height = Math.max(6, 2 * this.distance);
  }

  sight(width: number, height: number): Sight {
    const lens = lensOf(width, height, this.head.view.fovy);
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
      place = this.around(this.centre(), heading, Math.max(0.15, this.elevation));
    } else place = this.around(plus(this.target, this.held ?? this.way()), this.azimuth, this.elevation);
    return { worldFromCamera: place, lens, observer: true, camera: null };
  }

  /** Turn by a drag over a share of the view. */
  drag(dx: number, dy: number, shifts: boolean): void {
    this.version += 1;
    if (this.mode === "map" || shifts) return this.move(dx, dy);
    if (this.mode === "chase") this.turn -= 4 * dx;
    else this.azimuth -= 4 * dx;
    this.elevation = Math.min(1.55, Math.max(-1.55, this.elevation + 3 * dy));
  }

  zoom(factor: number): void {
    this.version += 1;
    if (this.mode === "map") this.height = clamp(this.height * factor, 0.5, 2000);
    else this.distance = clamp(this.distance * factor, 0.1, 2000);
  }

  private move(dx: number, dy: number): void {
    if (this.mode === "map") {
      const span = 2 * this.height * Math.tan(this.head.view.fovy / 2);
      this.shift[0] -= dx * span;
      this.shift[1] += dy * span;
      return;
    }
    const m = this.around(this.target, this.azimuth, this.elevation);
    const span = this.distance;
    this.target = plus(this.target, [m[0], m[4], m[8]], -dx * span);
    this.target = plus(this.target, [m[1], m[5], m[9]], dy * span);
  }

  private around(target: ArrayLike<number>, azimuth: number, elevation: number): Matrix {
    const [c, s] = [Math.cos(elevation), Math.sin(elevation)];
    const out = unit([c * Math.cos(azimuth), c * Math.sin(azimuth), s]);
    return looking(plus(target, out, this.distance), target);
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
