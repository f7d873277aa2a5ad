// The uniform blocks with the transforms of the instances of a scene.
import { columns, product, type Matrix } from "../geometry";
import type { Models, Piece } from "../models";
import { BLOCKS } from "./shaders";

const STRIDE = 256; // distance between the blocks of two instances [byte]

/** The uniform blocks of all instances for one camera, and the drawing of pieces with them. */
export class InstanceBlocks {
  private readonly values: Float32Array<ArrayBuffer>;
  private readonly buffer: WebGLBuffer;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly models: Models,
  ) {
    this.values = new Float32Array((STRIDE / 4) * Math.max(1, models.instances.length));
    this.buffer = gl.createBuffer();
  }

  /** Set the transforms from each mesh to the camera's frame; with `rotation` (camera from world), those of normals, too. */
  fill(cameraFromWorld: Matrix, rotation?: Matrix): void {
    this.models.instances.forEach((instance, i) => {
      const offset = (STRIDE / 4) * i;
      this.values.set(columns(product(cameraFromWorld, instance.worldFromMesh)), offset);
      if (rotation) this.values.set(columns(product(rotation, instance.normals)), offset + 16);
    });
    this.gl.bindBuffer(this.gl.UNIFORM_BUFFER, this.buffer);
    this.gl.bufferData(this.gl.UNIFORM_BUFFER, this.values, this.gl.STREAM_DRAW);
  }

  /** Draw the triangles of a piece. */
  drawPiece({ instance, firstIndex, count }: Piece, isFlipped: boolean): void {
    const gl = this.gl;
    if (instance.visual.two_sided) gl.disable(gl.CULL_FACE);
    else gl.enable(gl.CULL_FACE);
    gl.frontFace(instance.isMirrored !== isFlipped ? gl.CW : gl.CCW);
    gl.bindBufferRange(gl.UNIFORM_BUFFER, BLOCKS.Instance, this.buffer, STRIDE * instance.index, 160);
    gl.bindVertexArray(instance.vertexArray);
    const [kind, size] = instance.hasUint32Indices ? [gl.UNSIGNED_INT, 4] : [gl.UNSIGNED_SHORT, 2];
    gl.drawElements(gl.TRIANGLES, count, kind, size * firstIndex);
  }
}
