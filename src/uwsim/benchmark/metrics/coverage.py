r"""Coverage: the fraction of the surface of a box that has measured points near it.

A grid divides the box into equal cells. Along an axis on which the extent of the box is e, there
are :math:`k = \lfloor e / \text{lod} \rfloor` cells of the size e/k, at least one; lod is the level
of detail [m]. The corners of the cells are the nodes of the grid: k + 1 along each axis, of which
the first and the last are on faces of the box. A point marks the corners of the cell in which it
is: eight nodes, or four if it is on a side of a cell, two on an edge, one on a node (within a
billionth of a cell). The coverage is the fraction of marked nodes on five faces of the box. The
sixth face, the lower one, is on the ground and not visible. Points on the ground and outliers mark
nodes, too.

Only nodes on faces are stored. A point marks nodes of a face if it is less than a cell from it.
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
"""The greatest number of nodes on the five faces."""
NODE_TOLERANCE = 1e-9
"""The largest distance from a node at which a point is on the node [size of a cell]."""


@dataclass(frozen=True, eq=False)
class _Face:
    """The nodes on one face of the box."""

    axis: int
    """The axis normal to the face: 0, 1, 2 for x, y, z."""
    node_index: int
    """The index of these nodes along that axis."""
    axes: tuple[int, int]
    """The two axes parallel to the face."""
    is_marked: npt.NDArray[np.bool_]
    """The mask of the marked nodes; its two dimensions are the two axes."""
    own_nodes: tuple[slice, slice]
    """The part of the mask with nodes that no earlier face has, which are counted here."""


class Coverage:
    """The grid nodes on five faces of a box, of which points mark those near them."""

    def __init__(self, box: Box, level_of_detail: float, *, is_original: bool = False) -> None:
        """Create the grid.

        Args:
            box: the box, in its own frame with z up [m].
            level_of_detail: the minimum size of a cell [m].
            is_original: compute cells and nodes as the original UWSim does (compatibility
                ``reconstruction-coverage``).

        Raises:
            BadSetting: the level of detail gives too many nodes.
        """
        self._lower = np.array(box.lower)
        extents = (np.array(box.upper) - self._lower).tolist()
        divide = original_cells if is_original else whole_cells
        sizes, counts = zip(*(divide(extent, level_of_detail) for extent in extents), strict=True)
        self._size = np.array(sizes)  # of a cell along each axis (3,) [m]
        self.counts: tuple[int, int, int] = counts
        """The number of nodes along each axis."""
        nx, ny, nz = counts
        if nx * ny + 2 * (nx * nz + ny * nz) > MAX_NODES:
            raise BadSetting(
                f"<levelOfDetail> {level_of_detail:g} m makes more than {MAX_NODES} nodes on a "
                f"box of {extents[0]:.3g} x {extents[1]:.3g} x {extents[2]:.3g} m; "
                "choose a larger one."
            )
        self._faces = [*_end_faces(0, counts), *_end_faces(1, counts), _end_faces(2, counts)[-1]]
        self._n_nodes = sum(face.is_marked[face.own_nodes].size for face in self._faces)
        self._tolerance = 0.0 if is_original else NODE_TOLERANCE
        if is_original:
            self._n_nodes = 2 * nx * ny + nx * nz + 2 * ny * nz - 2 * nx - 4 * ny - 2 * nz + 4

    def mark(self, points: Array) -> None:
        """Mark the nodes round points (3, n) [m], in the frame of the box."""
        grid, tolerance = (points - self._lower[:, None]) / self._size[:, None], self._tolerance
        for face in self._faces:
            is_near = np.abs(grid[face.axis] - face.node_index) < 1.0 - tolerance
            if not is_near.any():
                continue
            u, v = (grid[axis][is_near] for axis in face.axes)
            for rows in (np.floor(u + tolerance), np.ceil(u - tolerance)):
                for columns in (np.floor(v + tolerance), np.ceil(v - tolerance)):
                    n_rows, n_columns = face.is_marked.shape
                    mask = (rows >= 0) & (rows < n_rows) & (columns >= 0) & (columns < n_columns)
                    face.is_marked[rows[mask].astype(np.intp), columns[mask].astype(np.intp)] = True

    @property
    def n_marked(self) -> int:
        """The number of marked nodes."""
        return sum(int(face.is_marked[face.own_nodes].sum()) for face in self._faces)

    @property
    def n_nodes(self) -> int:
        """The number of nodes on the five faces."""
        return self._n_nodes

    @property
    def share(self) -> float | None:
        """The fraction of marked nodes [1]; None without nodes (only with ``is_original``)."""
        return self.n_marked / self._n_nodes if self._n_nodes > 0 else None


def whole_cells(extent: float, level_of_detail: float) -> tuple[float, int]:
    """Return the size of a cell [m] and the number of nodes along an extent [m]."""
    if extent <= 0.0:
        return level_of_detail, 1
    n_cells = max(1, math.floor(extent / level_of_detail + 1e-9))
    return extent / n_cells, n_cells + 1


def original_cells(extent: float, level_of_detail: float) -> tuple[float, int]:
    """Return the size of a cell [m] and the number of nodes along an extent, as UWSim does.

    In the original UWSim, rounding may lose a cell, and an extent below the level of detail has a
    single node.
    """
    if extent <= 0.0:
        return level_of_detail, 1
    n_cells = math.floor(extent / level_of_detail)
    if n_cells == 0:
        return math.inf, 1
    size = level_of_detail + math.fmod(extent, level_of_detail) / n_cells
    return size, int(extent / size) + 1


def _end_faces(axis: int, counts: tuple[int, int, int]) -> list[_Face]:
    """Return the first and the last face along an axis; only one if the axis has a single node.

    ``counts`` is the number of nodes along each axis.
    """
    axes = tuple(i for i in range(3) if i != axis)
    own_nodes = tuple(slice(1, -1) if other_axis < axis else slice(None) for other_axis in axes)
    return [
        _Face(
            axis=axis,
            node_index=node_index,
            axes=(axes[0], axes[1]),
            is_marked=np.zeros((counts[axes[0]], counts[axes[1]]), dtype=np.bool_),
            own_nodes=(own_nodes[0], own_nodes[1]),
        )
        for node_index in sorted({0, counts[axis] - 1})
    ]
