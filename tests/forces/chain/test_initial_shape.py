"""The first shape of a tether: its length, its ends, and that it is level."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.forces.chain.initial_shape import arc_between

SHARES = np.linspace(0.0, 1.0, 401)


@pytest.mark.parametrize("length", [5.1, 7.0, 30.0])
def test_a_slack_tether_is_an_arc_of_its_length_between_its_ends(length: float) -> None:
    start, end = np.array([1.0, 2.0, -3.0]), np.array([4.0, -2.0, -3.0])
    points = arc_between(start, end, length, SHARES)
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert steps.sum() == pytest.approx(length, rel=1e-4)
    assert steps == pytest.approx(np.full(400, length / 400), rel=1e-3)
    assert points[0] == pytest.approx(start)
    assert points[-1] == pytest.approx(end)
    assert points[:, 2] == pytest.approx(np.full(401, -3.0))


def test_a_short_tether_is_a_straight_line_and_a_vertical_one_bends_aside() -> None:
    start, end = np.zeros(3), np.array([0.0, 0.0, -4.0])
    assert arc_between(start, end, 3.0, np.array([0.0, 0.25, 1.0])) == pytest.approx(
        np.array([[0, 0, 0], [0, 0, -1.0], [0, 0, -4.0]])
    )
    points = arc_between(start, end, 5.0, SHARES)
    assert np.abs(points[:, 1]).max() > 1.0
    assert points[:, 0] == pytest.approx(np.zeros(401))


def test_ends_at_one_place_are_a_loop() -> None:
    points = arc_between(np.zeros(3), np.zeros(3), 2.0, SHARES)
    assert np.isfinite(points).all()
    assert np.linalg.norm(points, axis=1).max() > 0.3
