"""The tiles of large charts near a camera, in more detail the nearer they are.

A chart is divided into a tree of square tiles. A tile of the level l has `TILE_NODES` cells along
each side, of 2^l cells of the chart each. A tile whose distance from the camera is less than
`DETAIL` times its side is replaced by its four parts. The tiles that are drawn depend on the
position of the camera alone, rounded to `POSITION_STEP`, so that an image does not depend on those
before it. A skirt below each edge covers the gaps between tiles of different levels. Tiles beyond
the camera's view are not drawn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...assets.mesh import Mesh, Model, Texture
from ...assets.procedural.sand_texture import make_sand_texture
from ...base.geometry import Array, Pose
from ...bathymetry.height_grid import HeightGrid
from ...model.parts import Part
from ...model.terrain_model import coarse_step, grid_mesh

if TYPE_CHECKING:
    from ...rendering.renderer import Renderer

TILE_NODES = 64
"""The number of cells along each side of a tile."""
DETAIL = 2.0
"""The distance at which a tile is divided, as a multiple of its side [1]."""
POSITION_STEP = 4.0
"""The step of the camera's position, as a multiple of the spacing of nodes [1]."""
MAX_MODELS = 256
"""The greatest number of meshes of tiles that are stored: some 80 MB."""


class Tile(NamedTuple):
    """A tile of a chart."""

    chart: int
    """The index of the chart."""
    level: int
    """The level; each cell of the tile has 2^level cells of the chart along each side."""
    row: int
    """The first row of the tile in the chart."""
    column: int
    """The first column of the tile in the chart."""


class TerrainTiles:
    """The tiles of the charts of a scene in a renderer.

    Args:
        parts: the visible parts of the scene.
    """

    def __init__(self, parts: Sequence[Part]) -> None:
        is_tiled = [part.grid is not None and coarse_step(part.grid) > 1 for part in parts]
        self.mesh_parts = np.flatnonzero(np.logical_not(is_tiled))
        """The indices of the parts that are drawn as they are, not as tiles."""
        self._charts = [
            (part.id, part.grid)
            for part, flag in zip(parts, is_tiled, strict=True)
            if flag and part.grid is not None
        ]
        self._texture: Texture | None = None
        self._models: dict[Tile, Model] = {}  # the most recently drawn last
        self._handles: list[int] = []
        self._tiles: list[Tile] = []

    def update(self, renderer: Renderer, world_from_camera: Pose, far: float) -> None:
        """Add the tiles for a camera to a renderer, and remove others.

        Args:
            renderer: the renderer.
            world_from_camera: the pose of the camera.
            far: the greatest distance that the camera sees [m].
        """
        if not self._charts:
            return
        tiles = [
            tile
            for chart, (_, grid) in enumerate(self._charts)
            for tile in select_tiles(grid, world_from_camera.position, far, chart)
        ]
        if tiles == self._tiles:
            return
        for handle in self._handles:
            renderer.remove(handle)
        self._handles = []
        for tile in tiles:
            number, grid = self._charts[tile.chart]
            model = self._models.pop(tile, None) or self._make_model(tile, grid)
            self._models[tile] = model
            handle = renderer.add(model, number)
            renderer.place(handle, _world_from_tile(grid, tile))
            self._handles.append(handle)
        self._tiles = tiles
        while len(self._models) > max(MAX_MODELS, len(tiles)):
            oldest_tile = next(iter(self._models))
            renderer.discard(self._models.pop(oldest_tile))

    def forget(self) -> None:
        """Forget what the renderer has, which is released."""
        self._handles, self._tiles, self._models = [], [], {}

    def _make_model(self, tile: Tile, grid: HeightGrid) -> Model:
        if self._texture is None:
            self._texture = make_sand_texture()
        mesh = make_tile(grid, tile, self._texture)
        return Model(name=f"terrain {tile}", meshes=(mesh,), source="file")


