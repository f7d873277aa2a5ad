// Readers of packs (a scene with its arrays) and of recorded motion; viewer/head.py documents their formats.
import type { Head, MotionHead, Ref } from "./head";
import type { Removal } from "./sand";
import { BIRTH, N_COLUMNS, NUMBER, type Birth } from "./water/sediment/puffs";

/** A pack: the head, which describes the scene, and the arrays to which it refers. */
export class Pack {
  constructor(
    readonly head: Head,
    /** The bytes of the arrays. */
    private readonly data: ArrayBuffer,
  ) {}

  /** Return the array to which a reference of the head refers. */
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

const BASE85_DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%/()*+-;,=.?@^_`{|}~";

/** Return the bytes that a base-85 text encodes; five digits encode four bytes. */
export function decodeBase85(text: string): Uint8Array<ArrayBuffer> {
  const values = new Uint8Array(128);
  for (let i = 0; i < BASE85_DIGITS.length; ++i) values[BASE85_DIGITS.charCodeAt(i)] = i;
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

/** Read a compressed pack. */
export async function unpack(data: Uint8Array<ArrayBuffer>): Promise<Pack> {
  const content = await gunzip(data);
  const length = new DataView(content).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(content, 4, length))) as Head;
  return new Pack(head, content.slice(4 + length));
}

/** The recorded motion of a trial: rows of poses and signals at a constant rate. */
export class Motion {
  constructor(
    readonly head: MotionHead,
    /** The rows, one after the other, n_rows x n_columns; the columns are described in viewer/head.py. */
    readonly rows: Float64Array,
    /** The removals of sand, in order. */
    readonly removals: Removal[] = [],
    /** The births of puffs of sediment, in order. */
    readonly births: Birth[] = [],
  ) {}

  /** The number of columns. */
  get columns(): number {
    return 7 * this.head.bodies.length + this.head.signals.length;
  }

  /** The simulation time of the last row [s]. */
  get end(): number {
    return this.head.start + Math.max(0, this.head.n - 1) / this.head.rate;
  }

  /** Return the index of the last row at or before a time [s]. */
  rowIndex(time: number): number {
    return Math.floor(this.rowPosition(time) + 1e-6);
  }

  /** Return the position of a time [s] among the rows; between two rows, it is not an integer. */
  private rowPosition(time: number): number {
    return Math.min(Math.max((time - this.head.start) * this.head.rate, 0), this.head.n - 1);
  }

  /** Return the row at a time [s]: poses are interpolated between two rows; signals are those of the row before. */
  row(time: number): Float64Array {
    const m = this.columns;
    const index = this.rowIndex(time);
    const out = this.rows.slice(index * m, (index + 1) * m);
    const fraction = this.rowPosition(time) - index;
    if (fraction < 1e-6 || index + 1 >= this.head.n) return out;
    const nextOffset = (index + 1) * m;
    for (let i = 0; i < 7 * this.head.bodies.length; ++i)
      out[i] += fraction * (this.rows[nextOffset + i] - out[i]);
    return out;
  }
}

/** Read a compressed motion file. */
export async function readMotion(data: Uint8Array<ArrayBuffer>): Promise<Motion> {
  const bytes = new Uint8Array(await gunzip(data));
  const line = bytes.indexOf(10);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(0, line))) as MotionHead;
  const n = head.n;
  const m = 7 * head.bodies.length + head.signals.length;
  const planes = bytes.subarray(line + 1);
  const rows = decodeTable(planes, n, m, (column) => {
    const pose = column % 7 < 3 ? head.length : head.quaternion;
    const isPose = column < 7 * head.bodies.length;
    return isPose ? pose : head.signals[column - 7 * head.bodies.length].step;
  });
  const removals = readRemovals(head, planes.subarray(4 * n * m));
  return new Motion(head, rows, removals, readBirths(head, planes.subarray(4 * (n * m + 5 * removals.length))));
}

/**
 * Decode a table of n rows and m columns; return it row by row, with NaN where there is no value.
 *
 * `planes` has four byte planes: the lowest bytes of all integers, then the higher ones, the highest last. The
 * integers are the differences from row to row, one column after the other; `step(column)` is the unit of a column.
 */
function decodeTable(planes: Uint8Array, n: number, m: number, step: (column: number) => number): Float64Array {
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

/** Decode the removals of sand, which follow the table of the motion. */
function readRemovals({ sand }: MotionHead, planes: Uint8Array): Removal[] {
  if (!sand) return [];
  const numbers = decodeTable(planes, sand.n, 5, (column) => (column < 2 ? 1 : sand.grain));
  return Array.from({ length: sand.n }, (_, i) => {
    const [rowIndex, heap, x, y, z] = numbers.subarray(5 * i, 5 * i + 5);
    return { row: rowIndex, heap, position: Number.isNaN(x) ? null : [x, y, z] };
  });
}

/** Decode the births of puffs of sediment, which follow the removals of sand. */
function readBirths({ sediment }: MotionHead, planes: Uint8Array): Birth[] {
  if (!sediment) return [];
  const { n, steps } = sediment;
  const numbers = decodeTable(planes, n, steps.length, (column) => steps[column]);
  return Array.from({ length: n }, (_, i) => {
    const [time, number, x, y, z, width, mass, vx, vy, vz, floor] = numbers.subarray(steps.length * i);
    if (Number.isNaN(mass)) return { time, puff: null };
    const puff = new Array<number>(N_COLUMNS);
    [x, y, z, width * width, mass, vx, vy, vz, floor].forEach((value, column) => (puff[column] = value));
    [puff[BIRTH], puff[NUMBER]] = [time, number];
    return { time, puff };
  });
}
