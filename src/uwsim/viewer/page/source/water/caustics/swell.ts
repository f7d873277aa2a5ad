// The drift of sunlight by long waves on a grid, as in uwsim.rendering.caustics.swell.
import type { CausticsSpec, FocusingSurface } from "./spec";

/** Return the drift along x and y, and trace and determinant of its derivative, from the first grid point in W [m] on. */
export function computeSwell(
  { swell: { n_points: n, spacing }, matrix: [m00, m01, m10, m11], wave_lengths }: CausticsSpec,
  { waves, time, scale }: FocusingSurface, corner: number[],
): Float32Array<ArrayBuffer> {
  const swell = new Float32Array(4 * n * n);
  const { amplitude, omega, kx, ky, phase } = waves!;
  const sums = new Float64Array(5 * n * n); // slopes along x and y, derivatives xx, xy, yy
  for (let wave = 0; wave < amplitude.length; ++wave) {
    const [numberX, numberY] = [kx[wave], ky[wave]];
    if ((2 * Math.PI) / Math.hypot(numberX, numberY) < wave_lengths[1]) continue;
    const a = scale * amplitude[wave];
    const angle = phase[wave] + numberX * corner[0] + numberY * corner[1] - omega[wave] * time;
    for (let row = 0, i = 0; row < n; ++row)
      for (let column = 0; column < n; ++column, i += 5) {
        const turn = angle + spacing * (numberX * column + numberY * row);
        const [cosine, sine] = [-a * Math.cos(turn), -a * Math.sin(turn)];
        sums[i] += numberX * sine;
        sums[i + 1] += numberY * sine;
        sums[i + 2] += numberX * numberX * cosine;
        sums[i + 3] += numberX * numberY * cosine;
        sums[i + 4] += numberY * numberY * cosine;
      }
  }
  for (let i = 0, place = 0; i < sums.length; i += 5, place += 4) {
    const [x, y, xx, xy, yy] = sums.subarray(i, i + 5);
    swell[place] = m00 * x + m01 * y;
    swell[place + 1] = m10 * x + m11 * y;
    swell[place + 2] = m00 * xx + (m01 + m10) * xy + m11 * yy;
    swell[place + 3] = (m00 * m11 - m01 * m10) * (xx * yy - xy * xy);
  }
  return swell;
}
