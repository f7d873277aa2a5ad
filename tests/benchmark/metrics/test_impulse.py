"""The largest impulse within a short time."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.benchmark.metrics.impulse import Impulse

UP = np.array([0.0, 0.0, 1.0])


def test_a_hit_has_its_whole_impulse_whatever_the_step() -> None:
    for timestep in (0.001, 0.002, 0.01):
        impulse = Impulse(timestep)
        for _ in range(round(0.02 / timestep)):
            impulse.add(150.0 * UP)
        for _ in range(100):
            impulse.add(None)
        assert impulse.peak == pytest.approx(3.0)


def test_a_lasting_force_counts_for_the_window_only() -> None:
    impulse = Impulse(0.002)
    for _ in range(5000):
        impulse.add(52.0 * UP)
    assert impulse.peak == pytest.approx(2.6)


def test_two_hits_that_are_far_apart_do_not_add() -> None:
    impulse = Impulse(0.002)
    for gap in (10, 40):
        impulse.add(1000.0 * UP)
        for _ in range(gap):
            impulse.add(None)
        impulse.add(1000.0 * UP)
        for _ in range(100):
            impulse.add(None)
    assert impulse.peak == pytest.approx(4.0)  # the first two, 22 ms apart


def test_opposite_forces_cancel() -> None:
    impulse = Impulse(0.002)
    impulse.add(UP - UP)
    assert impulse.peak == 0.0
