"""The contact shapes of a chart of the sea floor: tiles of a height field.

The surface is exact: it has the nodes and the diagonals of the chart's grid. The engine finds at
most 50 contacts between a shape and a tile, as in `height_field`. A grid of more than `MAX_TILES`
tiles of 5 x 5 cells has larger tiles; a body that covers more than 25 cells of one then loses some
contacts.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...base.geometry import Pose
from ...bathymetry.height_grid import HeightGrid
from .height_field import TILE_CELLS
from .shapes import FIELD_DEPTH, MIN_HEIGHT_RANGE, CollisionShape

MAX_TILES = 900
"""The greatest number of tiles of one chart."""


def terrain_shapes(
    grid: HeightGrid, object_from_world: Pose, frictions: Sequence[float | None] = (None,)
) -> tuple[CollisionShape, ...]:
    """Return the tiles of a height grid in W, in the frame of its object.

    Args:
        grid: the height grid.
        object_from_world: the pose of W in the frame of the object.
        frictions: the friction of each class of cells; None: that of the engine. A tile has that
            of its commonest class.
    """
    n_cells = tile_cells(grid)
    rows, columns = grid.shape
    shapes = []
    for i in range(0, rows - 1, n_cells):
        for j in range(0, columns - 1, n_cells):
            heights = grid.heights[i : i + n_cells + 1, j : j + n_cells + 1]
            low, high = float(heights.min()), float(heights.max())
            half_x = 0.5 * grid.spacing * (heights.shape[1] - 1)
            half_y = 0.5 * grid.spacing * (heights.shape[0] - 1)
            world_from_shape = Pose(
                np.array(
                    [
                        grid.west + grid.spacing * j + half_x,
                        grid.south + grid.spacing * i + half_y,
                        low,
                    ]
                ),
                np.eye(3),
            )
            shapes.append(
                CollisionShape(
                    kind="height field",
                    body_from_shape=object_from_world @ world_from_shape,
                    size=(half_x, half_y, max(high - low, MIN_HEIGHT_RANGE), FIELD_DEPTH),
                    heights=heights.astype(np.float64) - low,
                    friction=frictions[_commonest_class(grid, i, j, n_cells)],
                )
            )
    return tuple(shapes)


def _commonest_class(grid: HeightGrid, row: int, column: int, n_cells: int) -> int:
    """Return the commonest class of the cells of a tile; the least of equally common ones."""
    if grid.classes is None:
        return 0
    part = grid.classes[row : row + n_cells, column : column + n_cells]
    return int(np.argmax(np.bincount(part.ravel())))


def tile_cells(grid: HeightGrid) -> int:
    """Return the number of cells along each side of a tile."""
    rows, columns = grid.shape
    return max(TILE_CELLS, math.ceil(math.sqrt((rows - 1) * (columns - 1) / MAX_TILES)))
