"""Submerged parts of shapes against geometry, and against a count of random points."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.physics.hydrodynamics import columns as c
from uwsim.physics.hydrodynamics.kernel.submersion import MEMORY, compute_submersion


def part(
    shape: float, size: tuple[float, ...], up: np.ndarray, depth: float
) -> tuple[float, np.ndarray]:
    lengths = [*size, 0.0, 0.0, 0.0][:3]
    fraction, *centre = compute_submersion(
        shape, *lengths, *(up / np.linalg.norm(up)), depth, np.empty(MEMORY)
    )
    return fraction, np.array(centre)


UP = np.array([0.0, 0.0, 1.0])
SIDE = np.array([1.0, 0.0, 0.0])
SHAPES = {
    "sphere": (c.SPHERE, (0.3,)),
    "ellipsoid": (c.ELLIPSOID, (0.4, 0.2, 0.3)),
    "box": (c.BOX, (0.6, 0.3, 0.4)),
    "cylinder": (c.CYLINDER, (0.25, 0.7)),
}


def inside(shape: float, size: tuple[float, ...], points: np.ndarray) -> np.ndarray:
    if shape == c.SPHERE:
        found = np.linalg.norm(points, axis=1) <= size[0]
    elif shape == c.ELLIPSOID:
        found = np.linalg.norm(points / size, axis=1) <= 1.0
    elif shape == c.BOX:
        found = (np.abs(points) <= np.array(size) / 2).all(axis=1)
    else:
        found = (np.hypot(points[:, 0], points[:, 1]) <= size[0]) & (
            np.abs(points[:, 2]) <= size[1] / 2
        )
    return np.asarray(found)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("depth", [-0.11, 0.0, 0.07, 0.15])
@pytest.mark.parametrize("up", [(0, 0, 1), (1, 0, 0), (0.3, -0.5, 0.8), (-0.7, 0.7, 0.1)])
def test_the_submerged_part_is_what_random_points_say(
    name: str, depth: float, up: tuple[float, float, float]
) -> None:
    shape, size = SHAPES[name]
    points = np.random.default_rng(1).uniform(-0.5, 0.5, (200_000, 3))
    points = points[inside(shape, size, points)]
    unit = np.array(up) / np.linalg.norm(up)
    wet = points[points @ unit <= depth]
    fraction, centre = part(shape, size, unit, depth)
    assert fraction == pytest.approx(len(wet) / len(points), abs=0.01)
    assert centre == pytest.approx(wet.mean(axis=0), abs=0.01)


def test_a_sphere_displaces_the_cap_of_archimedes() -> None:
    radius, height = 0.3, 0.2
    fraction, centre = part(c.SPHERE, (radius,), UP, height - radius)
    cap = math.pi * height**2 * (3 * radius - height) / 3
    assert fraction == pytest.approx(cap / (4 / 3 * math.pi * radius**3), rel=1e-14)
    # centroid of a cap, from the centre of the sphere
    down = 3 * (2 * radius - height) ** 2 / (4 * (3 * radius - height))
    assert centre == pytest.approx([0.0, 0.0, -down], rel=1e-14)


@pytest.mark.parametrize("shape", ["box", "cylinder"])
def test_an_upright_prism_is_exact(shape: str) -> None:
    kind, size = SHAPES[shape]
    height = size[-1]
    fraction, centre = part(kind, size, UP, 0.1)
    assert fraction == pytest.approx(0.5 + 0.1 / height, rel=1e-12)
    assert centre == pytest.approx([0.0, 0.0, (0.1 - height / 2) / 2], abs=1e-12)


def test_a_lying_cylinder_is_a_circular_segment() -> None:
    radius, depth = 0.25, 0.06
    fraction, _ = part(c.CYLINDER, (radius, 0.7), SIDE, depth)
    angle = 2 * math.acos(-depth / radius)
    assert fraction == pytest.approx((angle - math.sin(angle)) / (2 * math.pi), abs=1e-3)


def test_a_tilted_box_cut_in_a_wedge_is_exact() -> None:
    # the surface runs through opposite edges of a cube: half of it, centroid of a triangle
    fraction, centre = part(c.BOX, (1.0, 1.0, 1.0), np.array([1.0, 0.0, 1.0]), 0.0)
    assert fraction == pytest.approx(0.5, rel=1e-12)
    assert centre == pytest.approx([-1 / 6, 0.0, -1 / 6], abs=1e-12)


@pytest.mark.parametrize("name", SHAPES)
def test_above_and_below_there_is_nothing_and_everything(name: str) -> None:
    shape, size = SHAPES[name]
    assert part(shape, size, np.array([0.2, 0.3, 1.0]), 5.0)[0] == 1.0
    assert part(shape, size, np.array([0.2, 0.3, 1.0]), -5.0)[0] == 0.0


@pytest.mark.parametrize("name", SHAPES)
def test_volume_grows_with_depth_at_the_rate_of_the_waterplane(name: str) -> None:
    """Force is the slope of an energy: fractions at +- a step bound the moment arm's energy."""
    shape, size = SHAPES[name]
    up = np.array([0.2, -0.3, 0.9])
    depths = np.linspace(-0.6, 0.6, 400)
    fractions = np.array([part(shape, size, up, depth)[0] for depth in depths])
    assert (np.diff(fractions) >= -1e-9).all()
    assert np.abs(np.diff(fractions)).max() < 0.02


def test_the_sphere_of_the_original_shrinks_linearly_out_of_the_water() -> None:
    fraction, centre = part(c.SHRINKING_SPHERE, (0.286,), UP, -0.143)
    assert fraction == pytest.approx(0.125)
    assert centre == pytest.approx([0.0, 0.0, 0.0])
