"""The depth of a plug in a socket, and the force between them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.base.geometry import rotation_x
from uwsim.benchmark.measures import Insertion, InsertionSpec

DOWN = rotation_x(math.pi)
"""The rotation of a plug that points down."""


def open_measure(plug: FakeBody) -> tuple[Insertion, FakeWorld]:
    """Return the measure of a plug of 0.1 m over a socket whose mouth is at (2, 0, 0.2)."""
    world = FakeWorld({"plug": plug, "socket": FakeBody((2.0, 0.0, 0.0))}, timestep=0.01)
    spec = InsertionSpec(
        name="depth", plug="plug", tip=(0, 0, 0.1), socket="socket", mouth=(0, 0, 0.2), window=0.02
    )
    measure = spec.bind(world)
    measure.start()
    return measure, world


def test_the_depth_is_that_of_the_tip_below_the_mouth() -> None:
    measure, _ = open_measure(FakeBody((2.0, 0.01, 0.25), rotation=DOWN))
    assert measure.value == pytest.approx(0.05)
    assert measure.details["offset"] == pytest.approx(0.01)
    assert measure.details["tilt"] == pytest.approx(0.0, abs=1e-6)


def test_a_plug_beside_the_socket_has_no_depth() -> None:
    measure, _ = open_measure(FakeBody((2.0, 0.04, 0.1), rotation=DOWN))
    assert measure.value == 0.0


def test_the_tilt_is_the_angle_between_the_axes() -> None:
    measure, _ = open_measure(FakeBody((2.0, 0.0, 0.25), rotation=rotation_x(math.pi - 0.3)))
    assert measure.details["tilt"] == pytest.approx(0.3)


def test_the_greatest_depth_and_the_peak_of_the_mean_force_remain() -> None:
    plug = FakeBody((2.0, 0.0, 0.25), rotation=DOWN)
    measure, world = open_measure(plug)
    world.forces_by_body["socket"] = {"a": np.array([30.0, 0, 0]), "b": np.array([0, 40.0, 0])}
    world.advance()
    measure.update()
    assert measure.details["force"] == pytest.approx(25.0)  # of two steps, one without contact
    world.forces_by_body["socket"] = {}
    plug.move(2.0, 0.0, 0.4)
    for _ in range(2):
        world.advance()
        measure.update()
    assert measure.value == 0.0
    details = measure.details
    assert details["greatest"] == pytest.approx(0.05)
    assert (details["force"], details["peak_force"]) == (0.0, pytest.approx(25.0))
    assert details["contact_share"] == pytest.approx(0.25)
