r"""Exact ray casting against a height grid, by a pyramid of least and greatest heights.

The surface is that of `uwsim.bathymetry.height_grid.HeightGrid`: two triangles in each cell, whose
diagonal joins the nodes with the least and the greatest indices. A block of level l of the pyramid
has :math:`2^l \times 2^l` cells, with the least and the greatest height of its nodes. A ray steps
from block to block. Where its heights in a block are not between the block's heights, it skips the
block; otherwise it enters the block's smaller blocks (A. Tevs, I. Ihrke, H.-P. Seidel, *Maximum
mipmaps for fast, accurate, and scalable dynamic height field rendering*, I3D 2008). In a cell, the
distance follows from the planes of both triangles.

A ray hits the surface from above only, as it hits a mesh from outside only. It counts as above or
below across cells, so that no ray passes between two cells by rounding.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.calls import address_of
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer
from .kernel import Hits
from .triangle import MIN_COMPONENT

Floats = npt.NDArray[np.float32]
MAX_LEVELS = 24
"""The greatest number of levels of a pyramid."""
GRID = np.dtype(
    [
        ("west", np.float64),  # x of column 0 in W [m]
        ("south", np.float64),  # y of row 0 in W [m]
        ("base", np.float64),  # z in W of the height 0 [m]
        ("spacing", np.float64),  # distance between nodes [m]
        ("rows", np.int64),  # number of rows and columns of nodes
        ("columns", np.int64),
        ("heights", np.int64),  # address of float32 (rows, columns) [m]
        ("bounds", np.int64),  # address of float32 (n, 2): least and greatest height of blocks [m]
        ("n_bounds", np.int64),
        ("starts", np.int64),  # address of int64 (n_levels + 1,): first block of each level
        ("n_levels", np.int64),
        ("classes", np.int64),  # address of uint8 (rows - 1, columns - 1); 0: there are none
        ("surface", np.int64),  # surface index of the class 0
    ]
)
"""A height grid for compiled code."""

Record = Any


class Pyramid(NamedTuple):
    """The least and greatest heights of blocks of cells; level 0 is the grid itself."""

    bounds: Floats
    """The least and greatest height of each block, level by level from level 1 on, (n, 2) [m]."""
    starts: npt.NDArray[np.int64]
    """The index of the first block of each level; that of level 0 is unused, (n_levels + 1,)."""


class HeightRays:
    """A height grid for ray casting.

    Args:
        heights: the heights of the nodes, (rows, columns) [m].
        origin: the position in W of the first node at the height 0, (3,) [m].
        spacing: the distance between nodes [m].
        surface: the surface index of hits; with ``classes``, that of the class 0.
        classes: the class of each cell, which is added to the surface index; None: all 0.
    """

    def __init__(
        self,
        heights: Floats,
        origin: Array,
        spacing: float,
        surface: int,
        classes: npt.NDArray[np.uint8] | None = None,
    ) -> None:
        self._heights = np.ascontiguousarray(heights, np.float32)
        self._classes = None if classes is None else np.ascontiguousarray(classes)
        self._pyramid = build_pyramid(self._heights)
        self.record = np.zeros(1, GRID)
        """The record of `GRID`, (1,); its addresses are valid as long as this object exists."""
        record = self.record[0]
        record["west"], record["south"], record["base"] = origin.tolist()
        record["spacing"], record["surface"] = spacing, surface
        record["rows"], record["columns"] = self._heights.shape
        record["heights"] = address_of(self._heights)
        record["bounds"] = address_of(self._pyramid.bounds)
        record["n_bounds"] = len(self._pyramid.bounds)
        record["starts"] = address_of(self._pyramid.starts)
        record["n_levels"] = len(self._pyramid.starts) - 1
        record["classes"] = 0 if self._classes is None else address_of(self._classes)


def build_pyramid(heights: Floats) -> Pyramid:
    """Build the pyramid of a grid of heights, (rows, columns) [m]."""
    low = high = heights
    rows, columns = heights.shape[0] - 1, heights.shape[1] - 1
    starts, levels = [0, 0], []
    is_first = True
    while rows > 1 or columns > 1:
        rows, columns = (rows + 1) // 2, (columns + 1) // 2
        low, high = _reduce(low, high, rows, columns, is_first)
        is_first = False
        levels.append(np.stack([low, high], axis=-1).reshape(-1, 2))
        starts.append(starts[-1] + rows * columns)
    bounds = np.concatenate([np.zeros((0, 2), np.float32), *levels])
    return Pyramid(np.ascontiguousarray(bounds), np.array(starts, np.int64))


@njit
def _reduce(
    low: Floats, high: Floats, rows: int, columns: int, is_first: bool
) -> tuple[Floats, Floats]:
    """Return the least and greatest values of blocks of 2 x 2; of nodes, also those at the edge."""
    reach = 3 if is_first else 2
    lows, highs = np.empty((rows, columns), np.float32), np.empty((rows, columns), np.float32)
    for i in range(rows):
        for j in range(columns):
            minimum, maximum = low[2 * i, 2 * j], high[2 * i, 2 * j]
            for k in range(2 * i, min(2 * i + reach, low.shape[0])):
                for m in range(2 * j, min(2 * j + reach, low.shape[1])):
                    minimum, maximum = min(minimum, low[k, m]), max(maximum, high[k, m])
            lows[i, j], highs[i, j] = minimum, maximum
    return lows, highs


@njit
def cast_on_grid(
    grid: Record, origin: Array, directions: Array, starts: Array, reach: float, hits: Hits
) -> None:
    """Replace the hits of rays that hit a height grid before.

    Args:
        grid: a record of `GRID`.
        origin: the origin of the rays in W, (3,) [m].
        directions: unit vectors in W, (n, 3).
        starts: the distance at which each ray begins, (n,) [m].
        reach: the length of the rays [m].
        hits: the first hits so far; infinite distances without a hit.
    """
    heights = carray(pointer(grid.heights), (grid.rows, grid.columns), np.float32)
    bounds = carray(pointer(grid.bounds), (grid.n_bounds, 2), np.float32)
    level_starts = carray(pointer(grid.starts), (grid.n_levels + 1,), np.int64)
    scale = 1.0 / grid.spacing
    u0, v0 = (origin[0] - grid.west) * scale, (origin[1] - grid.south) * scale
    z0 = origin[2] - grid.base
    for n in range(len(directions)):
        ray = (
            (u0, v0, z0),
            (directions[n, 0] * scale, directions[n, 1] * scale, directions[n, 2]),
            (starts[n], min(reach, hits.distance[n])),
        )
        distance, i, j, is_upper = _first_hit(heights, bounds, level_starts, ray)
        if distance == np.inf:
            continue
        hits.distance[n] = distance
        _set_normal(hits.normal[n], heights, i, j, is_upper, grid.spacing)
        hits.surface[n] = grid.surface
        if grid.classes != 0:
            n_cells = (grid.rows - 1) * (grid.columns - 1)
            classes = carray(pointer(grid.classes), (n_cells,), np.uint8)
            hits.surface[n] += classes[i * (grid.columns - 1) + j]


@njit
def _set_normal(
    normal: Array, heights: Floats, i: int, j: int, is_upper: bool, spacing: float
) -> None:
    """Write the unit normal of a triangle of the cell (i, j)."""
    slope_u, slope_v = _slopes(heights, i, j, is_upper)
    x, y = -slope_u / spacing, -slope_v / spacing
    size = math.sqrt(x * x + y * y + 1.0)
    normal[0], normal[1], normal[2] = x / size, y / size, 1.0 / size


@njit
def _slopes(heights: Floats, i: int, j: int, is_upper: bool) -> tuple[float, float]:
    """Return the rise of a triangle per cell along columns and rows [m]; upper: north-west."""
    a, d = float(heights[i, j]), float(heights[i + 1, j + 1])
    if is_upper:
        c = float(heights[i + 1, j])
        return d - c, c - a
    b = float(heights[i, j + 1])
    return b - a, d - b


@njit
def _clip(position: float, rate: float, size: float, near: float, far: float) -> Any:
    """Return the part of a range of distances with ``0 <= position + rate t <= size``."""
    if abs(rate) <= MIN_COMPONENT:
        return (near, far) if 0.0 <= position <= size else (1.0, 0.0)
    entry, leave = -position / rate, (size - position) / rate
    if entry > leave:
        entry, leave = leave, entry
    return max(near, entry), min(far, leave)


@njit
def _first_hit(
    heights: Floats, bounds: Floats, level_starts: npt.NDArray[np.int64], ray: Any
) -> tuple[float, int, int, bool]:
    """Return the distance of the first hit [m], its cell, and whether the upper triangle is hit.

    Args:
        heights: the heights of the nodes, (rows, columns) [m].
        bounds: as in `Pyramid`.
        level_starts: as in `Pyramid`.
        ray: the origin (u, v, z) and the change of u, v, z per metre, with u and v in cells along
            columns and rows; the distances at which the ray begins and ends [m].
    """
    (u, v, z), (du, dv, dz), (t, end) = ray
    n_rows, n_columns = heights.shape[0] - 1, heights.shape[1] - 1  # of cells
    t, end = _clip(u, du, float(n_columns), t, end)
    t, end = _clip(v, dv, float(n_rows), t, end)
    top = len(level_starts) - 2
    low, high = (bounds[-1, 0], bounds[-1, 1]) if top > 0 else _bounds(heights, 0, 0)
    if not t <= end:  # beside the grid
        return np.inf, 0, 0, False
    was_above = z + dz * t > high
    if was_above:
        if dz >= 0.0:
            return np.inf, 0, 0, False
        t = max(t, (high - z) / dz)  # where the ray gets as low as the highest node
    if dz < 0.0:
        end = min(end, (low - z) / dz + 1e-9 * (1.0 + abs(t)))
    if t > end:
        return np.inf, 0, 0, False
    j = min(max(math.floor(u + du * t), 0), n_columns - 1)
    i = min(max(math.floor(v + dv * t), 0), n_rows - 1)
    is_begin = not was_above
    length = (end - t) * max(abs(du), abs(dv))
    level = 0
    while level < top and (1 << level) < length:
        level += 1
    while True:
        block_i, block_j = i >> level, j >> level
        t_u = ((block_j + (1 if du > 0.0 else 0) << level) - u) / du if du != 0.0 else np.inf
        t_v = ((block_i + (1 if dv > 0.0 else 0) << level) - v) / dv if dv != 0.0 else np.inf
        leave = max(t, min(t_u, t_v, end))
        z_0, z_1 = z + dz * t, z + dz * leave
        if level > 0:
            row = level_starts[level] + block_i * (((n_columns - 1) >> level) + 1) + block_j
            low, high = bounds[row, 0], bounds[row, 1]
        else:
            low, high = _bounds(heights, i, j)
        is_in_range = min(z_0, z_1) <= high and max(z_0, z_1) >= low
        if is_in_range and level > 0:
            level -= 1
            continue
        if is_in_range:
            distance, was_above, is_upper = _hit_cell(
                heights, i, j, ray, (t, leave), was_above, is_begin
            )
            if distance < np.inf:
                return distance, i, j, is_upper
        elif min(z_0, z_1) > high:
            was_above = True
        elif was_above:  # it passed the surface at the edge of the cell before, by rounding
            return t, i, j, False
        is_begin = False
        if leave >= end:
            return np.inf, 0, 0, False
        t = leave
        if t_u <= t_v:
            next_block = block_j + (1 if du > 0.0 else -1)
            j = next_block << level if du > 0.0 else (block_j << level) - 1
            i = _limit_to_block(math.floor(v + dv * t), block_i, level, n_rows)
            is_new_parent = next_block >> 1 != block_j >> 1
        else:
            next_block = block_i + (1 if dv > 0.0 else -1)
            i = next_block << level if dv > 0.0 else (block_i << level) - 1
            j = _limit_to_block(math.floor(u + du * t), block_j, level, n_columns)
            is_new_parent = next_block >> 1 != block_i >> 1
        if not (0 <= i < n_rows and 0 <= j < n_columns):
            return np.inf, 0, 0, False
        if is_new_parent and level < top:
            level += 1


@njit
def _limit_to_block(cell: int, block: int, level: int, n: int) -> int:
    """Return a cell index, limited to a block and to the n cells of the grid."""
    return min(max(cell, block << level), min((block + 1 << level) - 1, n - 1))


@njit
def _bounds(heights: Floats, i: int, j: int) -> tuple[float, float]:
    """Return the least and the greatest height of the nodes of a cell [m]."""
    a, b = heights[i, j], heights[i, j + 1]
    c, d = heights[i + 1, j], heights[i + 1, j + 1]
    return min(min(a, b), min(c, d)), max(max(a, b), max(c, d))


@njit
def _hit_cell(
    heights: Floats,
    i: int,
    j: int,
    ray: Any,
    limits: tuple[float, float],
    was_above: bool,
    is_begin: bool,
) -> tuple[float, bool, bool]:
    """Return the distance of a hit in a cell [m], whether the ray leaves above, and the triangle.

    Args:
        heights: the heights of the nodes, (rows, columns) [m].
        i: the row of the cell.
        j: the column of the cell.
        ray: as in `_first_hit`.
        limits: the distances at which the ray enters and leaves the cell [m].
        was_above: True if the ray was above the surface where it left the cell before.
        is_begin: True if the ray begins in this cell; then `was_above` does not count.
    """
    (u, v, z), (du, dv, dz), _ = ray
    t_0, t_1 = limits
    a = float(heights[i, j])
    t_diagonal = t_1
    if du != dv:
        crossing = ((v - i) - (u - j)) / (du - dv)
        if t_0 < crossing < t_1:
            t_diagonal = crossing
    # the longer part decides on the triangles: rounding may put the shorter on the wrong side
    is_first_longer = t_diagonal - t_0 >= t_1 - t_diagonal
    middle = 0.5 * (t_0 + t_diagonal) if is_first_longer else 0.5 * (t_diagonal + t_1)
    is_upper = ((v - i) + dv * middle > (u - j) + du * middle) == is_first_longer
    begin, stop = t_0, t_diagonal
    for _ in range(2):
        slope_u, slope_v = _slopes(heights, i, j, is_upper)
        offset = z - a - slope_u * (u - j) - slope_v * (v - i)  # height of the ray over the plane
        rate = dz - slope_u * du - slope_v * dv
        height_0, height_1 = offset + rate * begin, offset + rate * stop
        if is_begin:
            was_above, is_begin = height_0 > 0.0, False
        if (was_above or height_0 > 0.0) and height_1 <= 0.0:
            distance = -offset / rate if rate != 0.0 else begin
            return min(max(distance, begin), stop), False, is_upper
        was_above = height_1 > 0.0
        if stop >= t_1:
            break
        begin, stop, is_upper = t_diagonal, t_1, not is_upper
    return np.inf, was_above, is_upper
