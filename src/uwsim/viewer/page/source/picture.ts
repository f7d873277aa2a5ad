// The image: the scene in the present view, with the cameras' images and lines over it.
import type { Camera, Head, Water } from "./head";
import type { ActiveLamp } from "./drawing/light";
import { Models } from "./models";
import { drawOverlay, drawQuads, type OverlaySwitches } from "./overlay";
import type { Pack } from "./pack";
import { element, indexAt, make } from "./panels";
import type { Moment, Player } from "./player";
import { drawCompass } from "./display/compass";
import { isSoftware, Renderer } from "./drawing/renderer";
import { fitLens, type ViewCamera, type Views } from "./views";
import type { Lens } from "./geometry";

const PICTURE_HEIGHT = 150;
const MAX_DRAWING_TIME = 2000; // after which the drawing has failed without an error [ms]
const HURRY_TIME = 300; // without rests after an input [ms]
const MAX_REST = 100; // between two images that software draws [ms]

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

/** The pace of drawing by software, with rests for other processes and no queue of images. */
class Pace {
  private fence: WebGLSync | null = null;
  private beginTime = 0;
  private restEnd = 0; // wall time of its end [ms]
  private hurryEnd = 0; // wall time of its end [ms]

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** Note that an image has begun. */
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

  /** Return true if the last image is complete, and as much time again has passed. */
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
  private readonly images: ImageBitmap[] = []; // of cameras, from a running simulation
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
  draw(player: Player, moment: Moment, views: Views, switches: Switches): ViewCamera | null {
    const { canvas, head, models } = this;
    const ratio = this.gl && isSoftware(this.gl) ? 1 : Math.min(devicePixelRatio, 2);
    const [w, h] = [canvas.clientWidth, canvas.clientHeight];
    if (w === 0 || h === 0) return null;
    for (const layer of [canvas, this.overlay]) {
      const [width, height] = [Math.round(w * ratio), Math.round(h * ratio)];
      if (layer.width !== width || layer.height !== height) [layer.width, layer.height] = [width, height];
    }
    models.place(moment.poses);
    head.sand?.forEach((_, i) => models.setSand(i, player.sand(i, moment.time)));
    const viewCamera = views.viewCamera(w, h);
    const water = this.water(player, moment, switches);
    const clearWater = switches.clear ? { ...water, fog: 0 } : water;
    const lamps = this.lamps(moment);
    const { worldFromCamera, observer } = viewCamera;
    const lens = scaleLens(viewCamera.lens, ratio);
    const grey = viewCamera.camera?.grey;
    this.renderer?.draw({ worldFromCamera, lens, water: clearWater, lamps, observer, grey }, null, [0, 0]);
    const context = this.overlay.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, w, h);
    drawOverlay(context, worldFromCamera, viewCamera.lens, head, models, player, moment, switches, switches.trailStart);
    if (viewCamera.camera) drawQuads(context, viewCamera.camera, viewCamera.lens, 0, 0, moment);
    if (views.mode === "map") {
      const hud = element("hud");
      drawCompass(context, viewCamera.lens, views.height, hud.offsetTop + hud.offsetHeight);
    }
    this.frames.forEach((frame, i) => (frame.hidden = head.cameras[i] === viewCamera.camera));
    this.drawPictures(context, water, lamps, moment, switches, ratio, h);
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

  /** Return a camera's image in its own size, row 0 at the top, RGBA. */
  image(lens: Lens, worldFromCamera: Float64Array, player: Player, moment: Moment,
        switches: Switches, water: Partial<Water> = {}, observer = false, grey = false): Uint8Array {
    const { gl, models, renderer } = this;
    if (!gl || !renderer) return new Uint8Array();
    models.place(moment.poses);
    const buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    const stores = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    [gl.RGBA8, gl.DEPTH_COMPONENT24].forEach((format, i) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, stores[i]);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, lens.width, lens.height);
      const place = i ? gl.DEPTH_ATTACHMENT : gl.COLOR_ATTACHMENT0;
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, stores[i]);
    });
    const state = {
      worldFromCamera, lens, lamps: this.lamps(moment), observer,
      water: { ...this.water(player, moment, switches), ...water },
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
    context: CanvasRenderingContext2D, water: Water, lamps: ActiveLamp[], moment: Moment,
    switches: Switches, ratio: number, height: number,
  ): void {
    element("pictures").hidden = !switches.pictures;
    if (!switches.pictures) return;
    const origin = this.canvas.getBoundingClientRect();
    this.head.cameras.forEach((camera: Camera, i) => {
      if (this.frames[i].hidden) return;
      const place = this.frames[i].getBoundingClientRect();
      const [x, y] = [place.left - origin.left + 1, place.top - origin.top + 1];
      const lens = fitLens(camera, place.width - 2, place.height - 2);
      // a separate element would cause a new layout of the page for each image
      if (this.images[i]) context.drawImage(this.images[i], x, y, place.width - 2, place.height - 2);
      else {
        const worldFromCamera = this.models.worldFromMount(camera);
        const corner: [number, number] = [
          Math.round(x * ratio), Math.round((height - y - place.height + 2) * ratio),
        ];
        const { grey } = camera;
        const state = { worldFromCamera, lens: scaleLens(lens, ratio), water, lamps, observer: false, grey };
        this.renderer?.draw(state, null, corner);
      }
      drawQuads(context, camera, lens, x, y, moment);
    });
  }

  private water(player: Player, moment: Moment, switches: Switches): Water {
    const values = player.levels[indexAt(player, moment.time)]?.level.values ?? {};
    const { fog, light_rate } = this.head.water;
    return {
      ...this.head.water,
      fog: moment.signal("fog") ?? values.fog ?? fog,
      light_rate: moment.signal("light_rate") ?? values.light ?? light_rate,
      sun: switches.sun || this.head.water.sun,
    };
  }

  private lamps(moment: Moment): ActiveLamp[] {
    return this.head.lamps
      .map((lamp) => ({ lamp, brightness: moment.signal(`lamp/${lamp.name}`) ?? Number(lamp.on) }))
      .filter(({ brightness }) => brightness > 0)
      .map(({ lamp, brightness }) => ({
        lamp: { ...lamp, intensity: brightness * lamp.intensity },
        place: this.models.worldFromMount(lamp),
      }));
  }
}

/** Return the lens with the numbers of pixels scaled, and rounded. */
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
