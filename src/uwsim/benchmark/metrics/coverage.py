r"""Coverage: the share of a box's surface that has measured points near it.

A grid divides the box: along each axis :math:`k = \lfloor e / \text{lod} \rfloor` cells, at least
one, of the size e/k, with the extent e of the box and the level of detail. There are k + 1 nodes,
the first and the last on faces. A point marks the nodes of its cell, at most eight (four if it is
on a side of a cell, and so on, to a billionth of a cell). The nodes on five faces are counted: the
sixth, z' = 0, is on the ground and not visible. Ground points and outliers mark nodes, too.

Only nodes on faces are stored: a point marks nodes of a face if it is less than a cell from it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...errors import BadSetting
from ...world import Box

MAX_NODES = 20_000_000
"""The greatest number of nodes."""
NODE_TOLERANCE = 1e-9
"""The tolerance within which a point is on a node [cell]."""


@dataclass(frozen=True, eq=False)
class _Face:
    """A side of the grid, with its marked nodes."""

    axis: int
    """The axis normal to the side."""
    cell: int
    """The position along that axis [cell]."""
    axes: tuple[int, int]
    """The axes in the side."""
    nodes: npt.NDArray[np.bool_]
    """The marks of the nodes, along these axes."""
    new_nodes: tuple[slice, slice]
    """The nodes that belong to no previous side."""


class Coverage:
    """The nodes on the five faces of a box, with those that points have marked."""

    def __init__(self, box: Box, level_of_detail: float, *, is_original: bool = False) -> None:
        """Create the grid.

        Args:
            box: the extent of the box, z up.
            level_of_detail: the size of a cell, or somewhat less [m].
            is_original: count cells and nodes as the original does (compatibility
                ``reconstruction-coverage``).

        Raises:
            BadSetting: there are too many nodes.
        """
        self._lower = np.array(box.lower)
        extents = (np.array(box.upper) - self._lower).tolist()
        cells = original_cells if is_original else whole_cells
        sizes, counts = zip(*(cells(extent, level_of_detail) for extent in extents), strict=True)
        self._size = np.array(sizes)
        self.counts: tuple[int, int, int] = counts
        """The number of nodes along each axis."""
        nx, ny, nz = counts
        if nx * ny + 2 * (nx * nz + ny * nz) > MAX_NODES:
            raise BadSetting(
                f"<levelOfDetail> {level_of_detail:g} m makes more than {MAX_NODES} cells on a "
                f"box of {extents[0]:.3g} x {extents[1]:.3g} x {extents[2]:.3g} m; "
                "choose a larger one."
            )
        self._faces = [*_end_faces(0, counts), *_end_faces(1, counts), _end_faces(2, counts)[-1]]
        self._n_nodes = sum(face.nodes[face.new_nodes].size for face in self._faces)
        self._tolerance = 0.0 if is_original else NODE_TOLERANCE
        if is_original:
            self._n_nodes = 2 * nx * ny + nx * nz + 2 * ny * nz - 2 * nx - 4 * ny - 2 * nz + 4

    def mark(self, points: Array) -> None:
        """Mark the nodes round points (3, n) [m]."""
        grid, tolerance = (points - self._lower[:, None]) / self._size[:, None], self._tolerance
        for face in self._faces:
            is_near = np.abs(grid[face.axis] - face.cell) < 1.0 - tolerance
            if not is_near.any():
                continue
            u, v = (grid[axis][is_near] for axis in face.axes)
            for rows in (np.floor(u + tolerance), np.ceil(u - tolerance)):
                for columns in (np.floor(v + tolerance), np.ceil(v - tolerance)):
                    n_rows, n_columns = face.nodes.shape
                    mask = (rows >= 0) & (rows < n_rows) & (columns >= 0) & (columns < n_columns)
                    face.nodes[rows[mask].astype(np.intp), columns[mask].astype(np.intp)] = True

    @property
    def n_marked(self) -> int:
        """The number of marked nodes."""
        return sum(int(face.nodes[face.new_nodes].sum()) for face in self._faces)

    @property
    def n_nodes(self) -> int:
        """The number of nodes."""
        return self._n_nodes

    @property
    def share(self) -> float | None:
        """The share of marked nodes [1]; None if the original's number of nodes is not positive."""
        return self.n_marked / self._n_nodes if self._n_nodes > 0 else None


def whole_cells(extent: float, level_of_detail: float) -> tuple[float, int]:
    """Return the size of a cell [m] and the number of nodes along an extent [m]."""
    if extent <= 0.0:
        return level_of_detail, 1
    n_cells = max(1, math.floor(extent / level_of_detail + 1e-9))
    return extent / n_cells, n_cells + 1


def original_cells(extent: float, level_of_detail: float) -> tuple[float, int]:
    """Return the original's size and number: rounding may lose a cell; a thin box has one node."""
    if extent <= 0.0:
        return level_of_detail, 1
    n_cells = math.floor(extent / level_of_detail)
    if n_cells == 0:
        return math.inf, 1
    size = level_of_detail + math.fmod(extent, level_of_detail) / n_cells
    return size, int(extent / size) + 1


def _end_faces(axis: int, counts: tuple[int, int, int]) -> list[_Face]:
    """Return the first and last face across an axis, which are one if it has a single node."""
    axes = tuple(i for i in range(3) if i != axis)
    new_nodes = tuple(slice(1, -1) if other_axis < axis else slice(None) for other_axis in axes)
    return [
        _Face(
            axis=axis,
            cell=cell,
            axes=(axes[0], axes[1]),
            nodes=np.zeros((counts[axes[0]], counts[axes[1]]), dtype=np.bool_),
            new_nodes=(new_nodes[0], new_nodes[1]),
        )
        for cell in sorted({0, counts[axis] - 1})
    ]
