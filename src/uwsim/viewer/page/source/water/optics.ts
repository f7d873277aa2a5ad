// The uniform block Optics, as in uwsim.rendering.physical.optics_block.
import type { Optics } from "./medium";
import type { Intrinsics } from "../geometry";
import type { ActiveLamp } from "../drawing/light";

/** Return the values of the uniform block Optics (optics.glsl); rows of the image are from the top. */
export function opticsBlockValues(
  optics: Optics, intrinsics: Intrinsics, lamps: ActiveLamp[], lightRate: number, reach: number[],
): Float32Array<ArrayBuffer> {
  const { fx, fy, cx, cy, skew } = intrinsics;
  const [column, row] = [1 / fx, -1 / fy];
  const rowSkew = (skew * row) / fx; // x of a point at the height y: u = fx x + skew y + cx
  const firstY = row * (-0.5 - cy);
  const firstX = column * (-0.5 - cx) - (skew * firstY) / fx;
  const scaleLight = (values: number[]) => values.map((value) => lightRate * value);
  const block = new Float32Array(4 * 19);
  block.set([
    ...optics.absorption, optics.field[0],
    ...optics.scattering, optics.field[1],
    ...Array.from({ length: 8 }, (_, level) => reach[level] ?? 0),
    0, optics.exposure, optics.scale, 0,
    ...scaleLight(optics.beam), 0,
    ...optics.beam_loss, 0,
    ...scaleLight(optics.total), 0,
    ...optics.loss, 0,
    ...optics.reflectance, optics.sun[2],
    ...optics.phase,
    firstX, firstY, -1, 0,
    column, 0, 0, 0,
    -rowSkew, row, 0, 0,
  ]);
  lamps.forEach(({ lamp, index }, i) => {
    const cosine = Math.cos(lamp.half_angle);
    block.set([...optics.lamps[index], cosine * cosine, Number(lamp.half_angle < Math.PI / 2)], 4 * (15 + i));
  });
  return block;
}
