"""Position error, in the frame of files."""

from __future__ import annotations

import math

import numpy as np
import pytest

from fakes import FakeBody, FakeWorld
from uwsim.benchmark.measures import PositionErrorSpec
from uwsim.geometry import Pose, rotation_z
from uwsim.messages import Point, PoseStamped, Quaternion, header
from uwsim.messages import Pose as PoseMessage

WORLD_FROM_LOCALIZED = Pose(np.array([0.0, 0.0, 1.0]), rotation_z(math.pi / 2))
"""W = (-L.y, L.x, 1 + L.z)."""


def stamped(x: float, y: float, z: float) -> PoseStamped:
    turn = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    return PoseStamped(
        header=header(0.0), pose=PoseMessage(position=Point(x=x, y=y, z=z), orientation=turn)
    )


def test_error_and_components_are_given_in_the_frame_of_files() -> None:
    body = FakeBody((-3.0, 2.0, 5.0))  # L (2, 3, 4)
    world = FakeWorld({"v": body}, world_from_localized=WORLD_FROM_LOCALIZED)
    error = PositionErrorSpec(name="e", target="v", position=(1.0, 5.0, 2.0)).bind(world)
    error.start()
    assert error.value == pytest.approx(3.0)
    assert error.log_header == ("total", "x", "y", "z", "rx", "ry", "rz", "rw")
    assert error.log_values[:4] == pytest.approx((3.0, 1.0, -2.0, 2.0))


def test_the_attitude_is_that_in_the_frame_of_files() -> None:
    body = FakeBody(rotation=WORLD_FROM_LOCALIZED.rotation @ rotation_z(math.pi / 2))
    world = FakeWorld({"v": body}, world_from_localized=WORLD_FROM_LOCALIZED)
    error = PositionErrorSpec(name="e", target="v", position=(0.0, 0.0, 0.0)).bind(world)
    error.start()
    half = math.sqrt(0.5)
    assert error.log_values[4:] == pytest.approx((0.0, 0.0, half, half))
    assert error.details["rw"] == pytest.approx(half)


def test_every_step_is_a_sample() -> None:
    body = FakeBody()
    world = FakeWorld({"v": body})
    error = PositionErrorSpec(name="e", target="v", position=(0.0, 0.0, 0.0), value="mean").bind(
        world
    )
    assert (error.value, error.why) == (None, "it was never on")
    error.start()
    for place in (3.0, -6.0):
        body.move(place, 0.0, 0.0)
        world.advance()
        error.update()
    assert error.value == 3.0
    assert error.details["x.mean"] == -1.0


def test_with_a_topic_its_first_message_says_where_the_body_should_be() -> None:
    world = FakeWorld({"v": FakeBody((-3.0, 2.0, 5.0))}, world_from_localized=WORLD_FROM_LOCALIZED)
    error = PositionErrorSpec(name="e", target="v", position=(0.0, 0.0, 0.0), topic="goal").bind(
        world
    )
    error.start()
    assert (error.value, error.why) == (None, "no position on 'goal'")
    publish = world.publisher("goal", PoseStamped)
    publish(stamped(2.0, 3.0, 9.0))
    publish(stamped(0.0, 0.0, 0.0))
    for _ in range(2):
        world.advance()
        error.update()
        publish(stamped(1.0, 1.0, 1.0))
        assert error.value == pytest.approx(5.0)
    error.close()
    assert not world.bus.has_readers("goal")