def select_tiles(grid: HeightGrid, position: Array, far: float, chart: int = 0) -> list[Tile]:
    """Return the tiles of a chart that a camera may see, in a fixed order.

    Args:
        grid: the chart in W.
        position: the position of the camera in W, (3,) [m].
        far: the greatest distance that the camera sees [m].
        chart: the index of the chart in the tiles.
    """
    step = POSITION_STEP * grid.spacing
    camera = np.rint(position / step) * step
    low, high = grid.height_range
    rows, columns = grid.shape
    n_cells = max(rows, columns) - 1
    top = max(0, math.ceil(math.log2(n_cells / TILE_NODES)))
    tiles: list[Tile] = []
    stack = [Tile(chart, top, 0, 0)]
    rise = max(low - float(camera[2]), float(camera[2]) - high, 0.0)
    x, y = (
        (float(camera[0]) - grid.west) / grid.spacing,
        (float(camera[1]) - grid.south) / grid.spacing,
    )
    while stack:
        tile = stack.pop()
        side = TILE_NODES << tile.level
        if tile.row >= rows - 1 or tile.column >= columns - 1:
            continue
        u = max(tile.column - x, x - tile.column - side, 0.0)
        v = max(tile.row - y, y - tile.row - side, 0.0)
        distance = math.sqrt((u * u + v * v) * grid.spacing**2 + rise * rise)
        if distance > far + step:
            continue
        if tile.level == 0 or distance >= DETAIL * side * grid.spacing:
            tiles.append(tile)
            continue
        half = side // 2
        stack += [
            Tile(chart, tile.level - 1, tile.row + i, tile.column + j)
            for i in (half, 0)
            for j in (half, 0)
        ]
    return tiles


def make_tile(grid: HeightGrid, tile: Tile, texture: Texture) -> Mesh:
    """Return the mesh of a tile with its skirt, relative to its first node at the height 0."""
    step = 1 << tile.level
    rows, columns = (
        np.unique(np.minimum(first + step * np.arange(TILE_NODES + 1), n - 1))
        for first, n in ((tile.row, grid.shape[0]), (tile.column, grid.shape[1]))
    )
    mesh = grid_mesh(grid, rows, columns, texture)
    vertices = mesh.vertices.reshape(len(rows), len(columns), 3).copy()
    vertices[..., 0] = grid.spacing * (columns - tile.column)
    vertices[..., 1] = (grid.spacing * (rows - tile.row))[:, None]
    depth = np.ptp(vertices[..., 2]) / 8.0 + 0.5 * step * grid.spacing
    nodes = np.arange(len(rows) * len(columns)).reshape(len(rows), len(columns))
    border = np.concatenate([nodes[0], nodes[1:, -1], nodes[-1, -2::-1], nodes[-2:0:-1, 0]])
    surface = vertices.reshape(-1, 3)
    skirt = surface[border] - np.array([0.0, 0.0, depth], np.float32)
    first, n = len(surface), len(border)
    a, b = border, np.roll(border, -1)  # counter-clockwise from above: the skirt faces outwards
    c, d = first + np.arange(n), first + np.roll(np.arange(n), -1)
    faces = np.stack([a, c, d, a, d, b], axis=1).reshape(-1, 3).astype(np.uint32)
    return Mesh(
        vertices=np.concatenate([surface, skirt]),
        normals=np.concatenate([mesh.normals, mesh.normals[border]]),
        uvs=np.concatenate([mesh.uvs, mesh.uvs[border]]),
        triangles=np.concatenate([mesh.triangles, faces]),
        colour=mesh.colour,
        texture=texture,
    )


def _world_from_tile(grid: HeightGrid, tile: Tile) -> Array:
    """Return the pose of a tile's first node at the height 0 in W, (4, 4) [m]."""
    world_from_tile = np.eye(4)
    world_from_tile[0, 3] = grid.west + grid.spacing * tile.column
    world_from_tile[1, 3] = grid.south + grid.spacing * tile.row
    return world_from_tile
