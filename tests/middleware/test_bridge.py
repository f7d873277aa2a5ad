"""What transports share: demand, the way in, the way out, services, bounds."""

from __future__ import annotations

import threading
from collections.abc import Mapping

import numpy as np
import pytest

from uwsim.bus import Bus, TopicEndpoints
from uwsim.errors import UnknownName, UwsimError
from uwsim.messages import EmptyResponse, Float64, String, Twist
from uwsim.messages.services import EMPTY_SERVICE, Empty, Service
from uwsim.middleware.bridge import Bridge
from uwsim.middleware.log import MAX_KINDS, MAX_LINES_OF_A_KIND, Log
from uwsim.middleware.queues import LatestQueue


class FakeBridge(Bridge):
    """A transport that keeps what it is given."""

    def __init__(self, bus: Bus) -> None:
        self.lines: list[str] = []
        super().__init__(bus, lambda: bus.step * 0.002, Log("test", self.lines.append))
        self.topics: dict[str, TopicEndpoints] = {}
        self.services: dict[str, Service] = {}
        self.sent_messages: list[tuple[str, object]] = []

    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        self.topics = dict(topics)

    def on_services(self, services: Mapping[str, Service]) -> None:
        self.services = dict(services)

    def send(self, topic: str, message: object) -> None:
        self.sent_messages.append((topic, message))


@pytest.fixture
def bus() -> Bus:
    return Bus()


@pytest.fixture
def bridge(bus: Bus) -> FakeBridge:
    return FakeBridge(bus)


def test_topics_are_followed_as_they_come(bus: Bus, bridge: FakeBridge) -> None:
    bus.subscribe("cmd", Twist, print)
    bridge.step()
    assert bridge.topics == {"cmd": TopicEndpoints(Twist, is_published=False, is_read=True)}
    bus.publisher("depth", Float64)
    bus.publisher("cmd", Twist)
    bridge.step()
    assert bridge.topics["depth"] == TopicEndpoints(Float64, is_published=True, is_read=False)
    assert bridge.topics["cmd"].is_published


def test_a_message_is_sent_only_while_somebody_reads(bus: Bus, bridge: FakeBridge) -> None:
    publish = bus.publisher("depth", Float64)
    publish(Float64(data=1.0))
    bridge.step()
    bridge.subscribers.add("/depth")
    assert not bus.has_subscribers("depth")
    bridge.step()
    assert bus.has_subscribers("depth")
    publish(Float64(data=2.0))
    bus.deliver()
    bridge.subscribers.add("depth")
    bridge.subscribers.remove("depth")
    bridge.step()
    publish(Float64(data=3.0))
    bus.deliver()
    bridge.subscribers.remove("depth")
    bridge.step()
    assert not bus.has_subscribers("depth")
    assert bridge.sent_messages == [("depth", Float64(data=2.0)), ("depth", Float64(data=3.0))]


def test_its_own_ends_are_not_the_buses(bus: Bus, bridge: FakeBridge) -> None:
    bus.subscribe("cmd", Twist, print)
    bridge.put("cmd", Twist())
    bridge.subscribers.add("cmd")
    bridge.step()
    bridge.step()
    assert bridge.topics == {"cmd": TopicEndpoints(Twist, is_published=False, is_read=True)}


def test_messages_come_in_at_the_step_by_topic_and_in_their_order(
    bus: Bus, bridge: FakeBridge
) -> None:
    actual: list[object] = []
    for topic in ("b", "a"):
        bus.subscribe(topic, Float64, lambda message, topic=topic: actual.append((topic, message)))
    for i in range(2):
        bridge.put("/b", Float64(data=float(i)))
        bridge.put("/a", Float64(data=float(i)))
    assert actual == []
    bridge.step()
    assert [(topic, message.data) for topic, message in actual] == [  # type: ignore[attr-defined]
        *(("a", 0.0), ("a", 1.0)),
        *(("b", 0.0), ("b", 1.0)),
    ]


def test_a_message_from_outside_is_sent_to_other_bridges_only(bus: Bus, bridge: FakeBridge) -> None:
    other = FakeBridge(bus)
    for entry in (bridge, other):
        entry.subscribers.add("cmd")
        entry.step()
    bridge.put("cmd", Twist())
    bridge.step()
    assert bridge.sent_messages == []
    assert other.sent_messages == [("cmd", Twist())]


def test_a_message_of_the_wrong_type_is_reported(bus: Bus, bridge: FakeBridge) -> None:
    bus.subscribe("cmd", Twist, print)
    bridge.put("cmd", Float64())
    bridge.step()
    assert "'cmd' carries geometry_msgs/msg/Twist, not std_msgs/msg/Float64" in bridge.lines[0]


