r"""Conversion of meshes to height fields, in which the engine finds contacts fast.

A mesh can be converted if it is a sheet over a rectangle: along one axis of its body, all faces
show the same side, and each point of the rectangle is in exactly one face. The heights of the sheet
are sampled at the nodes of a grid,

.. math:: h_{ij} = z(x_0 + j\,\Delta x,\; y_0 + i\,\Delta y),

and each cell consists of two triangles. A mesh that is itself such a grid is converted exactly. For
any other mesh the distance of the nodes is halved until the greatest difference in height between
both surfaces is no more than a given error. This difference is at a node, at a corner, or where two
edges cross.

The engine finds at most 50 contacts between a shape and a height field. The grid is therefore cut
into tiles of 5 x 5 cells, which have 50 triangles each.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.linear import product

TILE_CELLS = 5
"""The number of cells along each side of a tile."""
MAX_CELLS = 250_000
"""The greatest number of cells of a grid: 10 000 tiles."""
MIN_HEIGHT_RANGE = 1e-3
"""The height range below which a sheet is a plane, for which plates are better [m]."""
ROUNDING_ERROR = 1e-5
"""The greatest error that can be due to the rounding of numbers in the mesh file [m]."""
MAX_REFINEMENTS = 4
"""The greatest number of distances of nodes that are tried, each half of the one before."""
TOLERANCE = 1e-6
"""The tolerance for a point inside a triangle or on a grid line, as a fraction of its size [1]."""

Ints = npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False, kw_only=True)
class HeightField:
    """A grid of heights; the diagonal of each cell joins its nodes with least and greatest x, y."""

    body_from_field: Array
    """The axes of the field in the frame of the body, as columns, (3, 3); heights are along z."""
    origin: Array
    """The x and y of the first node, in the axes of the field, (2,) [m]."""
    spacing: Array
    """The distance between nodes along x and along y, (2,) [m]."""
    heights: Array
    """The heights of the nodes, (rows, columns) [m]; each row is along x."""
    error: float
    """The greatest difference in height from the mesh [m]."""

    def triangles(self) -> Array:
        """Return the faces of all cells in the body's frame, (n, 3, 3) [m]."""
        rows, columns = self.heights.shape
        x = self.origin[0] + self.spacing[0] * np.arange(columns)
        y = self.origin[1] + self.spacing[1] * np.arange(rows)
        points = np.empty((rows, columns, 3))
        points[..., 0], points[..., 1], points[..., 2] = x[None, :], y[:, None], self.heights
        a, b = points[:-1, :-1], points[:-1, 1:]
        c, d = points[1:, :-1], points[1:, 1:]
        faces = np.stack([np.stack([a, b, d], axis=2), np.stack([a, d, c], axis=2)], axis=2)
        triangles: Array = product(faces.reshape(-1, 3), self.body_from_field.T).reshape(-1, 3, 3)
        return triangles

    def tiles(self) -> Iterator[tuple[Array, Array]]:
        """Yield each tile's centre at height 0, in the body's frame (3,), and its heights [m]."""
        rows, columns = self.heights.shape
        for i in range(0, rows - 1, TILE_CELLS):
            for j in range(0, columns - 1, TILE_CELLS):
                heights = self.heights[i : i + TILE_CELLS + 1, j : j + TILE_CELLS + 1]
                half = 0.5 * (np.array(heights.shape[::-1]) - 1.0)  # in cells, along x and y
                x, y = self.origin + self.spacing * (np.array([j, i]) + half)
                yield product(self.body_from_field, np.array([x, y, 0.0])), heights


