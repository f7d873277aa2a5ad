"""Position error, in the frame of files."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.base.geometry import Pose, rotation_z
from uwsim.benchmark.measures import PositionErrorSpec
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
    assert (error.value, error.missing_reason) == (None, "it was never on")
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
    assert (error.value, error.missing_reason) == (None, "no position on 'goal'")
    publish = world.bus.publisher("goal", PoseStamped)
    publish(stamped(2.0, 3.0, 9.0))
    publish(stamped(0.0, 0.0, 0.0))
    for _ in range(2):
        world.advance()
        error.update()
        publish(stamped(1.0, 1.0, 1.0))
        assert error.value == pytest.approx(5.0)
    error.close()
    world.bus.deliver()
    assert error.value == pytest.approx(5.0)


def test_a_goal_that_was_published_before_the_level_began_counts() -> None:
    world = FakeWorld({"v": FakeBody((1.0, 0.0, 0.0))})
    spec = PositionErrorSpec(name="e", target="v", position=(0.0, 0.0, 0.0), topic="goal")
    spec.bind(world).close()  # every name is looked up before the algorithm starts
    for x in (9.0, 4.0):
        world.bus.publisher("goal", PoseStamped)(stamped(x, 0.0, 0.0))
        world.advance()
    error = spec.bind(world)
    error.start()
    assert error.value == pytest.approx(3.0)


def test_the_newest_goal_counts_if_several_arrived_before_the_measure_starts() -> None:
    world = FakeWorld({"v": FakeBody((1.0, 0.0, 0.0))})
    error = PositionErrorSpec(name="e", target="v", position=(0.0, 0.0, 0.0), topic="goal").bind(
        world
    )
    for x in (9.0, 4.0):
        world.bus.publisher("goal", PoseStamped)(stamped(x, 0.0, 0.0))
        world.advance()
    error.start()
    assert error.value == pytest.approx(3.0)


def test_the_original_measures_in_the_world_and_takes_the_topic_to_be_in_it() -> None:
    original = frozenset({"position-frame"})
    world = FakeWorld(
        {"v": FakeBody((-3.0, 2.0, 5.0))},  # L (2, 3, 4)
        world_from_localized=WORLD_FROM_LOCALIZED,
        compatibility=original,
    )
    error = PositionErrorSpec(name="e", target="v", position=(1.0, 5.0, 2.0)).bind(world)
    error.start()
    assert error.value == pytest.approx(3.0)
    assert error.log_values[:4] == pytest.approx((3.0, 2.0, 1.0, 2.0))
    told = PositionErrorSpec(name="e", target="v", position=(0.0, 0.0, 0.0), topic="goal").bind(
        world
    )
    world.bus.publisher("goal", PoseStamped)(stamped(-3.0, 2.0, 1.0))
    world.advance()
    told.start()
    assert told.value == pytest.approx(4.0)


def test_the_original_starts_at_100_and_is_minus_1_until_it_receives_the_target() -> None:
    for quirks, values in (
        (frozenset[str](), [None, None, None, 3.0]),
        (frozenset({"position-start"}), [100.0, 100.0, -1.0, 3.0]),
    ):
        world = FakeWorld({"v": FakeBody((4.0, 0.0, 0.0))}, compatibility=quirks)
        error = PositionErrorSpec(name="e", target="v", position=(0.0, 0.0, 0.0), topic="g").bind(
            world
        )
        seen = [error.value]
        error.start()
        seen.append(error.value)
        assert error.log_values[0] == error.value
        for said in (False, True):
            if said:
                world.bus.publisher("g", PoseStamped)(stamped(1.0, 0.0, 0.0))
            world.advance()
            error.update()
            seen.append(error.value)
        assert seen == values
        assert (error.missing_reason is None) == (error.value is not None)


def test_the_originals_first_sample_is_taken_a_step_later() -> None:
    world = FakeWorld({"v": FakeBody()}, compatibility=frozenset({"position-start"}))
    error = PositionErrorSpec(name="e", target="v", position=(3.0, 0.0, 0.0)).bind(world)
    error.start()
    assert (error.value, error.log_values[0]) == (100.0, 100.0)
    error.update()
    assert (error.value, error.log_values[0]) == (3.0, 3.0)
