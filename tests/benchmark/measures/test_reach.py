"""The measure of a point that is to be reached and held."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.base.geometry import rotation_z
from uwsim.benchmark.measures import Reach, ReachSpec


def open_reach(tool: FakeBody) -> tuple[Reach, FakeWorld]:
    """Return the measure of a point 1 m ahead of a body at (3, 0, 0) that is turned to +y."""
    box = FakeBody((3.0, 0.0, 0.0), rotation=rotation_z(math.pi / 2))
    world = FakeWorld({"tool": tool, "box": box})
    spec = ReachSpec(
        name="r", from_="tool", to="box", to_point=(1.0, 0.0, 0.0), tolerance=0.1, hold=1.0
    )
    return spec.bind(world), world


def advance(measure: Reach, world: FakeWorld, time: float) -> None:
    """Take the steps of a time [s]."""
    for _ in range(round(time / world.timestep)):
        world.advance()
        measure.update()


def test_the_distance_is_that_of_the_points_of_both_bodies() -> None:
    measure, _ = open_reach(FakeBody((3.0, 0.0, 2.0)))
    assert measure.value is None
    measure.start()
    assert measure.log_values == (0.0, pytest.approx(math.sqrt(5.0)))


def test_a_tool_that_leaves_the_tolerance_has_to_hold_anew() -> None:
    tool = FakeBody((3.0, 1.05, 0.0))
    measure, world = open_reach(tool)
    measure.start()
    advance(measure, world, 0.6)
    tool.move(3.0, 1.2, 0.0)
    advance(measure, world, 0.2)
    tool.move(3.0, 1.0, 0.0)
    advance(measure, world, 0.9)
    assert measure.ends_level is None
    assert measure.task_status[0] == "timeout"
    advance(measure, world, 0.4)
    assert (measure.value, measure.task_status) == (1.0, ("ok", None))
    assert measure.ends_level is not None
    assert measure.details["time_done"] == pytest.approx(1.8, abs=2.1 * world.timestep)
    assert measure.details["time_reached"] == 0.0
    assert measure.details["least_distance"] == 0.0


def test_a_tool_that_never_arrives_has_reasons() -> None:
    measure, world = open_reach(FakeBody())
    measure.start()
    advance(measure, world, 0.3)
    assert measure.value == 0.0
    assert set(measure.reasons) == {"time_reached", "time_done"}
    assert np.isclose(measure.details["mean_distance"] or 0.0, math.sqrt(10.0))
