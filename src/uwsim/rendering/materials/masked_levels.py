r"""The smaller images of a texture with holes, which keep the share that is not a hole.

The mean of four texels of a net with thin threads has an alpha below the threshold: far nets would
vanish. The alpha of each level is multiplied by

.. math:: s = t / q

with the threshold :math:`t` of holes and the quantile :math:`q` of the interpolated alpha that as
large a share exceeds as is not a hole in the first level (I. Castano, "Computing alpha mipmaps",
2010). Levels end where no factor keeps that share, because threads are as far apart as texels. Not
modelled: partial coverage of a pixel; nets that are farther away have noise, and keep their share
on average.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

MAX_SHARE_ERROR = 0.2
"""The greatest error of the share that is not a hole, relative to that of the first level [1]."""
SAMPLES = (np.arange(2**16)[:, None] + 0.5) * [0.7548776662466927, 0.5698402909980532] % 1.0
"""The points of a texture at which shares are measured, evenly spread, (n, 2) [textures].

They are the additive sequence of the plastic number, the root of x^3 = x + 1.
"""
ALPHA = 3
"""The channel of alpha."""

Pixels = npt.NDArray[np.uint8]


def compute_masked_levels(pixels: Pixels, cutoff: int) -> list[Pixels]:
    """Compute the levels after the first of a texture with holes, each half as large.

    Args:
        pixels: the first level, (h, w, 4).
        cutoff: the alpha below which there is a hole, 1..255.
    """
    share = find_solid_share(pixels[..., ALPHA], cutoff)
    levels: list[Pixels] = []
    mean_texels = pixels.astype(np.float64)
    while 0.0 < share < 1.0 and max(mean_texels.shape[:2]) > 1:
        mean_texels = _halve(mean_texels)
        level = mean_texels.copy()
        samples = np.sort(_interpolate(mean_texels[..., ALPHA]), axis=None)[::-1]
        quantile = samples[max(0, round(share * samples.size) - 1)]
        level[..., ALPHA] *= cutoff / max(float(quantile), 1.0)
        level_pixels = np.rint(np.clip(level, 0.0, 255.0)).astype(np.uint8)
        if (
            abs(find_solid_share(level_pixels[..., ALPHA], cutoff) - share)
            > MAX_SHARE_ERROR * share
        ):
            break
        levels.append(level_pixels)
    return levels


def find_solid_share(alpha: npt.NDArray[np.generic], cutoff: int) -> float:
    """Return the share of a surface that is not a hole, 0..1, with interpolated alpha (h, w)."""
    return float((_interpolate(alpha) >= cutoff).mean())


def _interpolate(alpha: npt.NDArray[np.generic]) -> npt.NDArray[np.float64]:
    """Return the alpha at `SAMPLES`, between texels."""
    height, width = alpha.shape
    row, column = SAMPLES[:, 0] * height, SAMPLES[:, 1] * width
    top, left = row.astype(np.int64), column.astype(np.int64)
    bottom, right = (top + 1) % height, (left + 1) % width
    values = alpha.astype(np.float64)
    upper = values[top, left] + (values[top, right] - values[top, left]) * (column - left)
    lower = values[bottom, left] + (values[bottom, right] - values[bottom, left]) * (column - left)
    samples: npt.NDArray[np.float64] = upper + (lower - upper) * (row - top)
    return samples


def _halve(image: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return the means of 2 x 2 texels, (h // 2, w // 2, 4); colours are weighted by alpha."""
    height, width = (max(1, side // 2) for side in image.shape[:2])
    rows = image[: 2 * height] if image.shape[0] > 1 else np.repeat(image, 2, axis=0)
    texels = rows[:, : 2 * width] if image.shape[1] > 1 else np.repeat(rows, 2, axis=1)
    blocks = texels.reshape(height, 2, width, 2, ALPHA + 1)
    weights = blocks[..., ALPHA:] + 1e-3  # texels of a hole count where all four are holes
    colours = (blocks[..., :ALPHA] * weights).sum(axis=(1, 3)) / weights.sum(axis=(1, 3))
    return np.concatenate([colours, blocks[..., ALPHA:].mean(axis=(1, 3))], axis=2)
