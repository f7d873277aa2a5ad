// The views of the page: orbit, chase, camera, map, and the view of the scene file.
import type { Camera, Head, ViewSpec } from "./head";
import {
  fromPose, intrinsicsOf, lookAt, origin, plus, transform, unit, type Intrinsics, type Matrix,
} from "./geometry";
import type { Models } from "./models";
import type { Rays } from "./display/rays";

export type Mode = "orbit" | "chase" | "camera" | "map" | "file";
export const MODES: Mode[] = ["orbit", "chase", "camera", "map", "file"];
const CLEARANCE = 0.9; // distance of the chase camera from the vehicle, as a fraction of the distance to an obstacle [1]
const MIN_CHASE_DISTANCE = 0.4; // least distance of the chase camera from the vehicle [m]

/** The camera of the selected view. */
export interface ViewCamera {
  /** The pose in W, with OpenGL axes. */
  worldFromCamera: Matrix;
  intrinsics: Intrinsics;
  /** True for all views but that of a camera of the scene. */
  isExternal: boolean;
  /** The camera of the scene whose view is shown; null for an external view. */
  camera: Camera | null;
}

/** The selected view and the settings of all views. */
export class Views {
  mode: Mode = "orbit";
  /** The index of the camera that the camera view shows. */
  camera = 0;
  /** A counter that is incremented whenever a view is rotated, moved or zoomed. */
  version = 0;
  /** The index of the vehicle that the view follows. */
  vehicle = 0;
  private holdOffset: number[] | null = null; // displacement at which the orbit stopped following [m]; null: it follows
  private orbit: OrbitView; // the orbit view of the vehicle at its initial position
  private file: OrbitView | null = null; // the view of the scene file
  private chaseAzimuth = 0; // azimuth of the chase camera from the stern of the vehicle [rad]
  /** The height of the map's camera above the centre of the map [m]. */
  height = 12;
  private readonly mapOffset = [0, 0]; // offset of the map's centre from the vehicle, along x and y of W [m]

  constructor(
    private readonly head: Head,
    private readonly models: Models,
    private readonly rays: Rays,
  ) {
    this.orbit = toOrbit(head.view);
    this.restoreInitial();
  }

  /** Follow the vehicle with an index. */
  follow(vehicle: number): void {
    if (vehicle === this.vehicle) return;
    this.vehicle = vehicle;
    this.version += 1;
  }

  /** Let the orbit stop following the vehicle, or follow it again. */
  toggleFollowing(): void {
    this.holdOffset = this.holdOffset ? null : this.displacement();
    this.version += 1;
  }

  /** Restore the initial views. */
  restoreInitial(): void {
    this.version += 1;
    this.holdOffset = null;
    this.orbit = toOrbit(this.head.view);
    this.file = this.head.file_view && toOrbit(this.head.file_view);
    this.chaseAzimuth = 0;
    this.mapOffset.fill(0);
    this.height = Math.max(6, 2 * this.orbit.distance);
  }

