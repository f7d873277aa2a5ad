// The pass that draws clouds of sediment into three coarse textures, as in uwsim.rendering.physical.cloud_pass.
import { ATTRIBUTES, BLOCKS, type Programs, type Switches } from "../../drawing/shaders";
import { LUMP_LENGTH, type VisibleClouds } from "./clouds";

/** The edge of a texel of the clouds [px], as in shaders/cloud_edge.glsl. */
export const EDGE = 8;
const N_LAYERS = 4;
const LAYER_MARGIN = 2.5; // distance from centres at which the layers begin and end, in widths

/** The pass that draws clouds. */
export class CloudPass {
  private readonly lumps: WebGLBuffer;
  private readonly block: WebGLBuffer;
  private readonly vertexArray: WebGLVertexArrayObject;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly programs: Programs,
  ) {
    this.lumps = gl.createBuffer();
    this.block = gl.createBuffer();
    this.vertexArray = gl.createVertexArray();
    gl.bindVertexArray(this.vertexArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lumps);
    for (const [name, size, offset] of [["place", 4, 0], ["depth", 1, 16]] as const) {
      gl.enableVertexAttribArray(ATTRIBUTES[name]);
      gl.vertexAttribPointer(ATTRIBUTES[name], size, gl.FLOAT, false, 4 * LUMP_LENGTH, offset);
      gl.vertexAttribDivisor(ATTRIBUTES[name], 1);
    }
    gl.bindVertexArray(null);
  }

  /** Draw clouds into the current framebuffer; the textures of surfaces and open water must be bound. */
  draw({ lumps, colour }: VisibleClouds, nLamps: number, switches: Switches): void {
    const { gl } = this;
    let [first, end] = [Infinity, 0];
    for (let i = 0; i < lumps.length; i += LUMP_LENGTH) {
      const range = Math.hypot(lumps[i], lumps[i + 1], lumps[i + 2]);
      first = Math.min(first, range - LAYER_MARGIN * lumps[i + 3]);
      end = Math.max(end, range + LAYER_MARGIN * lumps[i + 3]);
    }
    first = Math.max(first, 0);
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.block);
    const values = Float32Array.of(first, (end - first) / (N_LAYERS - 1), 0, 0, ...colour, 0);
    gl.bufferData(gl.UNIFORM_BUFFER, values, gl.STREAM_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, BLOCKS.Clouds, this.block);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.useProgram(this.programs.get("cloud", nLamps ? { LAMPS: nLamps, ...switches } : switches));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gl.bindVertexArray(this.vertexArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lumps);
    gl.bufferData(gl.ARRAY_BUFFER, lumps, gl.STREAM_DRAW);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, lumps.length / LUMP_LENGTH);
    gl.bindVertexArray(null);
    gl.disable(gl.BLEND);
  }
}
