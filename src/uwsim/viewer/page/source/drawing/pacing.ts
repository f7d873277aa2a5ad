// The pacing of images that a software renderer draws.

const MAX_DRAWING_TIME = 2000; // time after which an image that is not complete is given up [ms]
const RESPONSIVE_TIME = 300; // time after a pilot's input in which images are drawn without pauses [ms]
const MAX_PAUSE = 100; // longest pause between two images of a software renderer [ms]

/** Return true if WebGL is drawn by software on the CPU. */
export function isSoftware(gl: WebGL2RenderingContext): boolean {
  const name = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = name ? String(gl.getParameter(name.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|softpipe/i.test(renderer);
}

/** The pacing of a software renderer: an image begins after the last one is complete and other processes had a pause. */
export class SoftwarePacing {
  private fence: WebGLSync | null = null;
  private beginTime = 0; // wall time of the beginning of the last image [ms]
  private pauseEnd = 0; // wall time of the end of the pause [ms]
  private responsiveEnd = 0; // wall time until which there are no pauses [ms]

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** Record that the commands of an image have been issued. */
  begin(): void {
    if (this.fence) this.gl.deleteSync(this.fence);
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    this.beginTime = performance.now();
  }

  /** Draw without pauses for `RESPONSIVE_TIME`, after an input. */
  skipPauses(): void {
    this.responsiveEnd = performance.now() + RESPONSIVE_TIME;
  }

  /** Return true if the last image is complete, and a pause as long as its drawing time, `MAX_PAUSE` at most, has passed. */
  isReady(now: number): boolean {
    const { gl, fence } = this;
    const isLost = gl.isContextLost() || now - this.beginTime > MAX_DRAWING_TIME;
    if (fence && (isLost || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED)) {
      gl.deleteSync(fence);
      this.fence = null;
      this.pauseEnd = Math.min(2 * now - this.beginTime, now + MAX_PAUSE);
    }
    return !this.fence && (now >= this.pauseEnd || now < this.responsiveEnd);
  }
}
