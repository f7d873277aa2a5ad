// The north arrow and the scale bar of the map view.
import type { Intrinsics } from "../geometry";

const MAX_SCALE_LENGTH = 130; // [px]
const LEFT = 18; // left edge of arrow and bar [px]

/**
 * Draw arrow and bar at the upper left of a view from above.
 *
 * The bar has the scale of the plane `depth` metres below the camera; `top` is the first free row [px].
 */
export function drawCompass(context: CanvasRenderingContext2D, intrinsics: Intrinsics, depth: number, top: number): void {
  const [x, y] = [LEFT + 10, top + 22];
  const metres = roundDown((MAX_SCALE_LENGTH * depth) / intrinsics.fx);
  const length = (metres * intrinsics.fx) / depth;
  context.save();
  context.setLineDash([]);
  context.shadowColor = "rgba(0, 12, 24, 0.9)";
  context.shadowBlur = 3;
  context.fillStyle = context.strokeStyle = "#ffffff";
  context.textAlign = "center";
  context.font = "600 13px system-ui, sans-serif";
  context.fillText("N", x, y);
  context.beginPath();
  context.moveTo(x, y + 6);
  context.lineTo(x + 8, y + 28);
  context.lineTo(x, y + 23);
  context.lineTo(x - 8, y + 28);
  context.closePath();
  context.fill();
  const [left, base] = [LEFT, y + 58];
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(left, base - 6);
  context.lineTo(left, base);
  context.lineTo(left + length, base);
  context.lineTo(left + length, base - 6);
  context.stroke();
  context.fillText(metres < 1 ? `${Math.round(100 * metres)} cm` : `${metres} m`, left + length / 2, base - 8);
  context.restore();
}

/** Return the greatest number of the form 1, 2 or 5 times a power of ten that is at most `value`. */
function roundDown(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const digit = [5, 2, 1].find((candidate) => candidate * power <= value * (1 + 1e-9)) ?? 1;
  return Number((digit * power).toPrecision(1));
}
