// The views of the page: orbit, chase, camera, map, and the view of the scene file.
import type { Camera, Head, ViewSpec } from "./head";
import {
  fromPose, lensOf, lookAt, origin, plus, transform, unit, type Lens, type Matrix,
} from "./geometry";
import type { Models } from "./models";
import type { Rays } from "./display/rays";

export type Mode = "orbit" | "chase" | "camera" | "map" | "file";
export const MODES: Mode[] = ["orbit", "chase", "camera", "map", "file"];
const CLEARANCE = 0.9; // distance of the chase view, as a fraction of the distance to an obstacle [1]
const MIN_CHASE_DISTANCE = 0.4; // [m]

export interface ViewCamera {
  worldFromCamera: Matrix;
  lens: Lens;
  observer: boolean;
  camera: Camera | null;
}

export class Views {
  mode: Mode = "orbit";
  camera = 0;
  /** The version of the view, which grows with each rotation or motion. */
  version = 0;
  /** The number of the vehicle that the view follows. */
  vehicle = 0;
  private holdOffset: number[] | null = null; // where the orbit stopped following the vehicle; null: it follows [m]
  private orbit: OrbitView; // for the vehicle at its initial position
  private file: OrbitView | null = null; // the view of the scene file
  private chaseAzimuth = 0; // of the camera of the chase view, 0 behind the stern [rad]
  /** The height of the eye above the centre of the map [m]. */
  height = 12;
  private readonly shift = [0, 0]; // of the map's centre from the vehicle, along x and y of W [m]

  constructor(
    private readonly head: Head,
    private readonly models: Models,
    private readonly rays: Rays,
  ) {
    this.orbit = toOrbit(head.view);
    this.home();
  }

  /** Follow a vehicle. */
  follow(vehicle: number): void {
    if (vehicle === this.vehicle) return;
    this.vehicle = vehicle;
    this.version += 1;
  }

  /** Let the orbit stop following the vehicle, or follow it again. */
  hold(): void {
    this.holdOffset = this.holdOffset ? null : this.displacement();
    this.version += 1;
  }

  /** Restore the initial views. */
  home(): void {
    this.version += 1;
    this.holdOffset = null;
    this.orbit = toOrbit(this.head.view);
    this.file = this.head.file_view && toOrbit(this.head.file_view);
    this.chaseAzimuth = 0;
    this.shift.fill(0);
    this.height = Math.max(6, 2 * this.orbit.distance);
  }

  viewCamera(width: number, height: number): ViewCamera {
    const { view, file_view } = this.head;
    const lens = lensOf(width, height, (this.mode === "file" && file_view ? file_view : view).fovy);
    const camera = this.mode === "camera" ? this.head.cameras[this.camera] : undefined;
    if (camera) {
      const cameraLens = fitLens(camera, width, height);
      return { worldFromCamera: this.models.worldFromMount(camera), lens: cameraLens, observer: false, camera };
    }
    let worldFromCamera: Matrix;
    if (this.mode === "map") {
      const [x, y] = plus(this.centre(), [...this.shift, 0]);
      worldFromCamera = lookAt([x, y, this.centre()[2] + this.height], [x, y, this.centre()[2]], [0, 1, 0]);
    } else if (this.mode === "chase" && this.base()) {
      const base = this.base()!;
      const azimuth = Math.atan2(base[4], base[0]) + Math.PI + this.chaseAzimuth;
      worldFromCamera = this.chasePose(azimuth, Math.max(0.15, this.orbit.elevation));
    } else if (this.mode === "file" && this.file) worldFromCamera = orbitPose(this.file);
    else {
      const target = plus(this.orbit.target, this.holdOffset ?? this.displacement());
      worldFromCamera = orbitPose({ ...this.orbit, target });
    }
    return { worldFromCamera, lens, observer: true, camera: null };
  }

