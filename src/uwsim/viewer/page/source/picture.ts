// The image of the scene in the selected view, with the cameras' images and the overlay over it.
import type { Camera, Head, Water } from "./head";
import type { ActiveLamp } from "./drawing/light";
import { Models } from "./models";
import { drawOverlay, drawQuads, type OverlaySwitches } from "./overlay";
import type { Pack } from "./pack";
import { element, indexAt, make } from "./panels";
import type { Snapshot, Player } from "./player";
import { drawCompass } from "./display/compass";
import { isSoftware, Renderer } from "./drawing/renderer";
import { fitLens, type ViewCamera, type Views } from "./views";
import type { Lens } from "./geometry";

const PICTURE_HEIGHT = 150; // of a camera's image on the page [px]
const MAX_DRAWING_TIME = 2000; // time after which drawing has failed without an error [ms]
const HURRY_TIME = 300; // time after a pilot's input in which images are drawn without rests [ms]
const MAX_REST = 100; // greatest rest between two images that software draws [ms]

export interface Switches extends OverlaySwitches {
  clear: boolean;
  pictures: boolean;
  /** The head-up display. */
  state: boolean;
  sun: string;
  /** The index of the first point of trails. */
  trailStart: number;
}

/** Return a WebGL2 context of the canvas, antialiased by a GPU only; null without WebGL. */
export function graphics(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) return null;
  const antialias = !isSoftware(probe);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return canvas.getContext("webgl2", { alpha: false, antialias, powerPreference: "high-performance" });
}

/** The pace of drawing by a software renderer: rests leave time for other processes; images do not queue up. */
class Pace {
  private fence: WebGLSync | null = null;
  private beginTime = 0;
  private restEnd = 0; // wall time of the end of the rest [ms]
  private hurryEnd = 0; // wall time from which rests are made again [ms]

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** Record that an image has begun to be drawn. */
  begin(): void {
    if (this.fence) this.gl.deleteSync(this.fence);
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    this.beginTime = performance.now();
  }

  /** Draw without rests for a while, after an input. */
  skipRests(): void {
    this.hurryEnd = performance.now() + HURRY_TIME;
  }

  /** Return true if the last image is complete, and a rest as long as its drawing has passed. */
  isReady(now: number): boolean {
    const { gl, fence } = this;
    const isLost = gl.isContextLost() || now - this.beginTime > MAX_DRAWING_TIME;
    if (fence && (isLost || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED)) {
      gl.deleteSync(fence);
      this.fence = null;
      this.restEnd = Math.min(2 * now - this.beginTime, now + MAX_REST);
    }
    return !this.fence && (now >= this.restEnd || now < this.hurryEnd);
  }
}

export class Picture {
  readonly canvas = element<HTMLCanvasElement>("image");
  private readonly overlay = element<HTMLCanvasElement>("overlay");
  private readonly renderer: Renderer | null;
  private readonly frames: HTMLElement[] = [];
  private readonly images: ImageBitmap[] = []; // the newest image of each camera, from a running simulation
  private readonly pace: Pace | null;

  private constructor(
    private readonly gl: WebGL2RenderingContext | null,
    private readonly head: Head,
    readonly models: Models,
  ) {
    this.renderer = gl && new Renderer(gl, head, models);
    this.pace = gl && isSoftware(gl) ? new Pace(gl) : null;
    for (const camera of head.cameras) {
      const frame = make("figure");
      frame.append(make("figcaption", `${camera.name} · redrawn, no noise`));
      frame.style.aspectRatio = `${camera.width} / ${camera.height}`;
      element("pictures").append(frame);
      this.frames.push(frame);
    }
  }

