"""The meshes of a chart of the sea floor for drawing.

The normals at the nodes are those of the slopes between the neighbouring nodes of the whole grid,
so that parts of the grid fit together.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..assets.mesh import ArrayDigest, Mesh, Model, Texture
from ..assets.procedural.sand_texture import make_sand_texture
from ..base.files.input_files import InputFile
from ..bathymetry.height_grid import HeightGrid, cell_triangles

MAX_NODES = 260_000
"""The greatest number of nodes of the mesh of a whole chart; a larger chart has every second, third
or further node, and its full detail near cameras only."""
TEXTURE_SIDE = 4.0
"""The side of the image of sand on the floor [m]."""
COLOUR = (0.86, 0.78, 0.64)
"""The colour of the sea floor."""


def coarse_step(grid: HeightGrid) -> int:
    """Return the number of nodes from one to the next in the mesh of a whole chart."""
    rows, columns = grid.shape
    return max(1, math.ceil(math.sqrt(rows * columns / MAX_NODES)))


def terrain_model(grid: HeightGrid, name: str, files: Sequence[InputFile] = ()) -> Model:
    """Return the mesh of a whole chart in W, which was read from files."""
    rows, columns = (_indices(n, coarse_step(grid)) for n in grid.shape)
    mesh = grid_mesh(grid, rows, columns, make_sand_texture())
    digest = ArrayDigest((mesh,))
    return Model(name=name, meshes=(mesh,), source="file", digest=digest, files=tuple(files))


def grid_mesh(
    grid: HeightGrid,
    rows: npt.NDArray[np.int64],
    columns: npt.NDArray[np.int64],
    texture: Texture,
) -> Mesh:
    """Return the mesh of some rows and columns of a grid, in W."""
    x = grid.west + grid.spacing * columns
    y = grid.south + grid.spacing * rows
    vertices = np.empty((len(rows), len(columns), 3))
    vertices[..., 0], vertices[..., 1] = x, y[:, None]
    vertices[..., 2] = grid.heights[rows[:, None], columns]
    base = np.floor(vertices[0, 0, :2] / TEXTURE_SIDE)  # whole images: keeps coordinates small
    return Mesh(
        vertices=vertices.reshape(-1, 3).astype(np.float32),
        normals=_normals(grid, rows, columns),
        uvs=(vertices[..., :2] / TEXTURE_SIDE - base).reshape(-1, 2).astype(np.float32),
        triangles=cell_triangles(len(rows), len(columns)).astype(np.uint32),
        colour=COLOUR,
        texture=texture,
    )


def _indices(n: int, step: int) -> npt.NDArray[np.int64]:
    """Return every ``step``-th index below n, and the last."""
    indices = np.arange(0, n, step)
    return indices if indices[-1] == n - 1 else np.append(indices, n - 1)


def _normals(
    grid: HeightGrid, rows: npt.NDArray[np.int64], columns: npt.NDArray[np.int64]
) -> npt.NDArray[np.float32]:
    """Return the unit normals at nodes, (n, 3), from the heights one mesh step around each."""
    heights, (n_rows, n_columns) = grid.heights, grid.shape
    step = int(columns[1] - columns[0])
    left, right = np.maximum(columns - step, 0), np.minimum(columns + step, n_columns - 1)
    lower, upper = np.maximum(rows - step, 0), np.minimum(rows + step, n_rows - 1)
    normals = np.ones((len(rows), len(columns), 3))
    normals[..., 0] = -(
        heights[rows[:, None], right].astype(np.float64) - heights[rows[:, None], left]
    ) / (grid.spacing * (right - left))
    normals[..., 1] = -(
        heights[upper[:, None], columns].astype(np.float64) - heights[lower[:, None], columns]
    ) / (grid.spacing * (upper - lower)[:, None])
    normals /= np.sqrt((normals * normals).sum(axis=2))[..., None]
    return normals.reshape(-1, 3).astype(np.float32)