  /** Return the camera of the selected view for an image size [px]. */
  viewCamera(width: number, height: number): ViewCamera {
    const { view, file_view } = this.head;
    const intrinsics = intrinsicsOf(width, height, (this.mode === "file" && file_view ? file_view : view).fovy);
    const camera = this.mode === "camera" ? this.head.cameras[this.camera] : undefined;
    if (camera) {
      const cameraIntrinsics = fitIntrinsics(camera, width, height);
      const worldFromCamera = this.models.worldFromMount(camera);
      return { worldFromCamera, intrinsics: cameraIntrinsics, isExternal: false, camera };
    }
    let worldFromCamera: Matrix;
    if (this.mode === "map") {
      const [x, y] = plus(this.centre(), [...this.mapOffset, 0]);
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
    return { worldFromCamera, intrinsics, isExternal: true, camera: null };
  }

  /** Rotate the view by a drag of dx, dy (fractions of the view's height, y down); with `isPan`, move it. */
  drag(dx: number, dy: number, isPan: boolean): void {
    this.version += 1;
    if (this.mode === "map" || isPan) return this.move(dx, dy);
    if (this.mode === "chase") this.chaseAzimuth -= 4 * dx;
    else this.activeView().azimuth -= 4 * dx;
    const activeView = this.activeView();
    activeView.elevation = clamp(activeView.elevation + 3 * dy, -1.55, 1.55);
  }

  /** Multiply the distance of the view's camera by a factor. */
  zoom(factor: number): void {
    this.version += 1;
    if (this.mode === "map") this.height = clamp(this.height * factor, 0.5, 2000);
    else this.activeView().distance = clamp(this.activeView().distance * factor, 0.1, 2000);
  }

  /** Move the view parallel to the image by a drag. */
  private move(dx: number, dy: number): void {
    if (this.mode === "map") {
      const span = 2 * this.height * Math.tan(this.head.view.fovy / 2);
      this.mapOffset[0] -= dx * span;
      this.mapOffset[1] += dy * span;
      return;
    }
    const activeView = this.activeView();
    const m = orbitPose(activeView);
    activeView.target = plus(activeView.target, [m[0], m[4], m[8]], -dx * activeView.distance);
    activeView.target = plus(activeView.target, [m[1], m[5], m[9]], dy * activeView.distance);
  }

  /** Return the view that a drag rotates: the view of the scene file, or the orbit (also the chase view's elevation). */
  private activeView(): OrbitView {
    return this.mode === "file" && this.file ? this.file : this.orbit;
  }

  /**
   * Return the pose of the chase camera, at an azimuth and an elevation [rad] from the vehicle.
   *
   * The camera is nearer than the orbit's distance if an obstacle lies between it and the vehicle.
   */
  private chasePose(azimuth: number, elevation: number): Matrix {
    const target = this.centre();
    const { distance } = this.orbit;
    const pose = orbitPose({ target, azimuth, elevation, distance });
    const vehicle = this.head.vehicles[this.vehicle].name;
    const bodyPose = (body: string): Matrix => this.models.body(body);
    const offset = 0.05 * distance;
    const fractions = [[0, 0], [offset, 0], [-offset, 0], [0, offset], [0, -offset]].map(([x, y]) =>
      this.rays.cast(target, transform(pose, [x, y, 0]), bodyPose, (body) => body.vehicle === vehicle),
    );
    const fraction = Math.min(...fractions);
    if (fraction >= 1) return pose;
    const chaseDistance = Math.max(Math.min(MIN_CHASE_DISTANCE, distance), CLEARANCE * fraction * distance);
    return orbitPose({ target, azimuth, elevation, distance: chaseDistance });
  }

  /** Return the pose of the base of the followed vehicle in W; null if the scene has no vehicle. */
  private base(): Matrix | null {
    const vehicle = this.head.vehicles[this.vehicle];
    return vehicle ? this.models.body(vehicle.body) : null;
  }

  /** Return the displacement of the followed vehicle from its initial position, in W [m]. */
  private displacement(): number[] {
    const vehicle = this.head.vehicles[this.vehicle];
    const initialBody = this.head.bodies.find(({ name }) => name === vehicle?.body);
    return initialBody ? plus(this.centre(), initialBody.pose.slice(0, 3), -1) : [0, 0, 0];
  }

  /** Return the position of the followed vehicle in W, or the point around which the initial view turns [m]. */
  private centre(): number[] {
    const base = this.base();
    return base ? transform(base, [0, 0, 0]) : this.head.view.at;
  }
}

/** A view that turns around a point. */
interface OrbitView {
  /** The point, in W [m]. */
  target: number[];
  /** The azimuth of the camera from the point, from x towards y [rad]. */
  azimuth: number;
  /** The elevation of the camera above the point [rad]. */
  elevation: number;
  /** The distance of the camera from the point [m]. */
  distance: number;
}

/** Convert a view of the head. */
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

/** Return the pose of the camera in W (OpenGL axes). */
function orbitPose({ target, azimuth, elevation, distance }: OrbitView): Matrix {
  const [c, s] = [Math.cos(elevation), Math.sin(elevation)];
  const out = unit([c * Math.cos(azimuth), c * Math.sin(azimuth), s]);
  return lookAt(plus(target, out, distance), target);
}

/** Return the intrinsics for an image size [px] such that the image contains the whole image of a camera. */
export function fitIntrinsics(camera: Intrinsics, width: number, height: number): Intrinsics {
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
