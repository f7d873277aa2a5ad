// The pass that draws particles into a texture, as in uwsim.rendering.physical.particle_pass.
import { BLOCKS, type Programs, type Switches } from "../drawing/shaders";
import { RECORD_LENGTH, type ParticlesSpec } from "./particles";

const MIN_RADIUS = 1.5; // least radius of the image of a particle [px]
const FIRST_ATTRIBUTE = 8; // location of the first attribute of a record
const SIZES = [4, 4, 2]; // numbers of the attributes of a record

/** The particles in a view. */
export interface VisibleParticles {
  spec: ParticlesSpec;
  /** The records, `RECORD_LENGTH` numbers each. */
  records: Float32Array<ArrayBuffer>;
}

/** The pass that draws particles. */
export class ParticlePass {
  private readonly records: WebGLBuffer;
  private readonly lens: WebGLBuffer;
  private readonly vertexArray: WebGLVertexArrayObject;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly programs: Programs,
  ) {
    this.records = gl.createBuffer();
    this.lens = gl.createBuffer();
    this.vertexArray = gl.createVertexArray();
    gl.bindVertexArray(this.vertexArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.records);
    let offset = 0;
    SIZES.forEach((size, i) => {
      gl.enableVertexAttribArray(FIRST_ATTRIBUTE + i);
      gl.vertexAttribPointer(FIRST_ATTRIBUTE + i, size, gl.FLOAT, false, 4 * RECORD_LENGTH, offset);
      gl.vertexAttribDivisor(FIRST_ATTRIBUTE + i, 1);
      offset += 4 * size;
    });
    gl.bindVertexArray(null);
  }

  /** Draw particles into the current framebuffer; the textures of surfaces and open water must be bound. */
  draw({ spec, records }: VisibleParticles, nLamps: number, switches: Switches): void {
    const { gl } = this;
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!records.length) return;
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.lens);
    const values = Float32Array.of(spec.aperture / 2, 1 / spec.focus_distance, MIN_RADIUS, 0);
    gl.bufferData(gl.UNIFORM_BUFFER, values, gl.STREAM_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, BLOCKS.ParticleLens, this.lens);
    gl.useProgram(this.programs.get("particle", nLamps ? { LAMPS: nLamps, ...switches } : switches));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.bindVertexArray(this.vertexArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.records);
    gl.bufferData(gl.ARRAY_BUFFER, sortByRange(records), gl.STREAM_DRAW);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, records.length / RECORD_LENGTH);
    gl.bindVertexArray(null);
    gl.disable(gl.BLEND);
  }
}

/** Return particles from the farthest to the nearest; equal ranges keep their order. */
function sortByRange(records: Float32Array<ArrayBuffer>): Float32Array<ArrayBuffer> {
  const squares = new Float64Array(records.length / RECORD_LENGTH);
  for (let i = 0, first = 0; i < squares.length; ++i, first += RECORD_LENGTH)
    squares[i] = records[first] ** 2 + records[first + 1] ** 2 + records[first + 2] ** 2;
  const order = Array.from(squares.keys()).sort((i, j) => squares[j] - squares[i]);
  const result = new Float32Array(records.length);
  order.forEach((i, place) =>
    result.set(records.subarray(RECORD_LENGTH * i, RECORD_LENGTH * (i + 1)), RECORD_LENGTH * place),
  );
  return result;
}
