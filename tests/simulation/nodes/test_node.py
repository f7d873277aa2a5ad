import math

import numpy as np
import pytest

from uwsim.bus import Bus
from uwsim.errors import BadSetting, UnknownName
from uwsim.messages import Empty, EmptyResponse, Float32MultiArray, String
from uwsim.simulation import InProcessNode


def make_node(bus: Bus, **parameters: float | str) -> InProcessNode:
    return InProcessNode(
        bus,
        name="me",
        timestep=0.002,
        rng=np.random.Generator(np.random.Philox(1)),
        parameters=parameters,
    )


def test_what_a_callback_publishes_arrives_in_the_same_step() -> None:
    bus = Bus()
    node = make_node(bus)
    answer = node.publisher("answer", String)
    node.subscribe("question", String, lambda m: answer(String(data=m.data + "!")))
    inbox = bus.inbox("answer", String)
    bus.publisher("question", String)(String(data="here"))
    bus.deliver()
    assert [m.data for m in inbox.take()] == ["here!"]


def test_latency_delays_all_that_an_algorithm_publishes() -> None:
    bus = Bus()
    publish = make_node(bus, latency_s=0.01).publisher("answer", String)
    inbox = bus.inbox("answer", String)
    publish(String(data="late"))
    arrived = []
    for step in range(8):
        bus.step = step
        bus.deliver()
        arrived += [step for _ in inbox.take()]
    assert arrived == [5]


def test_an_exception_of_the_algorithm_is_kept_and_it_is_not_called_again() -> None:
    bus = Bus()
    node = make_node(bus)
    calls = []

    def fail(message: String) -> None:
        calls.append(message)
        raise ValueError("no image")

    node.subscribe("question", String, fail)
    for _ in range(2):
        bus.publisher("question", String)(String(data="?"))
        bus.deliver()
    assert node.error is not None
    assert node.error.endswith(": ValueError: no image")
    assert len(calls) == 1


def test_a_timer_fires_once_a_period_from_the_step_it_was_set() -> None:
    bus = Bus()
    node = make_node(bus)
    fired = []
    bus.step = 3
    node.create_timer(0.01, lambda: fired.append(bus.step))
    for step in range(3, 20):
        bus.step = step
        node.tick()
    assert fired == [3, 8, 13, 18]


@pytest.mark.parametrize("period", [0.0, -1.0, math.inf, math.nan])
def test_a_period_that_is_no_time_is_refused(period: float) -> None:
    with pytest.raises(BadSetting, match="timer's period"):
        make_node(Bus()).create_timer(period, lambda: None)


def test_services_of_a_closed_node_are_gone() -> None:
    bus = Bus()
    node = make_node(bus)
    node.serve("autoInit", Empty, lambda request: EmptyResponse())
    assert bus.services.is_offered("/autoInit")
    node.close()
    with pytest.raises(UnknownName):
        bus.services.call("autoInit", Empty())


@pytest.mark.parametrize("latency", [-1.0, "soon"])
def test_a_latency_that_is_no_time_is_refused(latency: float | str) -> None:
    with pytest.raises(BadSetting, match="latency_s"):
        make_node(Bus(), latency_s=latency)


def test_topics_that_have_no_other_end_are_reported_with_the_nearest_that_has() -> None:
    bus = Bus()
    node = make_node(bus)
    bus.inbox("twist", String)
    bus.publisher("odom", String)
    node.publisher("/twist", String)
    node.subscribe("odom", String, lambda _: None)
    assert node.describe_unconnected_topics() == []
    node.publisher("/twst", String)
    node.subscribe("odm", String, lambda _: None)
    assert node.describe_unconnected_topics() == [
        "me: it subscribes to 'odm', but it has no publisher. Did you mean 'odom'?",
        "me: it publishes on '/twst', but it has no subscriber. Did you mean 'twist'?",
    ]
    assert node.describe_unpublished_topics() == node.describe_unconnected_topics()[:1]


def test_a_topic_unlike_all_others_is_reported_with_those_of_its_type() -> None:
    bus = Bus()
    node = make_node(bus)
    bus.publisher("/front", String)
    bus.publisher("/other", Float32MultiArray)
    node.subscribe("camera1", String, lambda _: None)
    assert node.describe_unpublished_topics() == [
        "me: it subscribes to 'camera1', but it has no publisher. Topics of its type: 'front'."
    ]
