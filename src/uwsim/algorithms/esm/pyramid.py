"""Grey images and their pyramids, in float32 grey levels 0..255.

Coordinates (u, v) are in pixels from the centre of the top left pixel. A pixel of a pyramid level
covers four pixels of the next finer level, so the point (u, v) of one level is the point
((u - 0.5)/2, (v - 0.5)/2) of the next coarser level.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit

Grey = npt.NDArray[np.float32]
"""A grey image, (h, w) [grey level]."""


def to_grey(pixels: npt.NDArray[np.uint8]) -> Grey:
    """Convert an image to grey: the luma of an RGB image (h, w, 3), or a grey image (h, w)."""
    if pixels.ndim == 2:
        return pixels.astype(np.float32)
    return luma(np.ascontiguousarray(pixels))


@njit
def luma(rgb: npt.NDArray[np.uint8]) -> Grey:
    """Return the luma ``0.299 R + 0.587 G + 0.114 B`` (h, w) of an RGB image (h, w, 3)."""
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
    """Filter an image by (1 3 3 1)/8 along rows and columns, and select every second pixel.

    Beyond its edges the image is continued by its outermost pixels.
    """
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
    """Return the pyramid of an image, the finest level first.

    It has at most ``levels`` levels, and none with a side below 2 px.
    """
    images = [image]
    while len(images) < levels and min(images[-1].shape) >= 4:
        images.append(halve(images[-1]))
    return images


def level_from_image(level: int) -> Array:
    """Return the homography from level 0 to a level, (3, 3); ``-level`` gives its inverse."""
    scale = 0.5**level
    shift = 0.5 * (scale - 1.0)
    return np.array([[scale, 0.0, shift], [0.0, scale, shift], [0.0, 0.0, 1.0]])
