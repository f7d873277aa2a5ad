// The view of bodies that the still surface mirrors, as in uwsim.rendering.surface.mirror_view.
import { matrix, type Intrinsics, type Matrix } from "../../geometry";

// edges of a pixel of the mirror in pixels of the image, of a surface without and with waves
const [MIRROR_RATIO, WAVY_MIRROR_RATIO] = [2, 4];

/** Return the pose and the pinhole of the camera of the mirror, which sees up to a range [m]. */
export function findMirrorView(
  m: Matrix, lens: Intrinsics, surfaceHeight: number, maxRange: number, hasWaves: boolean,
): { pose: Matrix; intrinsics: Intrinsics } {
  const pose = matrix([
    m[0], -m[1], m[2], m[3], m[4], -m[5], m[6], m[7], -m[8], m[9], -m[10], 2 * surfaceHeight - m[11], 0, 0, 0, 1,
  ]);
  const ratio = hasWaves ? WAVY_MIRROR_RATIO : MIRROR_RATIO;
  const [width, height] = [Math.ceil(lens.width / ratio), Math.ceil(lens.height / ratio)];
  // the first pixel's corner stays; the last pixel may reach beyond the image
  const [scaleX, scaleY] = [width / lens.width, height / lens.height];
  const cy = (lens.cy + 0.5) * scaleY - 0.5;
  const intrinsics = {
    ...lens, width, height, fx: lens.fx * scaleX, fy: lens.fy * scaleY, cx: (lens.cx + 0.5) * scaleX - 0.5,
    cy: height - 1 - cy, skew: -lens.skew * scaleX, far: Math.max(Math.min(lens.far, maxRange), 2 * lens.near),
  };
  return { pose, intrinsics };
}
