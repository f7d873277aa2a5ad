"""Grey images and their pyramid, in float32 grey levels 0..255.

Coordinates are from the centre of the first pixel. A pixel of a level covers four pixels of the
finer level, so a point (u, v) of one level is ((u - 0.5)/2, (v - 0.5)/2) of the next.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit

Grey = npt.NDArray[np.float32]


def to_grey(pixels: npt.NDArray[np.uint8]) -> Grey:
    """Return the luma ``0.299 R + 0.587 G + 0.114 B`` of (h, w, 3), or a grey image (h, w)."""
    if pixels.ndim == 2:
        return pixels.astype(np.float32)
    return luma(np.ascontiguousarray(pixels))


@njit
def luma(rgb: npt.NDArray[np.uint8]) -> Grey:
    """Return the luma (h, w) of an RGB image (h, w, 3)."""
    height, width = rgb.shape[0], rgb.shape[1]
    grey_levels = np.empty(height * width, np.float32)
    values = rgb.reshape(-1)
    for i in range(height * width):
        grey_levels[i] = (
            np.float32(0.299) * values[3 * i]
            + np.float32(0.587) * values[3 * i + 1]
            + np.float32(0.114) * values[3 * i + 2]
        )
    return grey_levels.reshape(height, width)


@njit
def halve(image: Grey) -> Grey:
    """Halve the size after the filter (1 3 3 1)/8 along rows and columns; edges repeat."""
    height, width = image.shape[0] // 2, image.shape[1] // 2
    last_x, last_y = image.shape[1] - 1, image.shape[0] - 1
    near, far = np.float32(0.375), np.float32(0.125)
    half_image = np.empty((height, width), np.float32)
    column = np.empty(image.shape[1], np.float32)
    for y in range(height):
        upper_row, lower_row = max(2 * y - 1, 0), min(2 * y + 2, last_y)
        for x in range(image.shape[1]):
            column[x] = near * (image[2 * y, x] + image[2 * y + 1, x]) + far * (
                image[upper_row, x] + image[lower_row, x]
            )
        for x in range(width):
            half_image[y, x] = near * (column[2 * x] + column[2 * x + 1]) + far * (
                column[max(2 * x - 1, 0)] + column[min(2 * x + 2, last_x)]
            )
    return half_image


def pyramid(image: Grey, levels: int) -> list[Grey]:
    """Return the image and its halves, finest first, while the sides are at least 2 px."""
    images = [image]
    while len(images) < levels and min(images[-1].shape) >= 4:
        images.append(halve(images[-1]))
    return images


def level_from_image(level: int) -> Array:
    """Return the homography from the image to a level (3, 3); its inverse for ``-level``."""
    scale = 0.5**level
    shift = 0.5 * (scale - 1.0)
    return np.array([[scale, 0.0, shift], [0.0, scale, shift], [0.0, 0.0, 1.0]])
