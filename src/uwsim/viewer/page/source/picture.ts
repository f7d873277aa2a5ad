// The image: the scene from where one looks, the cameras' images in it, lines over it.
import type { Camera, Head, Water } from "./head";
import type { ShiningLamp } from "./drawing/light";
import { Models } from "./models";
import { drawOverlay, drawQuads, type Shown } from "./overlay";
import type { Pack } from "./pack";
import { element, indexAt, make } from "./panels";
import type { Moment, Player } from "./player";
import { drawCompass } from "./display/compass";
import { isSoftware, Renderer } from "./drawing/renderer";
import { inside, type Sight, type Views } from "./views";
import type { Lens } from "./geometry";

const PICTURE_HEIGHT = 150;
const LONGEST_DRAWING = 2000; // of an image; who takes longer has ended without a word [ms]
const HURRY = 300; // after an input [ms]
const LONGEST_REST = 100; // between two images that software draws [ms]

export interface Switches extends Shown {
  clear: boolean;
  pictures: boolean;
  /** The head-up display. */
  state: boolean;
  sun: string;
  /** Trails begin at this point. */
  since: number;
}

/** A WebGL2 context of the canvas, antialiased where a GPU does it; null without WebGL. */
export function graphics(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) return null;
  const antialias = !isSoftware(probe);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return canvas.getContext("webgl2", { alpha: false, antialias, powerPreference: "high-performance" });
}

/** Keeps software from drawing all the time, on the cores that others need, and images from piling up. */
class Pace {
  private fence: WebGLSync | null = null;
  private began = 0;
  private rests = 0; // until then
  private hurries = 0; // until then without a rest

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** An image has been begun. */
  begin(): void {
    if (this.fence) this.gl.deleteSync(this.fence);
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    this.began = performance.now();
  }

  /** Somebody has acted, and waits for what comes of it. */
  hurry(): void {
    this.hurries = performance.now() + HURRY;
  }

  /** Whether the last image is there, and as much time again has passed. */
  isReady(now: number): boolean {
    const { gl, fence } = this;
    const isLost = gl.isContextLost() || now - this.began > LONGEST_DRAWING;
    if (fence && (isLost || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED)) {
      gl.deleteSync(fence);
      this.fence = null;
      this.rests = Math.min(2 * now - this.began, now + LONGEST_REST);
    }
    return !this.fence && (now >= this.rests || now < this.hurries);
  }
}

export class Picture {
  readonly canvas = element<HTMLCanvasElement>("image");
  private readonly overlay = element<HTMLCanvasElement>("overlay");
  private readonly renderer: Renderer | null;
  private readonly frames: HTMLElement[] = [];
  private readonly sent: ImageBitmap[] = []; // of cameras, by a running simulation
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

  /** Without WebGL lines and names alone are drawn, over what a live view sends. */
  static async make(gl: WebGL2RenderingContext | null, pack: Pack): Promise<Picture> {
    return new Picture(gl, pack.head, await Models.load(gl, pack));
  }

