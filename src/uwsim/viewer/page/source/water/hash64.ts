// The hashes of particles, as in uwsim.particles.draws: numbers of 64 bits as two halves of 32 bits.

/** A number of 64 bits: its upper and its lower half. */
export type Word = [number, number];

const INCREMENT: Word = [0x9e3779b9, 0x7f4a7c15];
const [FACTOR_1, FACTOR_2]: Word[] = [[0xbf58476d, 0x1ce4e5b9], [0x94d049bb, 0x133111eb]];
const AXES: Word[] = [[0xd6e8feb8, 0x6659fd93], [0xa0761d64, 0x78bd642f], [0xe7037ed1, 0xa0b428db]];

/** Return the number of a hexadecimal text with sixteen digits after `0x`. */
export function parseWord(text: string): Word {
  return [parseInt(text.slice(2, 10), 16), parseInt(text.slice(10), 16)];
}

/** Return the hash of a number. */
export function mix(word: Word): Word {
  const first = multiply([word[0] ^ (word[0] >>> 30), word[1] ^ ((word[1] >>> 30) | (word[0] << 2))], FACTOR_1);
  const second = multiply([first[0] ^ (first[0] >>> 27), first[1] ^ ((first[1] >>> 27) | (first[0] << 5))], FACTOR_2);
  return [(second[0] ^ (second[0] >>> 31)) >>> 0, (second[1] ^ ((second[1] >>> 31) | (second[0] << 1))) >>> 0];
}

/** Return the hash of a cell with three whole indices; without the last two, that of an element of a sequence. */
export function hashCell(key: Word, ...indices: number[]): Word {
  return indices.reduce((word, index, axis) => mix(add(word, multiply(wordOf(index), AXES[axis]))), key);
}

/** Return a number of a hash's sequence, 0 to 1. */
export function uniform(word: Word, number: number): number {
  const [high, low] = mix(add(word, multiply([0, number + 1], INCREMENT)));
  return (high * 2 ** 21 + (low >>> 11)) * 2 ** -53;
}

function wordOf(index: number): Word {
  return [Math.floor(index / 2 ** 32) >>> 0, index >>> 0];
}

function add(a: Word, b: Word): Word {
  const low = (a[1] >>> 0) + (b[1] >>> 0);
  return [(a[0] + b[0] + Number(low >= 2 ** 32)) >>> 0, low >>> 0];
}

/** Return the lower 64 bits of a product. */
function multiply(a: Word, b: Word): Word {
  const [a0, a1, b0, b1] = [a[1] & 0xffff, a[1] >>> 16, b[1] & 0xffff, b[1] >>> 16];
  const middle = a1 * b0 + ((a0 * b0) >>> 16);
  const cross = a0 * b1 + (middle & 0xffff);
  const upper = a1 * b1 + Math.floor(middle / 65536) + Math.floor(cross / 65536);
  return [(upper + Math.imul(a[0], b[1]) + Math.imul(a[1], b[0])) >>> 0, Math.imul(a[1], b[1]) >>> 0];
}
