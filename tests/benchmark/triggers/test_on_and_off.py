"""Triggers: what switches a benchmark and its measures."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.base.geometry import Pose, rotation_from_xyz, rotation_z
from uwsim.benchmark.triggers import (
    NeverSpec,
    OnInitSpec,
    OnMoveSpec,
    OnNoMoveSpec,
    PositionSpec,
    ServiceSpec,
    TopicSpec,
)
from uwsim.errors import UnknownName
from uwsim.messages import Bool, Empty, EmptyResponse, String, floats, header

LEGACY = frozenset({"thresholds"})


def test_on_init_is_on_and_never_is_off() -> None:
    world = FakeWorld()
    init, never = OnInitSpec().bind(world), NeverSpec().bind(world)
    assert init.is_on()
    assert not never.is_on()
    assert init.is_constant
    assert never.is_constant
    assert not TopicSpec(target="t").bind(world).is_constant


def test_a_service_trigger_goes_on_with_the_call_and_stays_on() -> None:
    world = FakeWorld()
    trigger = ServiceSpec(target="startBench").bind(world)
    world.advance()
    assert not trigger.is_on()
    assert world.bus.services.call("/startBench", Empty()) == EmptyResponse()
    assert trigger.is_on()
    world.advance(100)
    assert trigger.is_on()


def test_a_closed_service_trigger_withdraws_its_service() -> None:
    world = FakeWorld()
    trigger = ServiceSpec(target="startBench").bind(world)
    assert world.bus.services.is_offered("startBench")
    trigger.close()
    assert not world.bus.services.is_offered("startBench")
    trigger.close()


def test_one_call_reaches_every_trigger_of_that_service() -> None:
    world = FakeWorld()
    first = ServiceSpec(target="stopTask").bind(world)
    second = ServiceSpec(target="stopTask").bind(world)
    first.close()
    third = ServiceSpec(target="stopTask").bind(world)
    world.bus.services.call("stopTask", Empty())
    assert (first.is_on(), second.is_on(), third.is_on()) == (False, True, True)


def test_a_service_trigger_of_the_next_level_has_not_been_called() -> None:
    world = FakeWorld()
    before = ServiceSpec(target="stopTask").bind(world)
    world.bus.services.call("stopTask", Empty())
    before.close()
    assert not ServiceSpec(target="stopTask").bind(world).is_on()


def test_a_topic_trigger_has_the_state_of_the_last_message() -> None:
    world = FakeWorld()
    publish = world.bus.publisher("ready", Bool)
    trigger = TopicSpec(target=" /ready").bind(world)
    assert not trigger.is_on()
    for said, expected in (((True,), True), ((), True), ((True, False), False), ((True,), True)):
        for value in said:
            publish(Bool(data=value))
        world.advance()
        assert trigger.is_on() is expected


@pytest.mark.parametrize("message", [floats([0.0]), String(data=""), header(0.0)])
def test_any_message_that_is_no_bool_sets_a_topic_trigger_on(message: object) -> None:
    world = FakeWorld()
    trigger = TopicSpec(target="goal").bind(world)
    publish = world.bus.publisher("goal", type(message))
    world.advance()
    assert not trigger.is_on()
    publish(message)
    world.advance()
    assert trigger.is_on()
    world.advance()
    assert trigger.is_on()


def test_a_topic_trigger_lets_the_publisher_choose_the_type() -> None:
    world = FakeWorld()
    world.bus.publisher("goal", String)
    trigger = TopicSpec(target="goal").bind(world)
    assert world.bus.topics == {"goal": "std_msgs/msg/String"}
    trigger.close()
    assert not world.bus.has_subscribers("goal")


def test_a_closed_topic_trigger_hears_nothing_more() -> None:
    world = FakeWorld()
    trigger = TopicSpec(target="ready").bind(world)
    trigger.close()
    assert not world.bus.has_subscribers("ready")
    trigger.close()


@pytest.mark.parametrize(("compat", "distance"), [(frozenset(), 0.2), (LEGACY, 0.2**0.5)])
def test_on_move_goes_on_beyond_its_distance_and_stays_on(
    compat: frozenset[str], distance: float
) -> None:
    body = FakeBody((1.0, 2.0, 3.0))
    world = FakeWorld({"girona500": body}, compatibility=compat)
    trigger = OnMoveSpec(target="girona500").bind(world)
    body.move(1.0, 2.0, 3.0 - distance * 0.999)
    assert not trigger.is_on()
    body.move(1.0, 2.0, 3.0 - distance * 1.001)
    assert trigger.is_on()
    body.move(1.0, 2.0, 3.0)
    assert trigger.is_on()


def test_turning_is_not_moving() -> None:
    body = FakeBody()
    trigger = OnMoveSpec(target="b").bind(FakeWorld({"b": body}))
    body.turn(rotation_from_xyz(0.3, 1.0, -2.0))
    assert not trigger.is_on()


def steps_until_on(world: FakeWorld, trigger: object, limit: int) -> int:
    for step in range(limit):
        if trigger.is_on():  # type: ignore[attr-defined]
            return step
        world.advance()
    raise AssertionError("never on")


def test_on_no_move_goes_on_one_step_after_four_seconds_of_rest() -> None:
    world = FakeWorld({"b": FakeBody()}, timestep=0.01)
    trigger = OnNoMoveSpec(target="b").bind(world)
    assert steps_until_on(world, trigger, 1000) == 401


def test_on_no_move_counts_from_the_last_place_that_is_far_from_here() -> None:
    body = FakeBody()
    world = FakeWorld({"b": body}, timestep=0.01)
    trigger = OnNoMoveSpec(target="b").bind(world)
    for _ in range(1000):
        body.move(0.1 * world.time, 0.0, 0.0)  # 0.4 m in 4 s: never 4 s within 0.2 m
        assert not trigger.is_on()
        world.advance()
    rest = steps_until_on(world, trigger, 1000)
    assert 200 <= rest <= 260  # the places of the last 2 s lie within 0.2 m, seen every 0.4 s
    body.move(50.0, 0.0, 0.0)
    assert trigger.is_on()


def test_the_originals_on_no_move_lets_a_body_drift_further() -> None:
    body = FakeBody()
    world = FakeWorld({"b": body}, timestep=0.01, compatibility=LEGACY)
    trigger = OnNoMoveSpec(target="b").bind(world)
    for _ in range(402):
        body.move(0.1 * world.time, 0.0, 0.0)  # 0.4 m in 4 s: less than 0.447 m
        world.advance()
        on = trigger.is_on()
    assert on


@pytest.mark.parametrize(("compat", "distance"), [(frozenset(), 0.3), (LEGACY, 0.3**0.5)])
def test_position_goes_on_near_its_place_and_stays_on(
    compat: frozenset[str], distance: float
) -> None:
    body = FakeBody((0.0, 0.0, 0.0))
    world = FakeWorld({"b": body}, compatibility=compat)
    trigger = PositionSpec(target="b", position=(1.0, 0.0, 0.0)).bind(world)
    body.move(1.0 - distance * 1.001, 0.0, 0.0)
    assert not trigger.is_on()
    body.move(1.0 - distance * 0.999, 0.0, 0.0)
    assert trigger.is_on()
    body.move(9.0, 0.0, 0.0)
    assert trigger.is_on()


def test_the_place_of_a_position_trigger_is_given_in_the_frame_of_files() -> None:
    world_from_localized = Pose(np.array([0.0, 0.0, 1.0]), rotation_z(np.pi / 2))
    body = FakeBody((-3.0, 2.0, 5.0))  # W = (-L.y, L.x, 1 + L.z)
    world = FakeWorld({"b": body}, world_from_localized=world_from_localized)
    assert PositionSpec(target="b", position=(2.0, 3.0, 4.0)).bind(world).is_on()
    assert not PositionSpec(target="b", position=(-3.0, 2.0, 5.0)).bind(world).is_on()


@pytest.mark.parametrize(
    "spec",
    [
        OnMoveSpec(target="girona50"),
        OnNoMoveSpec(target="girona50"),
        PositionSpec(target="girona50", position=(0.0, 0.0, 0.0)),
    ],
)
def test_a_misspelt_target_is_an_error_that_names_the_right_one(spec: OnMoveSpec) -> None:
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        spec.bind(FakeWorld({"girona500": FakeBody()}))


def test_a_trigger_names_itself_as_the_file_does() -> None:
    assert str(ServiceSpec(target="startBench")) == "service 'startBench'"
    assert str(OnInitSpec()) == "onInit"
