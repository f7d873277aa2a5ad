"""Counts and boxes of the numbers in a mask, in one pass over its pixels."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit
from ..rendering.rendered_image import PixelBox


@njit
def measure_numbers(mask: npt.NDArray[np.uint16], n: int) -> npt.NDArray[np.int64]:
    """Return the pixel count, left, top, right and bottom of each number below n, (n, 5).

    Columns ``left <= u < right`` and rows ``top <= v < bottom`` contain all pixels of a number.
    The box of a number without pixels is 0. Greater numbers are ignored.
    """
    height, width = mask.shape
    result = np.zeros((n, 5), np.int64)
    for number in range(n):
        result[number, 1], result[number, 2] = width, height
    for row in range(height):
        for column in range(width):
            number = mask[row, column]
            if number < n:
                result[number, 0] += 1
                result[number, 1] = min(result[number, 1], column)
                result[number, 2] = min(result[number, 2], row)
                result[number, 3] = max(result[number, 3], column + 1)
                result[number, 4] = max(result[number, 4], row + 1)
    for number in range(n):
        if result[number, 0] == 0:
            result[number, 1:] = 0
    return result


def pixel_box(row: npt.NDArray[np.int64]) -> PixelBox:
    """Return the box of a row of `measure_numbers`."""
    return PixelBox(int(row[1]), int(row[2]), int(row[3]), int(row[4]))