def height_field(triangles: Array, error: float) -> HeightField | None:
    """Convert triangles to a height field; None if they are no sheet over a rectangle, or a plane.

    Args:
        triangles: the triangles, with corners counter-clockwise seen from outside, (n, 3, 3) [m].
        error: the greatest difference in height that is allowed [m].
    """
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    sizes = np.sqrt((normals * normals).sum(axis=1))
    has_area = sizes > 0.0
    if not has_area.any():
        return None
    normal = normals.sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    sign = 1.0 if normal[axis] > 0.0 else -1.0
    if not (sign * normals[has_area, axis] > 0.0).all():
        return None
    best_field: HeightField | None = None
    for n_quarter_turns in (
        0,
        1,
    ):  # the diagonals of a grid that is turned by 90 degrees run the other way
        frame = _frame(axis, sign, n_quarter_turns)
        corners = product(triangles[has_area].reshape(-1, 3), frame).reshape(-1, 3, 3)
        field = _sample_rectangle(corners, frame, error)
        if field is not None and (best_field is None or field.error < best_field.error):
            best_field = field
        if best_field is None or best_field.error <= ROUNDING_ERROR:
            break
    is_good = best_field is not None and best_field.error <= max(error, ROUNDING_ERROR)
    return best_field if is_good else None


def _frame(axis: int, sign: float, n_quarter_turns: int) -> Array:
    """Return the axes of a field in the body's frame, (3, 3): z is ``sign`` times a body axis."""
    x, y, z = (np.eye(3)[(axis + k) % 3] for k in (1, 2, 3))
    if sign < 0.0:
        y, z = -y, -z
    if n_quarter_turns:
        x, y = y, -x
    return np.column_stack([x, y, z])


def _sample_rectangle(corners: Array, frame: Array, error: float) -> HeightField | None:
    """Sample triangles (n, 3, 3) in the axes of the field; None if they cover no rectangle."""
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    extent = (high - low)[:2]
    if high[2] - low[2] < MIN_HEIGHT_RANGE or extent.min() <= 0.0:
        return None
    ab, ac = corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2]
    area = 0.5 * float((ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]).sum())
    if abs(area - extent[0] * extent[1]) > 1e-5 * area:
        return None
    size = _grid_of(corners, low, extent)
    if size is not None:
        return _sample_grid(corners, frame, low, extent, size)
    if error <= ROUNDING_ERROR:
        return None
    spacing = float(np.sqrt(2.0 * area / len(corners)))
    field: HeightField | None = None
    for k in range(MAX_REFINEMENTS):
        cells = np.maximum(1, np.ceil(extent / (spacing / 2**k))).astype(int)
        size = (int(cells[1]) + 1, int(cells[0]) + 1)
        if cells[0] * cells[1] > MAX_CELLS:
            break
        field = _sample_grid(corners, frame, low, extent, size)
        if field is None or field.error <= error:
            break
    return field


def _grid_of(corners: Array, low: Array, extent: Array) -> tuple[int, int] | None:
    """Return the rows and columns of nodes if the mesh is a regular grid; else None."""
    counts: list[int] = []
    for k in range(2):
        positions = np.sort(corners[:, :, k].ravel())
        step = float(extent[k]) / np.sqrt(2.0 * len(corners))
        is_line = np.concatenate([[True], np.diff(positions) > 0.01 * step])
        lines = positions[is_line]
        even_lines = low[k] + extent[k] * np.linspace(0.0, 1.0, len(lines))
        if len(lines) < 2 or np.abs(lines - even_lines).max() > 0.01 * extent[k] / (len(lines) - 1):
            return None
        counts.append(len(lines))
    columns, rows = counts
    n_cells = (rows - 1) * (columns - 1)
    return (rows, columns) if 2 * n_cells == len(corners) and n_cells <= MAX_CELLS else None


def _sample_grid(
    corners: Array, frame: Array, low: Array, extent: Array, size: tuple[int, int]
) -> HeightField | None:
    """Sample a sheet at the nodes of a grid (rows, columns); None if the sheet has a hole."""
    rows, columns = size
    spacing = extent / np.array([columns - 1, rows - 1])
    grid = corners.copy()  # x and y in units of cells
    grid[..., :2] = (corners[..., :2] - low[:2]) / spacing
    heights = _heights_at_nodes(grid, rows, columns)
    if not np.isfinite(heights).all():
        return None
    return HeightField(
        body_from_field=frame,
        origin=low[:2].copy(),
        spacing=spacing,
        heights=heights,
        error=_greatest_difference(grid, heights),
    )


