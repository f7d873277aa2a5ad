"""A chart: heights on a regular grid in the coordinates of a file."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..base.geometry import Array
from .coordinates import LOCAL_SYSTEM, CoordinateSystem
from .height_grid import Heights


@dataclass(frozen=True, eq=False, kw_only=True)
class Chart:
    """Heights at the nodes of a regular grid, in the coordinate system of a file."""

    x: float
    """The coordinate of the first column: metres, or degrees of longitude."""
    y: float
    """The coordinate of the first row, the southernmost: metres, or degrees of latitude."""
    step_x: float
    """The distance between columns, above 0; metres or degrees."""
    step_y: float
    """The distance between rows, above 0; metres or degrees."""
    heights: Heights
    """The heights of the nodes, z up, (rows, columns) [m]; NaN where the file has none."""
    system: CoordinateSystem = LOCAL_SYSTEM
    """The coordinate system of x and y."""

    @property
    def shape(self) -> tuple[int, int]:
        """The number of rows and of columns."""
        rows, columns = self.heights.shape
        return rows, columns

    @property
    def n_holes(self) -> int:
        """The number of nodes without a height."""
        return int(np.count_nonzero(np.isnan(self.heights)))

    def columns(self) -> Array:
        """Return the coordinates of the columns, (columns,)."""
        return np.asarray(self.x + self.step_x * np.arange(self.shape[1]), np.float64)

    def rows(self) -> Array:
        """Return the coordinates of the rows, (rows,)."""
        return np.asarray(self.y + self.step_y * np.arange(self.shape[0]), np.float64)

    def with_system(self, system: CoordinateSystem) -> Chart:
        """Return the chart with another coordinate system for the same numbers."""
        return replace(self, system=system)
