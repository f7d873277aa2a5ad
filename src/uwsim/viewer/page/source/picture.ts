// The image of the scene in the selected view, with the overlay and the images of the scene's cameras (pictures).
import { FocusingSurfaces } from "./water/caustics/tile_waves";
import type { Camera, Head, Water } from "./head";
import type { ActiveLamp } from "./drawing/light";
import { Media } from "./water/media";
import { MovingSurfaces } from "./water/surface/moving_surface";
import { Models } from "./models";
import { drawOverlay, drawQuads, type OverlaySwitches } from "./overlay";
import type { Pack } from "./pack";
import { element, indexAt, make } from "./panels";
import type { Player } from "./player";
import type { Snapshot } from "./snapshot";
import { drawCompass } from "./display/compass";
import type { RenderState } from "./drawing/frame";
import { isSoftware, SoftwarePacing } from "./drawing/pacing";
import { Renderer } from "./drawing/renderer";
import { fitIntrinsics, type ViewCamera, type Views } from "./views";
import { scaleIntrinsics, type Intrinsics } from "./geometry";

const PICTURE_HEIGHT = 150; // height of a camera's image on the page [px]

/** The settings of the image that buttons and keys change. */
export interface Switches extends OverlaySwitches {
  /** True to draw the water without fog. */
  clear: boolean;
  /** True to show the images of the scene's cameras. */
  pictures: boolean;
  /** True to show the head-up display. */
  state: boolean;
  /** A key of `suns` of the head; empty: the sun of the scene. */
  sun: string;
}

/** The settings of an image for tests. */
export interface ImageSettings {
  /** Values instead of those of the scene's water. */
  water?: Partial<Water>;
  isExternal?: boolean;
  /** True for water without fog. */
  isClear?: boolean;
  grey?: boolean;
}

/** Return a WebGL 2 context of the canvas, with antialiasing if a GPU draws; null if there is no WebGL 2. */
export function graphics(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) return null;
  const antialias = !isSoftware(probe);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return canvas.getContext("webgl2", { alpha: false, antialias, powerPreference: "high-performance" });
}

/** The image of the scene: the canvas, the renderer, and the overlay. */
export class Picture {
  readonly canvas = element<HTMLCanvasElement>("image");
  private readonly head: Head;
  private readonly overlay = element<HTMLCanvasElement>("overlay");
  private readonly renderer: Renderer | null;
  private readonly frames: HTMLElement[] = [];
  private readonly images: ImageBitmap[] = []; // the newest image of each camera, from a running simulation
  private readonly pacing: SoftwarePacing | null;
  readonly media: Media;
  private readonly surfaces: MovingSurfaces;
  private readonly focusingSurfaces: FocusingSurfaces;

  private constructor(
    private readonly gl: WebGL2RenderingContext | null,
    pack: Pack,
    readonly models: Models,
  ) {
    const head = (this.head = pack.head);
    this.media = new Media(pack);
    this.surfaces = new MovingSurfaces(pack, head);
    this.focusingSurfaces = new FocusingSurfaces(pack, head);
    this.renderer = gl && new Renderer(gl, head, models);
    this.pacing = gl && isSoftware(gl) ? new SoftwarePacing(gl) : null;
    for (const camera of head.cameras) {
      const frame = make("figure");
      frame.append(make("figcaption", `${camera.name} · redrawn, no noise`));
      frame.style.aspectRatio = `${camera.width} / ${camera.height}`;
      element("pictures").append(frame);
      this.frames.push(frame);
    }
  }

  /** Make the image of a pack's scene; without WebGL it draws only the overlay, over the images that a live view receives. */
  static async make(gl: WebGL2RenderingContext | null, pack: Pack): Promise<Picture> {
    return new Picture(gl, pack, await Models.load(gl, pack));
  }

