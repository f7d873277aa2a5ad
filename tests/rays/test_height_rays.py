"""Rays against height grids: the same as against all triangles, and as in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.geometry import Pose
from uwsim.bathymetry.height_grid import HeightGrid
from uwsim.rays import HeightRays, RayScene, Surface


def grid_rays(grid: HeightGrid, surface: int = 0) -> RayScene:
    origin = np.array([grid.west, grid.south, 0.0])
    rays = HeightRays(grid.heights, origin, grid.spacing, surface, grid.classes)
    return RayScene([], [rays])


def directions(n: int, seed: int) -> np.ndarray:
    """Directions of all kinds: downward, level, along rows and columns, and straight down."""
    random = np.random.default_rng(seed)
    rays = random.normal(size=(n, 3))
    rays[:, 2] *= random.choice([0.05, 1.0, 5.0], n)
    rays[: n // 8, 0] = 0.0
    rays[n // 8 : n // 4, 1] = 0.0
    rays[n // 4 : n // 3, 1] = rays[n // 4 : n // 3, 0]
    rays[:3] = [0.0, 0.0, -1.0]
    return rays / np.linalg.norm(rays, axis=1, keepdims=True)


@pytest.mark.parametrize("roughness", [0.0, 0.02, 1.0, 4.0])
def test_rays_hit_what_they_hit_among_all_triangles(roughness: float) -> None:
    random = np.random.default_rng(5)
    for seed in range(20):
        rows, columns = random.integers(2, 40, 2)
        heights = random.normal(0.0, roughness, (rows, columns)).astype(np.float32)
        grid = HeightGrid(west=-3.7, south=11.3, spacing=1.5, heights=heights)
        low, high = grid.corners()
        position = random.uniform(low - [4, 4, 0], high + np.array([4, 4, 15]))
        rays = directions(300, seed)
        place = Pose(position, np.eye(3))
        mesh = RayScene([[Surface(0, grid.triangles())]]).cast(place, rays, 40.0)
        hits = grid_rays(grid).cast(place, rays, 40.0)
        np.testing.assert_allclose(hits.distance, mesh.distance, rtol=0.0, atol=1e-5)
        is_hit = np.isfinite(mesh.distance)
        same = np.abs(hits.normal[is_hit] - mesh.normal[is_hit]).max(axis=1) < 1e-6
        assert same.mean() > 0.99  # an edge belongs to two triangles


def test_rays_hit_a_plane_at_the_distance_of_the_formula() -> None:
    x, y = np.meshgrid(np.arange(65) - 32.0, np.arange(65) - 32.0)
    heights = (0.25 * x - 0.5 * y - 10.0).astype(np.float32)
    scene = grid_rays(HeightGrid(west=-32.0, south=-32.0, spacing=1.0, heights=heights))
    rays = directions(500, 1)
    hits = scene.cast(Pose(np.array([0.3, 0.7, 1.0]), np.eye(3)), rays, 30.0)
    normal = np.array([-0.25, 0.5, 1.0])
    distance = -(np.array([0.3, 0.7, 11.0]) @ normal) / (rays @ normal)
    ends = np.array([0.3, 0.7, 1.0]) + distance[:, None] * rays
    is_hit = (distance > 0.0) & (distance < 30.0) & (np.abs(ends[:, :2]) < 32.0).all(axis=1)
    assert is_hit.sum() > 100
    np.testing.assert_array_equal(np.isfinite(hits.distance), is_hit)
    np.testing.assert_allclose(hits.distance[is_hit], distance[is_hit], rtol=1e-12)
    unit = np.broadcast_to(normal / np.linalg.norm(normal), (is_hit.sum(), 3))
    np.testing.assert_allclose(hits.normal[is_hit], unit, atol=1e-12)


def test_rays_on_a_sine_converge_to_the_sine() -> None:
    """The error of a linear surface is the square of the step times the curvature by 8."""
    for spacing in (0.5, 0.25):
        x = np.arange(0.0, 60.0, spacing)
        heights = np.tile(2.0 * np.sin(0.5 * x), (20, 1)).astype(np.float32)
        scene = grid_rays(HeightGrid(west=0.0, south=0.0, spacing=spacing, heights=heights))
        for position in np.linspace(2.0, 50.0, 40):
            hits = scene.cast(
                Pose(np.array([position, 2.0, 9.0]), np.eye(3)), np.array([[0.0, 0.0, -1.0]]), 99.0
            )
            height = 9.0 - hits.distance[0]
            assert (
                abs(height - 2.0 * math.sin(0.5 * position)) <= 2.0 * 0.25 * spacing**2 / 8 + 1e-6
            )


def test_a_ray_from_below_passes_and_a_long_ray_at_a_grazing_angle_hits() -> None:
    heights = np.zeros((2, 4097), np.float32)
    scene = grid_rays(HeightGrid(west=0.0, south=0.0, spacing=1.0, heights=heights))
    below = scene.cast(Pose(np.array([9.0, 0.5, -1.0]), np.eye(3)), np.array([[0.0, 0, 1]]), 50.0)
    assert np.isinf(below.distance[0])
    slope = np.array([[4000.0, 0.0, -1.0]])
    hits = scene.cast(
        Pose(np.array([1.0, 0.5, 1.0]), np.eye(3)), slope / np.linalg.norm(slope), 5000.0
    )
    assert hits.distance[0] == pytest.approx(math.hypot(4000.0, 1.0))


def test_the_class_of_a_cell_is_added_to_the_surface() -> None:
    classes = np.array([[0, 1], [2, 0]], np.uint8)
    grid = HeightGrid(
        west=0.0, south=0.0, spacing=1.0, heights=np.zeros((3, 3), np.float32), classes=classes
    )
    scene = grid_rays(grid, surface=7)
    down = np.array([[0.0, 0.0, -1.0]])
    for x, y, surface in ((0.5, 0.5, 7), (1.5, 0.5, 8), (0.5, 1.5, 9)):
        hits = scene.cast(Pose(np.array([x, y, 1.0]), np.eye(3)), down, 9.0)
        assert hits.surface.tolist() == [surface]


def test_the_nearer_of_a_grid_and_a_mesh_is_hit() -> None:
    grid = HeightGrid(west=-5.0, south=-5.0, spacing=10.0, heights=np.zeros((2, 2), np.float32))
    rays = HeightRays(grid.heights, np.array([-5.0, -5.0, 0.0]), 10.0, 3)
    for height, surface in ((1.0, 8), (-1.0, 3)):
        triangles = grid.triangles() + np.array([0.0, 0.0, height])
        scene = RayScene([[Surface(8, triangles)]], [rays])
        hits = scene.cast(Pose(np.array([1.0, 2.0, 4.0]), np.eye(3)), np.array([[0.0, 0, -1]]), 9.0)
        assert hits.surface.tolist() == [surface]
