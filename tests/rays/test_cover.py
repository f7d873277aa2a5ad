"""Balls that cover triangles: all of them, and little else where these are long and thin."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sensors.acoustic_world import box, sphere
from uwsim.base.geometry import rotation_from_rpy
from uwsim.rays import RayScene, Surface
from uwsim.rays.cover import covering_balls

ROD = box((-5.0, -0.05, -0.05), (5.0, 0.05, 0.05))


def is_covered(points: np.ndarray, balls: np.ndarray) -> np.ndarray:
    apart = np.linalg.norm(points[:, None] - balls[None, :, :3], axis=2)
    return (apart <= balls[:, 3]).any(axis=1)


@pytest.mark.parametrize("rpy", [(0.0, 0.0, 0.0), (0.3, -0.8, 1.1)])
def test_a_rod_is_covered_by_a_row_of_balls_little_wider_than_it(
    rpy: tuple[float, float, float],
) -> None:
    rod = ROD @ rotation_from_rpy(*rpy).T + [3.0, -2.0, 7.0]
    balls = covering_balls(rod)
    assert len(balls) > 20
    assert balls[:, 3].max() < 0.25
    shares = np.random.default_rng(1).dirichlet((1.0, 1.0, 1.0), size=2000)
    which = np.random.default_rng(2).integers(len(rod), size=2000)
    points = (rod[which] * shares[:, :, None]).sum(axis=1)
    assert is_covered(points, balls).all()


def test_a_ball_is_covered_by_one_ball_and_nothing_by_none() -> None:
    ((x, y, z, radius),) = covering_balls(sphere((1.0, 2.0, 3.0), 0.5, 24))
    assert (x, y, z, radius) == pytest.approx((1.0, 2.0, 3.0, 0.5), abs=1e-3)
    assert covering_balls(np.zeros((0, 3, 3))).shape == (0, 4)


def test_balls_move_and_grow_with_their_bodies() -> None:
    ball = sphere((0.0, 0.0, 1.0), 0.5, 24)
    scene = RayScene([[Surface(4, ROD)], [Surface(2, ball), Surface(7, ball * 0.1)]])
    frame = np.diag([2.0, 2.0, 2.0, 1.0])
    frame[:3, 3] = 10.0, 0.0, 0.0
    scene.place(1, frame)
    found = scene.balls()
    last = found.surface.tolist()[-2:]
    assert last == [2, 7]
    np.testing.assert_allclose(found.centre[-2:], [[10.0, 0.0, 2.0], [10.0, 0.0, 0.2]], atol=1e-3)
    np.testing.assert_allclose(found.radius[-2:], [1.0, 0.1], atol=1e-3)
