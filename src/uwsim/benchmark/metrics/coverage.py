r"""Coverage: the share of a box's surface that has measured points near it.

A grid is laid over the box: along each axis :math:`k = \lfloor e / \text{lod} \rfloor` cells, at
least one, of the size e/k, with the extent e of the box and the level of detail; so there are
k + 1 nodes, the first and the last on faces. A point marks the up to eight nodes of the cell it
lies in (four where it lies on a side of one, and so on, to a billionth of a cell). Counted are the
nodes on five faces: the sixth, z' = 0, lies on the ground and cannot be seen. Every point marks,
what is ground or an outlier, too.

As only nodes on faces count, only they are kept: a point marks some of a face where it lies less
than a cell from it.
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
"""More nodes than this are refused."""
ON_NODE = 1e-9
"""A point this near to a node counts as on it [cell]."""


@dataclass(frozen=True, eq=False)
class _Face:
    """A side of the grid, and which of its nodes are marked."""

    axis: int
    """The axis normal to it."""
    at: int
    """Its place along that axis, in cells."""
    others: tuple[int, int]
    """The axes that it lies along."""
    nodes: npt.NDArray[np.bool_]
    """Along those."""
    own: tuple[slice, slice]
    """Those that belong to no face before it."""


class Coverage:
    """The nodes on the five faces of a box, and which were marked."""

    def __init__(self, box: Box, level_of_detail: float, *, is_original: bool = False) -> None:
        """Lay the grid.

        Args:
            box: from where to where, z up.
            level_of_detail: size of a cell, or somewhat less [m].
            is_original: count cells and nodes as the original does (compatibility
                ``reconstruction-coverage``).

        Raises:
            BadSetting: there would be too many nodes.
        """
        self._lower = np.array(box.lower)
        extents = (np.array(box.upper) - self._lower).tolist()
        cells = original_cells if is_original else whole_cells
        sizes, counts = zip(*(cells(extent, level_of_detail) for extent in extents), strict=True)
        self._size = np.array(sizes)
        self.counts: tuple[int, int, int] = counts
        """Nodes along each axis."""
        nx, ny, nz = counts
        if nx * ny + 2 * (nx * nz + ny * nz) > MAX_NODES:
            raise BadSetting(
                f"<levelOfDetail> {level_of_detail:g} m makes more than {MAX_NODES} cells on a "
                f"box of {extents[0]:.3g} x {extents[1]:.3g} x {extents[2]:.3g} m; "
                "choose a larger one."
            )
        self._faces = [*_sides(0, counts), *_sides(1, counts), _sides(2, counts)[-1]]
        self._n_nodes = sum(face.nodes[face.own].size for face in self._faces)
        self._on_node = 0.0 if is_original else ON_NODE
        if is_original:
            self._n_nodes = 2 * nx * ny + nx * nz + 2 * ny * nz - 2 * nx - 4 * ny - 2 * nz + 4

    def mark(self, points: Array) -> None:
        """Mark the nodes round points (3, n) [m]."""
        grid = (points - self._lower[:, None]) / self._size[:, None]
        for face in self._faces:
            near = np.abs(grid[face.axis] - face.at) < 1.0 - self._on_node
            if not near.any():
                continue
            u, v = (grid[other][near] for other in face.others)
            for rows in (np.floor(u + self._on_node), np.ceil(u - self._on_node)):
                for columns in (np.floor(v + self._on_node), np.ceil(v - self._on_node)):
                    n_rows, n_columns = face.nodes.shape
                    inside = (rows >= 0) & (rows < n_rows) & (columns >= 0) & (columns < n_columns)
                    face.nodes[rows[inside].astype(np.intp), columns[inside].astype(np.intp)] = True

    @property
    def n_marked(self) -> int:
        """How many nodes were marked."""
        return sum(int(face.nodes[face.own].sum()) for face in self._faces)

    @property
    def n_nodes(self) -> int:
        """How many there are."""
        return self._n_nodes

    @property
    def share(self) -> float | None:
        """Marked nodes among all [1]; None where the original's count of them is no number."""
        return self.n_marked / self._n_nodes if self._n_nodes > 0 else None


def whole_cells(extent: float, level_of_detail: float) -> tuple[float, int]:
    """Return the size of a cell [m] and the number of nodes along an extent [m]."""
    if extent <= 0.0:
        return level_of_detail, 1
    n_cells = max(1, math.floor(extent / level_of_detail + 1e-9))
    return extent / n_cells, n_cells + 1


def original_cells(extent: float, level_of_detail: float) -> tuple[float, int]:
    """Do as the original does: a cell may get lost in rounding; a thin box has one node."""
    if extent <= 0.0:
        return level_of_detail, 1
    n_cells = math.floor(extent / level_of_detail)
    if n_cells == 0:
        return math.inf, 1
    size = level_of_detail + math.fmod(extent, level_of_detail) / n_cells
    return size, int(extent / size) + 1


def _sides(axis: int, counts: tuple[int, int, int]) -> list[_Face]:
    """Return the first and last face across an axis; they are one where it has a single node."""
    others = tuple(i for i in range(3) if i != axis)
    own = tuple(slice(1, -1) if other < axis else slice(None) for other in others)
    return [
        _Face(
            axis=axis,
            at=at,
            others=(others[0], others[1]),
            nodes=np.zeros((counts[others[0]], counts[others[1]]), dtype=np.bool_),
            own=(own[0], own[1]),
        )
        for at in sorted({0, counts[axis] - 1})
    ]
