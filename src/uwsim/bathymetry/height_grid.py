"""A height grid: the sea floor as heights at the nodes of a regular grid.

The grid is aligned with east (x) and north (y). Row 0 is the southernmost, column 0 the
westernmost. The diagonal of each cell joins its south-west and north-east nodes, so that the
surface is continuous; MuJoCo divides the cells of a height field in the same way.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..errors import UwsimError

MAX_CELLS = 40_000_000
"""The greatest number of nodes of a height grid: 160 MB of heights."""
Heights = npt.NDArray[np.float32]


def check_size(rows: int, columns: int, source: str) -> None:
    """Raise UwsimError for a grid with fewer than two rows or columns, or with too many nodes."""
    if rows < 2 or columns < 2:
        raise UwsimError(f"{source}: has {rows} rows and {columns} columns; expected 2 at least.")
    if rows * columns > MAX_CELLS:
        raise UwsimError(
            f"{source}: has {rows} x {columns} nodes; expected {MAX_CELLS} at most. "
            "Crop it, or choose a greater spacing."
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class HeightGrid:
    """Heights at the nodes of a square grid; a surface of two triangles in each cell."""

    west: float
    """The x of the first column [m]."""
    south: float
    """The y of the first row [m]."""
    spacing: float
    """The distance between neighbouring nodes along x and along y [m]."""
    heights: Heights
    """The heights, z up, (rows, columns) [m]; row 0 is the southernmost."""
    classes: npt.NDArray[np.uint8] | None = None
    """The index of the sediment of each cell, (rows - 1, columns - 1); None: one sediment."""

    @property
    def shape(self) -> tuple[int, int]:
        """The number of rows and of columns."""
        rows, columns = self.heights.shape
        return rows, columns

    @property
    def east(self) -> float:
        """The x of the last column [m]."""
        return self.west + self.spacing * (self.shape[1] - 1)

    @property
    def north(self) -> float:
        """The y of the last row [m]."""
        return self.south + self.spacing * (self.shape[0] - 1)

    @cached_property
    def height_range(self) -> tuple[float, float]:
        """The least and the greatest height [m]."""
        return float(self.heights.min()), float(self.heights.max())

    def corners(self) -> Array:
        """Return the lower and the upper corner of the bounding box, (2, 3) [m]."""
        low, high = self.height_range
        return np.array([[self.west, self.south, low], [self.east, self.north, high]])

    def height_at(self, x: float, y: float) -> float | None:
        """Return the height of the surface [m]; None outside the grid."""
        rows, columns = self.shape
        u, v = (x - self.west) / self.spacing, (y - self.south) / self.spacing
        if not (0.0 <= u <= columns - 1 and 0.0 <= v <= rows - 1):
            return None
        j, i = min(int(u), columns - 2), min(int(v), rows - 2)
        u, v = u - j, v - i
        a, b = float(self.heights[i, j]), float(self.heights[i, j + 1])
        c, d = float(self.heights[i + 1, j]), float(self.heights[i + 1, j + 1])
        return a + (u * (b - a) + v * (d - b) if u >= v else v * (c - a) + u * (d - c))

    def window(self, low: Array, high: Array) -> tuple[slice, slice] | None:
        """Return the rows and columns of the cells that a rectangle touches; None outside.

        Args:
            low: the lower x and y of the rectangle, (2,) or longer [m].
            high: its upper x and y [m].
        """
        rows, columns = self.shape
        if high[0] < self.west or low[0] > self.east or high[1] < self.south or low[1] > self.north:
            return None
        slices = []
        for lower, upper, start, n in (
            (low[1], high[1], self.south, rows),
            (low[0], high[0], self.west, columns),
        ):
            first_cell = min(max(int((lower - start) / self.spacing), 0), n - 2)
            last_cell = min(max(int((upper - start) / self.spacing), first_cell), n - 2)
            slices.append(slice(first_cell, last_cell + 2))
        return slices[0], slices[1]

    def part(self, rows: slice, columns: slice, step: int = 1) -> HeightGrid:
        """Return every ``step``-th node of a range of rows and columns, without sediments."""
        return HeightGrid(
            west=self.west + self.spacing * columns.start,
            south=self.south + self.spacing * rows.start,
            spacing=self.spacing * step,
            heights=np.ascontiguousarray(
                self.heights[rows.start : rows.stop : step, columns.start : columns.stop : step]
            ),
        )

    def points(self) -> Array:
        """Return the positions of the nodes, (rows, columns, 3) [m]."""
        rows, columns = self.shape
        points = np.empty((rows, columns, 3))
        points[..., 0] = self.west + self.spacing * np.arange(columns)
        points[..., 1] = (self.south + self.spacing * np.arange(rows))[:, None]
        points[..., 2] = self.heights
        return points

    def triangles(self) -> Array:
        """Return the faces of all cells, counter-clockwise seen from above, (n, 3, 3) [m]."""
        points = self.points()
        faces: Array = points.reshape(-1, 3)[cell_triangles(*self.shape)]
        return faces


def cell_triangles(rows: int, columns: int) -> npt.NDArray[np.int64]:
    """Return the node indices of the two triangles of each cell, (2 (rows-1) (columns-1), 3)."""
    nodes = np.arange(rows * columns).reshape(rows, columns)
    a, b = nodes[:-1, :-1].ravel(), nodes[:-1, 1:].ravel()
    c, d = nodes[1:, :-1].ravel(), nodes[1:, 1:].ravel()
    return np.stack([a, b, d, a, d, c], axis=1).reshape(-1, 3)