  /** Make the picture; without WebGL it draws only lines and names, over the images of a live view. */
  static async make(gl: WebGL2RenderingContext | null, pack: Pack): Promise<Picture> {
    return new Picture(gl, pack.head, await Models.load(gl, pack));
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
    const clearWater = switches.clear ? { ...water, fog: 0 } : water;
    const lamps = this.lamps(snapshot);
    const { worldFromCamera, observer } = viewCamera;
    const lens = scaleLens(viewCamera.lens, ratio);
    const grey = viewCamera.camera?.grey;
    this.renderer?.draw({ worldFromCamera, lens, water: clearWater, lamps, observer, grey }, null, [0, 0]);
    const context = this.overlay.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, w, h);
    drawOverlay(context, worldFromCamera, viewCamera.lens, head, models, player, snapshot, switches, switches.trailStart);
    if (viewCamera.camera) drawQuads(context, viewCamera.camera, viewCamera.lens, 0, 0, snapshot);
    if (views.mode === "map") {
      const hud = element("hud");
      drawCompass(context, viewCamera.lens, views.height, hud.offsetTop + hud.offsetHeight);
    }
    this.frames.forEach((frame, i) => (frame.hidden = head.cameras[i] === viewCamera.camera));
    this.drawPictures(context, water, lamps, snapshot, switches, ratio, h);
    this.pace?.begin();
    return viewCamera;
  }

  /** Draw the next images without rests. */
  skipRests(): void {
    this.pace?.skipRests();
  }

  /** Return true if the next image of a motion may begin. */
  isReady(): boolean {
    return this.pace?.isReady(performance.now()) ?? true;
  }

  /** Return an image of the lens's size as RGBA, row 0 at the top. */
  image(lens: Lens, worldFromCamera: Float64Array, player: Player, snapshot: Snapshot,
        switches: Switches, water: Partial<Water> = {}, observer = false, grey = false): Uint8Array {
    const { gl, models, renderer } = this;
    if (!gl || !renderer) return new Uint8Array();
    models.place(snapshot.poses);
    const buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    const stores = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    [gl.RGBA8, gl.DEPTH_COMPONENT24].forEach((format, i) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, stores[i]);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, lens.width, lens.height);
      const attachment = i ? gl.DEPTH_ATTACHMENT : gl.COLOR_ATTACHMENT0;
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, stores[i]);
    });
    const state = {
      worldFromCamera, lens, lamps: this.lamps(snapshot), observer,
      water: { ...this.water(player, snapshot, switches), ...water },
      grey,
    };
    renderer.draw(state, buffer, [0, 0], true);
    const pixels = new Uint8Array(4 * lens.width * lens.height);
    gl.readPixels(0, 0, lens.width, lens.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    for (const store of stores) gl.deleteRenderbuffer(store);
    gl.deleteFramebuffer(buffer);
    return pixels;
  }

  /** Return the greatest width of the images of cameras on the page [px]. */
  pictureWidth(): number {
    const shapes = this.head.cameras.map(({ width, height }) => width / height);
    return Math.round(PICTURE_HEIGHT * Math.max(...shapes) * Math.min(devicePixelRatio, 2));
  }

  /** Show an image of a camera from a simulation, from the next drawing on. */
  show(camera: number, image: ImageBitmap): void {
    if (!this.frames[camera]) return;
    if (this.images[camera]) this.images[camera].close();
    else this.frames[camera].querySelector("figcaption")!.textContent = this.head.cameras[camera].name;
    this.images[camera] = image;
  }

  private drawPictures(
    context: CanvasRenderingContext2D, water: Water, lamps: ActiveLamp[], snapshot: Snapshot,
    switches: Switches, ratio: number, height: number,
  ): void {
    element("pictures").hidden = !switches.pictures;
    if (!switches.pictures) return;
    const origin = this.canvas.getBoundingClientRect();
    this.head.cameras.forEach((camera: Camera, i) => {
      if (this.frames[i].hidden) return;
      const box = this.frames[i].getBoundingClientRect();
      const [x, y] = [box.left - origin.left + 1, box.top - origin.top + 1];
      const lens = fitLens(camera, box.width - 2, box.height - 2);
      // a separate element would cause a new layout of the page for each image
      if (this.images[i]) context.drawImage(this.images[i], x, y, box.width - 2, box.height - 2);
      else {
        const worldFromCamera = this.models.worldFromMount(camera);
        const corner: [number, number] = [
          Math.round(x * ratio), Math.round((height - y - box.height + 2) * ratio),
        ];
        const { grey } = camera;
        const state = { worldFromCamera, lens: scaleLens(lens, ratio), water, lamps, observer: false, grey };
        this.renderer?.draw(state, null, corner);
      }
      drawQuads(context, camera, lens, x, y, snapshot);
    });
  }

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

  private lamps(snapshot: Snapshot): ActiveLamp[] {
    return this.head.lamps
      .map((lamp) => ({ lamp, brightness: snapshot.signal(`lamp/${lamp.name}`) ?? Number(lamp.on) }))
      .filter(({ brightness }) => brightness > 0)
      .map(({ lamp, brightness }) => ({
        lamp: { ...lamp, intensity: brightness * lamp.intensity },
        worldFromLamp: this.models.worldFromMount(lamp),
      }));
  }
}

/** Return the lens of an image whose sides are scaled by a ratio, and rounded. */
function scaleLens(lens: Lens, ratio: number): Lens {
  const [width, height] = [Math.round(lens.width * ratio), Math.round(lens.height * ratio)];
  return {
    ...lens,
    width,
    height,
    fx: lens.fx * ratio,
    fy: lens.fy * ratio,
    cx: (lens.cx + 0.5) * ratio - 0.5,
    cy: (lens.cy + 0.5) * ratio - 0.5,
    skew: lens.skew * ratio,
  };
}
