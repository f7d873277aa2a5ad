"""The square of a trajectory: its corners, its constant speed, and its velocity."""

from __future__ import annotations

import numpy as np

from uwsim.benchmark.reference_trajectory import TrajectorySpec

SQUARE = TrajectorySpec(shape="square", centre=(-0.5, -0.5, 3.0), radius=0.5, period=20.0)


def test_a_square_has_its_corners_at_the_quarters_of_a_lap() -> None:
    corners = [(0.0, 0.0, 3.0), (-1.0, 0.0, 3.0), (-1.0, -1.0, 3.0), (0.0, -1.0, 3.0)]
    times = np.array([0.0, 5.0, 10.0, 15.0])
    np.testing.assert_allclose(SQUARE.position(times), corners, atol=1e-12)
    np.testing.assert_allclose(SQUARE.position(times + 40.0), corners, atol=1e-12)
    np.testing.assert_allclose(SQUARE.position(2.5), (-0.5, 0.0, 3.0))


def test_the_velocity_of_a_square_is_the_derivative_of_its_position() -> None:
    times = np.arange(0.5, 40.0, 0.73)
    difference = (SQUARE.position(times + 1e-6) - SQUARE.position(times - 1e-6)) / 2e-6
    np.testing.assert_allclose(SQUARE.velocity(times), difference, atol=1e-8)
    np.testing.assert_allclose(np.linalg.norm(SQUARE.velocity(times), axis=1), 0.2)