  /** Rotate the view by a drag, in fractions of its height; with `shifts`, move it. */
  drag(dx: number, dy: number, shifts: boolean): void {
    this.version += 1;
    if (this.mode === "map" || shifts) return this.move(dx, dy);
    if (this.mode === "chase") this.chaseAzimuth -= 4 * dx;
    else this.activeView().azimuth -= 4 * dx;
    const activeView = this.activeView();
    activeView.elevation = clamp(activeView.elevation + 3 * dy, -1.55, 1.55);
  }

  zoom(factor: number): void {
    this.version += 1;
    if (this.mode === "map") this.height = clamp(this.height * factor, 0.5, 2000);
    else this.activeView().distance = clamp(this.activeView().distance * factor, 0.1, 2000);
  }

  private move(dx: number, dy: number): void {
    if (this.mode === "map") {
      const span = 2 * this.height * Math.tan(this.head.view.fovy / 2);
      this.shift[0] -= dx * span;
      this.shift[1] += dy * span;
      return;
    }
    const activeView = this.activeView();
    const m = orbitPose(activeView);
    activeView.target = plus(activeView.target, [m[0], m[4], m[8]], -dx * activeView.distance);
    activeView.target = plus(activeView.target, [m[1], m[5], m[9]], dy * activeView.distance);
  }

  /** Return the view that a drag rotates: that of the file, or that of orbit and chase. */
  private activeView(): OrbitView {
    return this.mode === "file" && this.file ? this.file : this.orbit;
  }

  /** Return the camera's pose behind the vehicle; it is nearer if an obstacle is in between. */
  private chasePose(azimuth: number, elevation: number): Matrix {
    const target = this.centre();
    const { distance } = this.orbit;
    const pose = orbitPose({ target, azimuth, elevation, distance });
    const vehicle = this.head.vehicles[this.vehicle].name;
    const bodyPose = (body: string): Matrix => this.models.body(body);
    const offset = 0.05 * distance;
    const shares = [[0, 0], [offset, 0], [-offset, 0], [0, offset], [0, -offset]].map(([x, y]) =>
      this.rays.cast(target, transform(pose, [x, y, 0]), bodyPose, (body) => body.vehicle === vehicle),
    );
    const share = Math.min(...shares);
    if (share >= 1) return pose;
    const chaseDistance = Math.max(Math.min(MIN_CHASE_DISTANCE, distance), CLEARANCE * share * distance);
    return orbitPose({ target, azimuth, elevation, distance: chaseDistance });
  }

  private base(): Matrix | null {
    const vehicle = this.head.vehicles[this.vehicle];
    return vehicle ? this.models.body(vehicle.body) : null;
  }

  /** Return the displacement of the vehicle from its initial position. */
  private displacement(): number[] {
    const vehicle = this.head.vehicles[this.vehicle];
    const initialBody = this.head.bodies.find(({ name }) => name === vehicle?.body);
    return initialBody ? plus(this.centre(), initialBody.pose.slice(0, 3), -1) : [0, 0, 0];
  }

  private centre(): number[] {
    const base = this.base();
    return base ? transform(base, [0, 0, 0]) : this.head.view.at;
  }
}

/** A view that turns around a point in W: azimuth from x to y and elevation [rad], distance [m]. */
interface OrbitView {
  target: number[];
  azimuth: number;
  elevation: number;
  distance: number;
}

function toOrbit(view: ViewSpec): OrbitView {
  const offset = plus(origin(fromPose(view.pose)), view.at, -1);
  const distance = Math.hypot(...offset);
  return {
    target: [...view.at],
    azimuth: Math.atan2(offset[1], offset[0]),
    elevation: Math.asin(offset[2] / distance),
    distance,
  };
}

function orbitPose({ target, azimuth, elevation, distance }: OrbitView): Matrix {
  const [c, s] = [Math.cos(elevation), Math.sin(elevation)];
  const out = unit([c * Math.cos(azimuth), c * Math.sin(azimuth), s]);
  return lookAt(plus(target, out, distance), target);
}

/** Return a camera's lens for an image of another size that contains the whole image of the camera. */
export function fitLens(camera: Lens, width: number, height: number): Lens {
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
