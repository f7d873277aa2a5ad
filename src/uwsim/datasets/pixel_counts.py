"""Numbers of instances and classes from rendered ids, their counts and boxes, in one pass."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit
from ..rendering.rendered_image import PixelBox

IdMask = npt.NDArray[np.uint16]
ClassMask = npt.NDArray[np.uint8]
Rows = npt.NDArray[np.int64]


class NumberedImage(NamedTuple):
    """The masks of an image, and the measures of each instance."""

    instance_mask: IdMask
    """The number of the instance in each pixel, (h, w); 0: none."""
    class_mask: ClassMask
    """The number of the class in each pixel, (h, w); 0: none."""
    rows: Rows
    """The pixel count and the box of each instance, as `measure_ids`."""


@njit
def measure_ids(ids: IdMask, instance_numbers: IdMask, n: int) -> Rows:
    """Return the pixel count, left, top, right and bottom of each instance below n, (n, 5).

    Columns ``left <= u < right`` and rows ``top <= v < bottom`` contain all pixels of an instance.
    The box of an instance without pixels is 0.

    Args:
        ids: the id of the part in each pixel, (h, w).
        instance_numbers: the number of the instance of each id.
        n: the number of rows.
    """
    height, width = ids.shape
    result = np.zeros((n, 5), np.int64)
    for number in range(n):
        result[number, 1], result[number, 2] = width, height
    for row in range(height):
        column = 0
        while column < width:
            id = ids[row, column]
            start = column
            while column < width and ids[row, column] == id:
                column += 1
            if id < len(instance_numbers) and instance_numbers[id] < n:
                _extend(result[instance_numbers[id]], row, start, column)
    for number in range(n):
        if result[number, 0] == 0:
            result[number, 1:] = 0
    return result


@njit
def _extend(measures: npt.NDArray[np.int64], row: int, start: int, end: int) -> None:
    """Add the pixels of a row from the column ``start`` to before ``end``."""
    measures[0] += end - start
    measures[1] = min(measures[1], start)
    measures[2] = min(measures[2], row)
    measures[3] = max(measures[3], end)
    measures[4] = max(measures[4], row + 1)


@njit
def _map_ids(
    ids: IdMask,
    instance_numbers: IdMask,
    class_numbers: ClassMask,
    instance_mask: IdMask,
    class_mask: ClassMask,
) -> None:
    height, width = ids.shape
    for row in range(height):
        for column in range(width):
            id = ids[row, column]
            is_known = id < len(instance_numbers)
            instance_mask[row, column] = instance_numbers[id] if is_known else 0
            class_mask[row, column] = class_numbers[id] if is_known else 0


def number_image(
    ids: IdMask, instance_numbers: IdMask, class_numbers: ClassMask, n: int
) -> NumberedImage:
    """Return the masks of rendered ids, and the measures of the instances below n."""
    instance_mask, class_mask = np.empty(ids.shape, np.uint16), np.empty(ids.shape, np.uint8)
    _map_ids(ids, instance_numbers, class_numbers, instance_mask, class_mask)
    return NumberedImage(instance_mask, class_mask, measure_ids(ids, instance_numbers, n))


@njit
def round_millimetres(depth: npt.NDArray[np.float32], limit: np.float32) -> IdMask:
    """Return depths [m] as millimetres up to ``limit``, rounded to nearest; 0: no surface."""
    height, width = depth.shape
    result = np.zeros((height, width), np.uint16)
    for row in range(height):
        for column in range(width):
            value = depth[row, column]
            if np.isfinite(value):
                result[row, column] = np.uint16(min(np.rint(value * np.float32(1000.0)), limit))
    return result


def pixel_box(row: npt.NDArray[np.int64]) -> PixelBox:
    """Return the box of a row of `measure_ids`."""
    return PixelBox(int(row[1]), int(row[2]), int(row[3]), int(row[4]))