def _heights_at_nodes(grid: Array, rows: int, columns: int) -> Array:
    """Return the heights of triangles at the nodes, (rows, columns) [m]; NaN where there is none.

    Args:
        grid: the triangles, (n, 3, 3), with x and y in units of cells.
        rows: the number of nodes along y.
        columns: the number of nodes along x.
    """
    first_nodes = np.ceil(grid[..., :2].min(axis=1) - TOLERANCE).astype(np.int64)  # (n, 2)
    counts = np.floor(grid[..., :2].max(axis=1) + TOLERANCE).astype(np.int64) - first_nodes + 1
    owner, index = _ranges(counts[:, 0] * counts[:, 1])
    width = counts[owner, 0]
    column, row = first_nodes[owner, 0] + index % width, first_nodes[owner, 1] + index // width
    a, b, c = (grid[owner, k] for k in range(3))
    x, y = column - a[:, 0], row - a[:, 1]
    ab, ac = b - a, c - a
    double_areas = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    s = (x * ac[:, 1] - y * ac[:, 0]) / double_areas
    t = (y * ab[:, 0] - x * ab[:, 1]) / double_areas
    is_inside = (s >= -TOLERANCE) & (t >= -TOLERANCE) & (s + t <= 1.0 + TOLERANCE)
    is_inside &= (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    heights = np.full((rows, columns), np.nan)
    values = a[:, 2] + s * ab[:, 2] + t * ac[:, 2]
    heights[row[is_inside], column[is_inside]] = values[is_inside]
    return heights


def _greatest_difference(grid: Array, heights: Array) -> float:
    """Compute the greatest difference in height between a field and triangles [m].

    Between corners, nodes and the points where edges of the two surfaces cross, both are flat; at
    the nodes the difference is 0. ``grid`` is as in `_heights_at_nodes`.
    """
    points = [grid.reshape(-1, 3)]
    starts, ends = grid.reshape(-1, 3), np.roll(grid, -1, axis=1).reshape(-1, 3)
    for family in ((1.0, 0.0), (0.0, 1.0), (-1.0, 1.0)):  # columns, rows, diagonals
        a, b = (family[0] * ps[:, 0] + family[1] * ps[:, 1] for ps in (starts, ends))
        first_lines = np.ceil(np.minimum(a, b) + TOLERANCE).astype(np.int64)
        counts = np.floor(np.maximum(a, b) - TOLERANCE).astype(np.int64) - first_lines + 1
        owner, index = _ranges(np.maximum(counts, 0))
        share = (first_lines[owner] + index - a[owner]) / (b[owner] - a[owner])
        points.append(starts[owner] + share[:, None] * (ends[owner] - starts[owner]))
    all_points = np.concatenate(points)
    return float(np.abs(_field_at(all_points, heights) - all_points[:, 2]).max())


def _field_at(points: Array, heights: Array) -> Array:
    """Return the heights of a field at points (n, 2+) with x and y in units of cells, (n,) [m]."""
    rows, columns = heights.shape
    j = np.clip(np.floor(points[:, 0]).astype(np.int64), 0, columns - 2)
    i = np.clip(np.floor(points[:, 1]).astype(np.int64), 0, rows - 2)
    u, v = points[:, 0] - j, points[:, 1] - i
    a, b = heights[i, j], heights[i, j + 1]
    c, d = heights[i + 1, j], heights[i + 1, j + 1]
    rises = np.where(u >= v, u * (b - a) + v * (d - b), v * (c - a) + u * (d - c))
    return np.asarray(a + rises)


def _ranges(counts: Ints) -> tuple[Ints, Ints]:
    """Enumerate ``0 .. count - 1`` for each count; return count indices, and the numbers."""
    owner = np.repeat(np.arange(len(counts)), counts)
    starts = np.cumsum(counts) - counts
    return owner, np.arange(len(owner)) - starts[owner]