  /** Draw it all; returns from where, null while nothing is to be seen. */
  draw(player: Player, moment: Moment, views: Views, switches: Switches): Sight | null {
    const { canvas, head, models } = this;
    const ratio = this.gl && isSoftware(this.gl) ? 1 : Math.min(devicePixelRatio, 2);
    const [w, h] = [canvas.clientWidth, canvas.clientHeight];
    if (w === 0 || h === 0) return null;
    for (const each of [canvas, this.overlay]) {
      const [wide, high] = [Math.round(w * ratio), Math.round(h * ratio)];
      if (each.width !== wide || each.height !== high) [each.width, each.height] = [wide, high];
    }
    models.place(moment.poses);
    head.sand?.forEach((_, i) => models.dig(i, player.sand(i, moment.time)));
    const sight = views.sight(w, h);
    const water = this.water(player, moment, switches);
    const clear = switches.clear ? { ...water, fog: 0 } : water;
    const lamps = this.lamps(moment);
    const { worldFromCamera, observer } = sight;
    const lens = scaled(sight.lens, ratio);
    const grey = sight.camera?.grey;
    this.renderer?.draw({ worldFromCamera, lens, water: clear, lamps, observer, grey }, null, [0, 0]);
    const context = this.overlay.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, w, h);
    drawOverlay(context, worldFromCamera, sight.lens, head, models, player, moment, switches, switches.since);
    if (sight.camera) drawQuads(context, sight.camera, sight.lens, 0, 0, moment);
    if (views.mode === "map") {
      const hud = element("hud");
      drawCompass(context, sight.lens, views.height, hud.offsetTop + hud.offsetHeight);
    }
    this.frames.forEach((frame, i) => (frame.hidden = head.cameras[i] === sight.camera));
    this.drawPictures(context, water, lamps, moment, switches, ratio, h);
    this.pace?.begin();
    return sight;
  }

  /** Draw the next images without a rest. */
  hurry(): void {
    this.pace?.hurry();
  }

  /** Whether the next image of a motion may be begun. */
  isReady(): boolean {
    return this.pace?.isReady(performance.now()) ?? true;
  }

  /** A camera's image in its own size, row 0 at the top, RGBA. */
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
    const look = {
      worldFromCamera, lens, lamps: this.lamps(moment), observer,
      water: { ...this.water(player, moment, switches), ...water },
      grey,
    };
    renderer.draw(look, buffer, [0, 0], true);
    const pixels = new Uint8Array(4 * lens.width * lens.height);
    gl.readPixels(0, 0, lens.width, lens.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    for (const store of stores) gl.deleteRenderbuffer(store);
    gl.deleteFramebuffer(buffer);
    return pixels;
  }

  /** The width in which images of cameras are shown, the widest of them [px]. */
  widest(): number {
    const shapes = this.head.cameras.map(({ width, height }) => width / height);
    return Math.round(PICTURE_HEIGHT * Math.max(...shapes) * Math.min(devicePixelRatio, 2));
  }

  /** Show an image of a camera that a simulation has sent, from the next drawing on. */
  show(camera: number, image: ImageBitmap): void {
    if (!this.frames[camera]) return;
    if (this.sent[camera]) this.sent[camera].close();
    else this.frames[camera].querySelector("figcaption")!.textContent = this.head.cameras[camera].name;
    this.sent[camera] = image;
  }

  private drawPictures(
    context: CanvasRenderingContext2D, water: Water, lamps: ShiningLamp[], moment: Moment,
    switches: Switches, ratio: number, height: number,
  ): void {
    element("pictures").hidden = !switches.pictures;
    if (!switches.pictures) return;
    const origin = this.canvas.getBoundingClientRect();
    this.head.cameras.forEach((camera: Camera, i) => {
      if (this.frames[i].hidden) return;
      const place = this.frames[i].getBoundingClientRect();
      const [x, y] = [place.left - origin.left + 1, place.top - origin.top + 1];
      const lens = inside(camera, place.width - 2, place.height - 2);
      // an element of its own would have the whole page put together again for each image
      if (this.sent[i]) context.drawImage(this.sent[i], x, y, place.width - 2, place.height - 2);
      else {
        const worldFromCamera = this.models.mounted(camera);
        const corner: [number, number] = [
          Math.round(x * ratio), Math.round((height - y - place.height + 2) * ratio),
        ];
        const { grey } = camera;
        const look = { worldFromCamera, lens: scaled(lens, ratio), water, lamps, observer: false, grey };
        this.renderer?.draw(look, null, corner);
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

  private lamps(moment: Moment): ShiningLamp[] {
    return this.head.lamps
      .map((lamp) => ({ lamp, brightness: moment.signal(`lamp/${lamp.name}`) ?? Number(lamp.on) }))
      .filter(({ brightness }) => brightness > 0)
      .map(({ lamp, brightness }) => ({
        lamp: { ...lamp, intensity: brightness * lamp.intensity },
        place: this.models.mounted(lamp),
      }));
  }
}

/** The pinhole on as many times the pixels, whole ones. */
function scaled(lens: Lens, ratio: number): Lens {
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
