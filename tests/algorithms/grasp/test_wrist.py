"""The force on the wrist says whether something hangs in the jaw."""

from __future__ import annotations

import pytest

from uwsim.algorithms.grasp.vehicle_interface import Wrist
from uwsim.messages import Vector3, Wrench, WrenchStamped


def pull(force: float) -> WrenchStamped:
    return WrenchStamped(wrench=Wrench(force=Vector3(x=force, y=1.0, z=-2.0)))


def test_without_a_sensor_the_load_is_not_known() -> None:
    one = Wrist()
    one.tare()
    assert one.load is None


def test_the_load_is_the_force_since_the_tare_smoothed_over_samples() -> None:
    one = Wrist()
    one.on_wrist(pull(30.0))
    one.tare()
    assert one.load == pytest.approx(0.0)
    one.on_wrist(pull(82.0))
    assert one.load == pytest.approx(5.2)  # a tenth of 52 N
    for _ in range(100):
        one.on_wrist(pull(82.0))
    assert one.load == pytest.approx(52.0, rel=1e-3)
