"""A grid of depths of the bottom, which averages the soundings in each cell."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array


class BottomMap:
    """A grid of square cells over a rectangle from the origin of the navigation frame.

    Args:
        length: the extent along x [m].
        width: the extent along y [m].
        cell: the side of a cell [m].
    """

    def __init__(self, length: float, width: float, cell: float) -> None:
        self._cell = cell
        self._shape = round(length / cell), round(width / cell)
        self._sums = np.zeros((self._shape[0] * self._shape[1], 3))
        self._counts = np.zeros(len(self._sums))

    def add(self, soundings: Array) -> None:
        """Add points of the bottom in the navigation frame, (n, 3) [m]; those outside are left."""
        cells = np.floor(soundings[:, :2] / self._cell).astype(np.intp)
        is_inside = ((cells >= 0) & (cells < np.array(self._shape))).all(axis=1)
        index = cells[is_inside, 0] * self._shape[1] + cells[is_inside, 1]
        np.add.at(self._sums, index, soundings[is_inside])
        np.add.at(self._counts, index, 1.0)

    def points(self) -> Array:
        """Return the mean sounding of each cell that has one, navigation frame, (n, 3) [m]."""
        has_soundings = self._counts > 0.0
        means: Array = self._sums[has_soundings] / self._counts[has_soundings, None]
        return means
