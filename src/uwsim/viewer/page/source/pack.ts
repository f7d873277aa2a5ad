// Readers of packs and of motion, whose formats viewer/head.py describes.
import type { Head, MotionHead, Ref } from "./head";
import type { Removal } from "./sand";

export class Pack {
  constructor(
    readonly head: Head,
    private readonly data: ArrayBuffer,
  ) {}

  numbers(ref: Ref): Float32Array | Uint32Array | Uint16Array | Int16Array | Int8Array | Uint8Array {
    const [offset, count, kind] = ref;
    switch (kind) {
      case "f4":
        return new Float32Array(this.data, offset, count);
      case "u4":
        return new Uint32Array(this.data, offset, count);
      case "u2":
        return new Uint16Array(this.data, offset, count);
      case "i2":
        return new Int16Array(this.data, offset, count);
      case "i1":
        return new Int8Array(this.data, offset, count);
      default:
        return new Uint8Array(this.data, offset, count);
    }
  }
}

export async function gunzip(data: Uint8Array<ArrayBuffer>): Promise<ArrayBuffer> {
  const stream = new Blob([data]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

const DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%/()*+-;,=.?@^_`{|}~";

/** Return the bytes that a text of base 85 encodes, four bytes by five digits. */
export function fromText(text: string): Uint8Array<ArrayBuffer> {
  const values = new Uint8Array(128);
  for (let i = 0; i < DIGITS.length; ++i) values[DIGITS.charCodeAt(i)] = i;
  const n = Math.ceil(text.length / 5);
  const view = new DataView(new ArrayBuffer(4 * n));
  for (let word = 0; word < n; ++word) {
    let number = 0;
    for (let i = 5 * word; i < 5 * word + 5; ++i)
      number = 85 * number + (i < text.length ? values[text.charCodeAt(i)] : 84);
    view.setUint32(4 * word, number);
  }
  return new Uint8Array(view.buffer, 0, text.length - n);
}

export async function unpack(data: Uint8Array<ArrayBuffer>): Promise<Pack> {
  const content = await gunzip(data);
  const length = new DataView(content).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(content, 4, length))) as Head;
  return new Pack(head, content.slice(4 + length));
}

/** Rows of poses and signals at a constant rate. */
export class Motion {
  constructor(
    readonly head: MotionHead,
    /** The rows, one after the other, n_rows x n_columns. */
    readonly rows: Float64Array,
    /** The removals of sand, in order. */
    readonly removals: Removal[] = [],
  ) {}

  get columns(): number {
    return 7 * this.head.bodies.length + this.head.signals.length;
  }

  get end(): number {
    return this.head.start + Math.max(0, this.head.n - 1) / this.head.rate;
  }

  /** Return the index of the row at or before a time [s]. */
  frame(time: number): number {
    return Math.floor(this.rowNumber(time) + 1e-6);
  }

  /** Return the number of the row at a time [s], a fraction between two rows. */
  private rowNumber(time: number): number {
    return Math.min(Math.max((time - this.head.start) * this.head.rate, 0), this.head.n - 1);
  }

  /** Return the row at a time [s], with poses interpolated between two rows. */
  row(time: number): Float64Array {
    const m = this.columns;
    const index = this.frame(time);
    const out = this.rows.slice(index * m, (index + 1) * m);
    const share = this.rowNumber(time) - index;
    if (share < 1e-6 || index + 1 >= this.head.n) return out;
    const nextOffset = (index + 1) * m;
    for (let i = 0; i < 7 * this.head.bodies.length; ++i)
      out[i] += share * (this.rows[nextOffset + i] - out[i]);
    return out;
  }
}

export async function readMotion(data: Uint8Array<ArrayBuffer>): Promise<Motion> {
  const bytes = new Uint8Array(await gunzip(data));
  const line = bytes.indexOf(10);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(0, line))) as MotionHead;
  const n = head.n;
  const m = 7 * head.bodies.length + head.signals.length;
  const planes = bytes.subarray(line + 1);
  const rows = table(planes, n, m, (column) => {
    const pose = column % 7 < 3 ? head.length : head.quaternion;
    const isPose = column < 7 * head.bodies.length;
    return isPose ? pose : head.signals[column - 7 * head.bodies.length].step;
  });
  return new Motion(head, rows, readRemovals(head, planes.subarray(4 * n * m)));
}

/** Decode a table of n rows and m columns in multiples of `step`; row by row, NaN: no value. */
function table(planes: Uint8Array, n: number, m: number, step: (column: number) => number): Float64Array {
  const rows = new Float64Array(n * m);
  for (let column = 0; column < m; ++column) {
    const unit = step(column);
    let sum = 0;
    for (let row = 0, k = column * n; row < n; ++row, ++k) {
      const low = planes[k] | (planes[n * m + k] << 8) | (planes[2 * n * m + k] << 16);
      sum = (sum + (low | (planes[3 * n * m + k] << 24))) | 0;
      rows[row * m + column] = sum === -0x80000000 ? NaN : sum * unit;
    }
  }
  return rows;
}

function readRemovals({ sand }: MotionHead, planes: Uint8Array): Removal[] {
  if (!sand) return [];
  const numbers = table(planes, sand.n, 5, (column) => (column < 2 ? 1 : sand.grain));
  return Array.from({ length: sand.n }, (_, row) => {
    const [frame, heap, x, y, z] = numbers.subarray(5 * row, 5 * row + 5);
    return { frame, heap, position: Number.isNaN(x) ? null : [x, y, z] };
  });
}