  /** Draw the image and return its camera; null while the canvas has no size. */
  draw(player: Player, snapshot: Snapshot, views: Views, switches: Switches): ViewCamera | null {
    const { canvas, head, models } = this;
    const ratio = this.gl && isSoftware(this.gl) ? 1 : Math.min(devicePixelRatio, 2);
    const [w, h] = [canvas.clientWidth, canvas.clientHeight];
    if (w === 0 || h === 0) return null;
    for (const layer of [canvas, this.overlay]) {
      const [width, height] = [Math.round(w * ratio), Math.round(h * ratio)];
      if (layer.width !== width || layer.height !== height) [layer.width, layer.height] = [width, height];
    }
    models.place(snapshot.poses);
    head.sand?.forEach((_, i) => models.setSand(i, player.sand(i, snapshot.time)));
    const viewCamera = views.viewCamera(w, h);
    const water = this.water(player, snapshot, switches);
    const optics = this.media.mediumAt(snapshot);
    const lamps = this.lamps(snapshot);
    const { worldFromCamera, isExternal } = viewCamera;
    const intrinsics = scaleIntrinsics(viewCamera.intrinsics, ratio);
    const grey = viewCamera.camera?.grey;
    const drift = snapshot.drift();
    const puffs = player.puffs(snapshot.time);
    const surface = this.surfaces.surfaceAt(player.trial, snapshot);
    const focusing = this.focusingSurfaces.surfaceAt(player.trial, snapshot);
    const state = {
      worldFromCamera, intrinsics, water, optics, lamps, isExternal, grey, drift, puffs, surface, focusing,
    };
    const clearState = { ...state, water: { ...water, fog: 0 }, optics: this.media.clearOptics(optics), drift: null };
    this.renderer?.draw(switches.clear ? clearState : state, null, [0, 0]);
    const context = this.overlay.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, w, h);
    drawOverlay(context, worldFromCamera, viewCamera.intrinsics, head, models, player, snapshot, switches);
    if (viewCamera.camera) drawQuads(context, viewCamera.camera, viewCamera.intrinsics, 0, 0, snapshot);
    if (views.mode === "map") {
      const hud = element("hud");
      drawCompass(context, viewCamera.intrinsics, views.height, hud.offsetTop + hud.offsetHeight);
    }
    this.frames.forEach((frame, i) => (frame.hidden = head.cameras[i] === viewCamera.camera));
    this.drawPictures(context, { ...state, isExternal: false }, snapshot, switches, ratio, h);
    this.pacing?.begin();
    return viewCamera;
  }

  /** True if physical water is drawn as fog, because this browser lacks floating-point textures. */
  get lacksFloats(): boolean {
    return this.renderer?.lacksFloats ?? false;
  }

  /** Draw without pauses for a while, after an input. */
  skipPauses(): void {
    this.pacing?.skipPauses();
  }

  /** Return true if the next image may begin. */
  isReady(): boolean {
    return this.pacing?.isReady(performance.now()) ?? true;
  }

  /** Return an image of the size `intrinsics.width` x `intrinsics.height` as RGBA, row 0 at the top; for tests. */
  image(intrinsics: Intrinsics, worldFromCamera: Float64Array, player: Player, snapshot: Snapshot,
        switches: Switches, settings: ImageSettings = {}): Uint8Array {
    const { gl, models, renderer } = this;
    if (!gl || !renderer) return new Uint8Array();
    models.place(snapshot.poses);
    const buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    const stores = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    [gl.RGBA8, gl.DEPTH_COMPONENT24].forEach((format, i) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, stores[i]);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, intrinsics.width, intrinsics.height);
      const attachment = i ? gl.DEPTH_ATTACHMENT : gl.COLOR_ATTACHMENT0;
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, stores[i]);
    });
    const { isExternal = false, isClear, grey } = settings;
    const optics = this.media.mediumAt(snapshot);
    const state = {
      worldFromCamera, intrinsics, lamps: this.lamps(snapshot), isExternal, isExact: true, grey,
      drift: isClear ? null : snapshot.drift(),
      puffs: player.puffs(snapshot.time),
      surface: this.surfaces.surfaceAt(player.trial, snapshot),
      focusing: this.focusingSurfaces.surfaceAt(player.trial, snapshot),
      optics: isClear ? this.media.clearOptics(optics) : optics,
      water: { ...this.water(player, snapshot, switches), ...settings.water, ...(isClear ? { fog: 0 } : {}) },
    };
    renderer.draw(state, buffer, [0, 0], true);
    const pixels = new Uint8Array(4 * intrinsics.width * intrinsics.height);
    gl.readPixels(0, 0, intrinsics.width, intrinsics.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    for (const store of stores) gl.deleteRenderbuffer(store);
    gl.deleteFramebuffer(buffer);
    return pixels;
  }

  /** Return the width of the widest camera image on the page [px]. */
  pictureWidth(): number {
    const shapes = this.head.cameras.map(({ width, height }) => width / height);
    return Math.round(PICTURE_HEIGHT * Math.max(...shapes) * Math.min(devicePixelRatio, 2));
  }

  /** Set the image of a camera that the simulation has sent; it is shown at the next drawing. */
  show(camera: number, image: ImageBitmap): void {
    if (!this.frames[camera]) return;
    if (this.images[camera]) this.images[camera].close();
    else this.frames[camera].querySelector("figcaption")!.textContent = this.head.cameras[camera].name;
    this.images[camera] = image;
  }

  private drawPictures(
    context: CanvasRenderingContext2D, scene: RenderState, snapshot: Snapshot, switches: Switches, ratio: number,
    height: number,
  ): void {
    element("pictures").hidden = !switches.pictures;
    if (!switches.pictures) return;
    const origin = this.canvas.getBoundingClientRect();
    this.head.cameras.forEach((camera: Camera, i) => {
      if (this.frames[i].hidden) return;
      const box = this.frames[i].getBoundingClientRect();
      const [x, y] = [box.left - origin.left + 1, box.top - origin.top + 1];
      const intrinsics = fitIntrinsics(camera, box.width - 2, box.height - 2);
      // a separate element would cause a new layout of the page for each image
      if (this.images[i]) context.drawImage(this.images[i], x, y, box.width - 2, box.height - 2);
      else {
        const worldFromCamera = this.models.worldFromMount(camera);
        const corner: [number, number] = [
          Math.round(x * ratio), Math.round((height - y - box.height + 2) * ratio),
        ];
        const { grey } = camera;
        const state = { ...scene, worldFromCamera, intrinsics: scaleIntrinsics(intrinsics, ratio), grey };
        this.renderer?.draw(state, null, corner);
      }
      drawQuads(context, camera, intrinsics, x, y, snapshot);
    });
  }

  /** Return the water at the time of a snapshot, with the fog and light rate of the level or of the signals. */
  private water(player: Player, snapshot: Snapshot, switches: Switches): Water {
    const values = player.levels[indexAt(player, snapshot.time)]?.level.values ?? {};
    const { fog, light_rate } = this.head.water;
    return {
      ...this.head.water,
      fog: snapshot.signal("fog") ?? values.fog ?? fog,
      light_rate: snapshot.signal("light_rate") ?? values.light ?? light_rate,
      sun: switches.sun || this.head.water.sun,
    };
  }

  /** Return the lamps that are on at the time of a snapshot. */
  private lamps(snapshot: Snapshot): ActiveLamp[] {
    return this.head.lamps
      .map((lamp, index) => ({ lamp, index, brightness: snapshot.signal(`lamp/${lamp.name}`) ?? Number(lamp.on) }))
      .filter(({ brightness }) => brightness > 0)
      .map(({ lamp, index, brightness }) => ({
        index,
        lamp: { ...lamp, intensity: brightness * lamp.intensity },
        worldFromLamp: this.models.worldFromMount(lamp),
      }));
  }
}