def test_a_flood_drops_the_oldest_and_is_reported_few_times(bus: Bus, bridge: FakeBridge) -> None:
    actual: list[float] = []
    bus.subscribe("cmd", Float64, lambda message: actual.append(message.data))
    for i in range(100_000):
        bridge.put("cmd", Float64(data=float(i)))
    bridge.step()
    assert actual == [float(i) for i in range(99_000, 100_000)]
    assert len(bridge.lines) == MAX_LINES_OF_A_KIND + 1
    assert "dropped" in bridge.lines[0]
    assert "not shown" in bridge.lines[-1]


def test_a_log_of_too_many_kinds_says_so_once_and_keeps_those_it_knows() -> None:
    lines: list[str] = []
    log = Log("test", lines.append)
    for i in range(MAX_KINDS + 10):
        log.report(f"event {i}")
    log.report("event 0")
    assert len(lines) == MAX_KINDS + 2
    assert lines[-2:] == [
        f"uwsim: test: more than {MAX_KINDS} kinds of events; others are not shown",
        "uwsim: test: event 0",
    ]


def test_a_service_is_answered_at_the_step(bus: Bus, bridge: FakeBridge) -> None:
    calls: list[object] = []

    def answer(request: Empty) -> EmptyResponse:
        calls.append(threading.get_ident())
        return EmptyResponse()

    bus.services.serve("dynamics/reset", Empty, answer)
    bridge.step()
    assert bridge.services == {"dynamics/reset": EMPTY_SERVICE}
    future = bridge.request("/dynamics/reset", Empty())
    assert not future.done()
    bridge.step()
    assert future.result(timeout=60) == EmptyResponse()
    assert calls == [threading.get_ident()]


def test_a_service_that_is_not_there_is_an_error_of_the_caller(bridge: FakeBridge) -> None:
    future = bridge.request("reset", Empty())
    bridge.step()
    assert isinstance(future.exception(timeout=60), UnknownName)


def test_calls_fail_when_the_simulation_ends(bridge: FakeBridge) -> None:
    waiting = bridge.request("reset", Empty())
    bridge.close()
    for future in (waiting, bridge.request("reset", Empty())):
        assert isinstance(future.exception(timeout=60), UwsimError)


def test_a_withheld_topic_is_not_shown(bus: Bus, bridge: FakeBridge) -> None:
    publish = bus.publisher("truth", String)
    bus.hide_topic("truth")
    bridge.subscribers.add("truth")
    bridge.step()
    publish(String(data="secret"))
    bus.deliver()
    assert bridge.topics == {}
    assert bridge.sent_messages == []


def test_a_topic_that_a_track_withholds_is_named_once(bus: Bus, bridge: FakeBridge) -> None:
    bus.publisher("rov/odom", String)
    bus.publisher("truth", String)
    bus.hide_topic("rov/odom", "(PATToROSOdom) is not in track 'a'")
    bus.hide_topic("truth")
    bridge.step()
    bus.publisher("depth", Float64)
    bridge.step()
    assert list(bridge.topics) == ["depth"]
    assert bridge.lines == [
        "uwsim: test: /rov/odom is not sent: it (PATToROSOdom) is not in track 'a'"
    ]


def test_a_service_elsewhere_is_called_when_it_is_not_here(bus: Bus) -> None:
    stop = bus.services.add_external_services(
        lambda name: name == "vision/init", lambda name, request: name
    )
    assert bus.services.is_offered("/vision/init")
    assert bus.services.call("/vision/init", Empty()) == "vision/init"
    stop()
    assert not bus.services.is_offered("/vision/init")
    with pytest.raises(UnknownName):
        bus.services.call("vision/init", Empty())


def test_a_queue_keeps_the_newest_within_its_bytes() -> None:
    queue: LatestQueue[str] = LatestQueue(max_items=10, max_bytes=100)
    assert queue.put("a", 60) == 0
    assert queue.put("b", 60) == 1
    assert queue.put("c", 1000) == 1
    assert (queue.take(), queue.n_dropped) == (["c"], 2)


def test_a_queue_that_is_closed_releases_who_waits() -> None:
    queue: LatestQueue[int] = LatestQueue()
    actual: list[int | None] = []
    thread = threading.Thread(target=lambda: actual.append(queue.get()))
    thread.start()
    queue.close()
    thread.join(timeout=60)
    assert actual == [None]
    assert queue.put(1) == 0


def test_images_are_bounded_by_their_bytes(bus: Bus, bridge: FakeBridge) -> None:
    from uwsim.messages import Image

    actual: list[object] = []
    bus.subscribe("image", Image, actual.append)
    pixels = np.zeros(2**20, np.uint8)
    for _ in range(200):
        bridge.put("image", Image(data=pixels))
    bridge.step()
    assert 50 <= len(actual) <= 64
