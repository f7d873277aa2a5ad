"""Tiles of charts: they cover a chart once, finer near the camera, and images fit the rays."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.bathymetry.test_bathymetry import write_bay, write_scene
from tests.support.opened import open_scene
from uwsim.assets.procedural.sand_texture import make_sand_texture
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.bathymetry.height_grid import HeightGrid
from uwsim.model import terrain_model
from uwsim.scene.reader import read_scene
from uwsim.simulation.terrain import terrain_tiles
from uwsim.simulation.terrain.terrain_tiles import TILE_NODES, make_tile, select_tiles

HEIGHTS = np.random.default_rng(0).normal(-20.0, 1.0, (700, 1100)).astype(np.float32)
GRID = HeightGrid(west=-500.0, south=-300.0, spacing=1.0, heights=HEIGHTS)


@pytest.mark.parametrize("position", [(0.0, 0.0, -5.0), (-500.0, 390.0, -15.0), (0.0, 0.0, 900.0)])
def test_tiles_cover_the_chart_once_and_are_finest_below_the_camera(
    position: tuple[float, float, float],
) -> None:
    tiles = select_tiles(GRID, np.array(position), 1e5)
    n_covers = np.zeros((699, 1099), int)
    for tile in tiles:
        side = TILE_NODES << tile.level
        n_covers[tile.row : tile.row + side, tile.column : tile.column + side] += 1
    assert (n_covers == 1).all()
    x, y, z = position
    row, column = min(int(y + 300), 698), int(x + 500)
    level = next(
        tile.level
        for tile in tiles
        if 0 <= row - tile.row < TILE_NODES << tile.level
        and 0 <= column - tile.column < TILE_NODES << tile.level
    )
    assert (level == 0) == (z < 0.0)
    assert tiles == select_tiles(GRID, np.array(position) + 0.01, 1e5)


def test_tiles_beyond_the_range_of_the_camera_are_left_out() -> None:
    tiles = select_tiles(GRID, np.array([0.0, 0.0, -10.0]), 100.0)
    assert 0 < len(tiles) < len(select_tiles(GRID, np.array([0.0, 0.0, -10.0]), 1e5))


def test_a_tile_has_every_node_of_its_level_and_a_skirt_below_its_edge() -> None:
    texture = make_sand_texture()
    for tile in select_tiles(GRID, np.array([480.0, 300.0, -5.0]), 1e5)[::5]:
        mesh, step = make_tile(GRID, tile, texture), 1 << tile.level
        part = HEIGHTS[tile.row : tile.row + TILE_NODES * step + 1 : step]
        part = part[:, tile.column : tile.column + TILE_NODES * step + 1 : step]
        surface = mesh.vertices
        assert np.isin(part, surface[:, 2]).all()
        corners = mesh.vertices[mesh.triangles].astype(float)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        is_surface = normals[:, 2] > 1e-9
        middle = np.array([*surface[:, :2].mean(axis=0), 0.0])
        outward = ((corners.mean(axis=1) - middle) * normals)[:, :2].sum(axis=1)
        assert (outward[~is_surface] > 0.0).all()


def test_an_image_of_tiles_fits_the_rays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(terrain_model, "MAX_NODES", 500)
    monkeypatch.setattr(terrain_tiles, "TILE_NODES", 8)
    write_bay(tmp_path)
    file = write_scene(tmp_path, placement="<u:solid>0</u:solid>", z=9)
    simulation = open_scene(read_scene(file), timestep=0.01)
    camera = Pose(np.array([-4.0, -4.0, -4.0]), np.eye(3))  # it looks down
    lens = Intrinsics.from_fovy(80, 60, 1.2)
    image = simulation.world.scenery.render_clean(camera, lens, targets={"range"})
    rays = lens.rays().reshape(-1, 3)
    rays = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    distance = simulation.world.rays.cast(camera, rays, 100.0).distance.reshape(60, 80)
    assert image.range is not None
    is_seen = np.isfinite(image.range)
    np.testing.assert_array_equal(is_seen, np.isfinite(distance))
    error = np.abs(image.range[is_seen] - distance[is_seen]) / distance[is_seen]
    assert np.median(error) < 1e-5
    assert error.max() < 0.05
    simulation.close()
