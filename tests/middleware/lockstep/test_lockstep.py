"""Lock-step with clients outside: who is waited for, what is applied when, and who is lost."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from uwsim.bus import Bus, TopicEndpoints
from uwsim.errors import BadSetting, ClientLost, NeverStarted
from uwsim.messages import Float64, GTpublish, GTpublishResponse, String
from uwsim.messages.services import Service
from uwsim.middleware.bridge import Bridge, TransportTraits
from uwsim.middleware.lockstep.client import (
    MAX_LENGTH,
    MAX_WAITING,
    LockStepClient,
    lockstep_clients,
)
from uwsim.middleware.lockstep.topics import ACK, JOIN, TICK
from uwsim.middleware.log import Log
from uwsim.simulation import InProcessNode

TIMESTEP = 0.1
Answer = Callable[["FakeBridge", dict[str, Any]], None]


class FakeBridge(Bridge):
    """A transport whose clients answer ticks as they are sent."""

    def __init__(self, bus: Bus, answer: Answer) -> None:
        self.lines: list[str] = []
        super().__init__(bus, lambda: bus.step * TIMESTEP, Log("test", self.lines.append))
        self.answer = answer
        self.ticks: list[dict[str, Any]] = []
        self.errors: list[str] = []
        self.reports: list[tuple[str, str]] = []

    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        pass

    def on_services(self, services: Mapping[str, Service]) -> None:
        pass

    def send(self, topic: str, message: object) -> None:
        if topic == TICK and isinstance(message, String):
            text = json.loads(message.data)
            if "error" in text:
                self.errors.append(text["error"])
                return
            self.ticks.append(text)
            self.answer(self, text)

    def send_text(self, topic: str, *, sender: str = "", **content: Any) -> None:
        self.put(topic, String(data=json.dumps(content)), sender)

    def report_error(self, client_name: str, text: str) -> None:
        self.reports.append((client_name, text))


def echoes(bridge: FakeBridge, tick: dict[str, Any]) -> None:
    """Answer with the time, and acknowledge."""
    bridge.put("answer", Float64(data=tick["time"]))
    bridge.send_text(ACK, client=tick["client"], tick=tick["tick"])


def is_silent(bridge: FakeBridge, tick: dict[str, Any]) -> None:
    """Do nothing."""


def start_clients(
    bus: Bus, bridge: FakeBridge, *names: str, limit: float = 60.0, **join: Any
) -> list[InProcessNode]:
    clients = lockstep_clients([bridge], names, timestep=TIMESTEP, limit=limit)
    for name in names:
        bridge.send_text(JOIN, client=name, topics=["/depth"], **join)
    return [node_of(bus, client) for client in clients]


def node_of(bus: Bus, client: LockStepClient) -> InProcessNode:
    node = InProcessNode(
        bus, name=client.name, timestep=TIMESTEP, rng=np.random.default_rng(0), parameters={}
    )
    node.run(client)
    assert node.error is None
    return node


def step(bus: Bus, nodes: list[InProcessNode]) -> None:
    bus.step += 1
    bus.deliver()
    for node in nodes:
        node.tick()
    bus.deliver()


def test_a_client_is_ticked_in_steps_with_messages_and_answers_in_the_same_step() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, echoes)
    nodes = start_clients(bus, bridge, "a")
    answers = bus.inbox("answer", Float64)
    say = bus.publisher("depth", Float64)
    for n in range(6):
        if n % 3 == 2:
            say(Float64(data=1.0))
            say(Float64(data=2.0))
        step(bus, nodes)
        assert len(answers.take()) == (n % 3 == 2)
    assert [tick["tick"] for tick in bridge.ticks] == [1, 2]
    assert [tick["sent"] for tick in bridge.ticks] == [{"/depth": 2}, {"/depth": 4}]
    assert [tick["time"] for tick in bridge.ticks] == pytest.approx([0.3, 0.6])


def test_a_client_names_when_its_timers_are_due() -> None:
    bus = Bus()

    def every_third(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="a", tick=tick["tick"], next=tick["time"] + 3 * TIMESTEP)

    bridge = FakeBridge(bus, every_third)
    nodes = start_clients(bus, bridge, "a", next=0.2)
    for _ in range(9):
        step(bus, nodes)
    assert [round(tick["time"] / TIMESTEP) for tick in bridge.ticks] == [2, 5, 8]


def test_several_clients_answer_in_the_order_of_their_names() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, echoes)
    nodes = start_clients(bus, bridge, "b", "a")
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert [tick["client"] for tick in bridge.ticks] == ["a", "b"]


@pytest.mark.parametrize("slow_name", ["a", "b"])
def test_answers_of_several_clients_keep_the_order_of_their_names_whoever_is_slow(
    slow_name: str,
) -> None:
    bus = Bus()
    threads = []

    def names_itself(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        def answer() -> None:
            bridge.put("answer", String(data=tick["client"]))
            bridge.send_text(ACK, client=tick["client"], tick=tick["tick"])

        if tick["client"] != slow_name:
            answer()
            return
        threads.append(threading.Thread(target=answer))
        threads[-1].start()

    bridge = FakeBridge(bus, names_itself)
    nodes = start_clients(bus, bridge, "b", "a")
    answers = bus.inbox("answer", String)
    say = bus.publisher("depth", Float64)
    for _ in range(3):
        say(Float64(data=1.0))
        step(bus, nodes)
    assert [message.data for message in answers.take()] == ["a", "b"] * 3
    for thread in threads:
        thread.join()


def test_what_is_published_waits_for_the_ack_and_for_all_that_it_announces() -> None:
    bus = Bus()

    def announces_first(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="a", tick=tick["tick"], published={"/answer": 2})
        for value in (1.0, 2.0):
            bridge.put("answer", Float64(data=value))

    bridge = FakeBridge(bus, announces_first)
    nodes = start_clients(bus, bridge, "a")
    answers = bus.inbox("answer", Float64)
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert [message.data for message in answers.take()] == [1.0, 2.0]


def test_acks_of_other_ticks_and_nonsense_do_not_count() -> None:
    bus = Bus()

    def babbles(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="a", tick=99)
        bridge.send_text(ACK, client="stranger", tick=tick["tick"])
        for text in ("", "[1]", "[" * 100_000, '{"client": {}}'):
            bridge.put(ACK, String(data=text))
        bridge.put(ACK, Float64(data=1.0))
        echoes(bridge, tick)

    bridge = FakeBridge(bus, babbles)
    nodes = start_clients(bus, bridge, "a")
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert len(bridge.ticks) == 1


def test_a_client_offers_a_service_by_the_topics_of_lock_step() -> None:
    bus = Bus()

    def replies(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        if "call" in tick:
            assert tick["args"] == {"groundTruth": [1.5, 0.25]}
            bridge.send_text(ACK, client="a", call=99, values={"nonsense": 1})
            bridge.send_text(
                ACK, client="a", call=tick["call"], values={}, published={"/answer": 1}
            )
            bridge.put("answer", Float64(data=7.0))

    bridge = FakeBridge(bus, replies)
    kind = "underwater_sensor_msgs/srv/GTpublish"
    nodes = start_clients(bus, bridge, "a", services={"/autoInit": kind})
    answers = bus.inbox("answer", Float64)
    truth = np.array([1.5, 0.25], np.float32)
    assert bus.services.call("autoInit", GTpublish(groundTruth=truth)) == GTpublishResponse()
    bridge.step()
    step(bus, nodes)
    assert [message.data for message in answers.take()] == [7.0]


def test_a_service_that_is_not_answered_ends_the_run_and_a_wrong_answer_is_an_error() -> None:
    bus = Bus()
    kind = "underwater_sensor_msgs/srv/GTpublish"
    request = GTpublish(groundTruth=np.zeros(8, np.float32))
    start_clients(bus, FakeBridge(bus, is_silent), "a", limit=0.01, services={"/autoInit": kind})
    with pytest.raises(ClientLost, match=r"'a' did not answer the call of /autoInit within 0.01 s"):
        bus.services.call("autoInit", request)

    def answer_wrongly(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="b", call=tick["call"], values={"nonsense": 1})

    (node,) = start_clients(bus, FakeBridge(bus, answer_wrongly), "b", services={"/other": kind})
    assert bus.services.call("other", request) is None
    assert "Client 'b': service /other: " in str(node.error)


def test_topics_that_a_client_publishes_itself_are_not_waited_for() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, is_silent)
    bridge.traits = TransportTraits(needs_discovery=True)  # type: ignore[misc]
    for topic in (TICK, "depth"):  # what it reads of others
        bridge.subscribers.add(topic)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=60.0)
    own_names = {"/mine": "std_msgs/Float64"}
    bridge.send_text(JOIN, client="a", topics=["/depth", "/mine"], publishes=own_names)
    node_of(bus, client)


def test_a_tick_says_in_which_order_the_messages_came() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, echoes)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=60.0)
    bridge.send_text(JOIN, client="a", topics=["/depth", "/alarm"])
    nodes = [node_of(bus, client)]
    for topic in ("depth", "alarm", "depth"):
        bus.publisher(topic, Float64)(Float64(data=1.0))
    step(bus, nodes)
    bus.publisher("alarm", Float64)(Float64(data=1.0))
    step(bus, nodes)
    orders = [tick["order"] for tick in bridge.ticks]
    assert orders == [["/depth", "/alarm", "/depth"], ["/alarm"]]


def test_a_service_that_nobody_offers_is_reported_and_the_run_goes_on() -> None:
    bus = Bus()

    def calls(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="a", tick=tick["tick"], calls=["startBench"])

    bridge = FakeBridge(bus, calls)
    nodes = start_clients(bus, bridge, "a")
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert any("startBench, but no program offers it" in line for line in bridge.lines)


def test_a_client_that_does_not_answer_ends_the_run() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, is_silent)
    nodes = start_clients(bus, bridge, "a", limit=0.01)
    bus.publisher("depth", Float64)(Float64(data=1.0))
    with pytest.raises(ClientLost, match=r"'a' did not answer the tick at 0.1 s within 0.01 s"):
        step(bus, nodes)


def test_a_client_that_leaves_ends_the_run_at_once() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, lambda bridge, tick: bridge.send_text(JOIN, client="a", left=True))
    nodes = start_clients(bus, bridge, "a")
    bus.publisher("depth", Float64)(Float64(data=1.0))
    with pytest.raises(ClientLost, match="'a' left at"):
        step(bus, nodes)


def test_a_client_that_leaves_without_a_word_ends_the_run_where_that_is_seen() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, lambda bridge, tick: bridge.subscribers.remove(TICK))
    bridge.traits = TransportTraits(detects_leaving=True)  # type: ignore[misc]
    bridge.subscribers.add(TICK)
    kind = "underwater_sensor_msgs/srv/GTpublish"
    nodes = start_clients(bus, bridge, "a", services={"/init": kind})
    bus.publisher("depth", Float64)(Float64(data=1.0))
    with pytest.raises(ClientLost, match=r"'a' left at 0\.1 s"):
        step(bus, nodes)
    with pytest.raises(ClientLost, match="'a' left at"):
        bus.services.call("init", GTpublish(groundTruth=np.zeros(8, np.float32)))


def test_a_program_is_told_from_another_by_its_id_where_the_transport_cannot_tell() -> None:
    bus = Bus()

    def answer(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="a", tick=tick["tick"], id="second", next="soon")
        bridge.send_text(ACK, client="a", tick=tick["tick"], id="first")

    bridge = FakeBridge(bus, answer)
    nodes = start_clients(bus, bridge, "a", id="first")
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert len(bridge.ticks) == 1
    assert "client 'a' is another program already; a second one is ignored" in bridge.lines[0]


def test_a_second_program_that_joined_and_left_before_the_start_changes_nothing() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, echoes)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=60.0)
    bridge.send_text(JOIN, client="a", topics=["/depth"], sender="first")
    bridge.send_text(JOIN, client="a", topics=["/depth"], sender="second")
    bridge.send_text(JOIN, client="a", left=True, sender="second")
    nodes = [node_of(bus, client)]
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert len(bridge.ticks) == 1
    assert bridge.reports == [("second", "client 'a' is first already; second is ignored")]


def test_a_flood_of_joins_and_answers_is_bounded_and_a_huge_one_is_told() -> None:
    bus = Bus()

    def floods(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        for n in range(10_000):
            bridge.send_text(ACK, client="a", tick=n)
        bridge.send_text(ACK, client="a", tick=1, id="x" * MAX_LENGTH)
        assert len(client._acks) <= MAX_WAITING
        bridge.send_text(ACK, client="a", tick=tick["tick"])

    bridge = FakeBridge(bus, floods)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=60.0)
    for _ in range(10_000):
        bridge.send_text(JOIN, client="a", topics=["/depth"])
    assert len(client._joins) <= MAX_WAITING
    nodes = [node_of(bus, client)]
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert any("letters; at most 1048576 are read" in line for line in bridge.lines)


def test_a_program_that_left_before_the_start_gives_way_to_the_next_of_its_name() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, echoes)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=60.0)
    bridge.send_text(JOIN, client="a", topics=["/nothing"], sender="first")
    bridge.send_text(JOIN, client="a", left=True, sender="first")
    bridge.send_text(JOIN, client="a", topics=["/depth"], sender="second")
    nodes = [node_of(bus, client)]
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert len(bridge.ticks) == 1


def test_a_client_that_answers_itself_without_end_is_stopped() -> None:
    bus = Bus()

    def asks_again(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.put("depth", Float64(data=1.0))
        bridge.send_text(ACK, client="a", tick=tick["tick"])

    nodes = start_clients(bus, FakeBridge(bus, asks_again), "a")
    bus.publisher("depth", Float64)(Float64(data=1.0))
    with pytest.raises(ClientLost, match="without end"):
        step(bus, nodes)


TIME = "expected a time >= 0 [s], or null for none"
NAMES = "expected a list of at most 1000 names"
JOINS: dict[str, tuple[dict[str, Any], str]] = {
    "no topics": ({"topics": None}, f"topics is null; {NAMES}"),
    "one topic": ({"topics": "/odom"}, f'topics is "/odom"; {NAMES}'),
    "numbers": ({"topics": [1]}, f"topics is [1]; {NAMES}"),
    "a text": ({"next": "soon"}, f'next is "soon"; {TIME}'),
    "negative": ({"next": -0.1}, f"next is -0.1; {TIME}"),
    "no number": ({"next": float("nan")}, f"next is NaN; {TIME}"),
    "a boolean": ({"next": True}, f"next is true; {TIME}"),
    "a list": (
        {"publishes": ["/cmd"]},
        'publishes is ["/cmd"]; expected an object with a type for each name',
    ),
    "no type": (
        {"publishes": {"/cmd": "geometry_msgs/Twyst"}},
        "publishes, \"/cmd\": No message type is called 'geometry_msgs/Twyst'.",
    ),
    "another type": (
        {"publishes": {"/answer": "std_msgs/Bool"}},
        'publishes, "/answer" is "std_msgs/Bool"; expected std_msgs/msg/Float64',
    ),
    "no service": ({"services": {"/x": "a/b"}}, 'services, "/x": No service type is called'),
}


@pytest.mark.parametrize("case", JOINS)
def test_a_join_that_is_wrong_is_refused_with_the_field_and_the_client_told(case: str) -> None:
    bus = Bus()
    bus.inbox("answer", Float64)
    bridge = FakeBridge(bus, echoes)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=60.0)
    wrong, text = JOINS[case]
    bridge.send_text(JOIN, client="a", **{"topics": ["/depth"], **wrong}, sender="who")
    bridge.send_text(JOIN, client="a", topics=["/depth"])
    nodes = [node_of(bus, client)]
    assert text in bridge.errors[0]
    assert bridge.errors[0].startswith("its join was refused: ")
    assert bridge.reports == [("who", f"client 'a': {bridge.errors[0]}")]
    assert bridge.lines == [f"uwsim: test: client 'a' (who): {bridge.errors[0]}"]
    bus.publisher("depth", Float64)(Float64(data=1.0))
    step(bus, nodes)
    assert len(bridge.ticks) == 1


def test_a_run_whose_client_does_not_join_rightly_says_what_was_wrong() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, is_silent)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=0.05)
    bridge.send_text(JOIN, client="a")
    with pytest.raises(NeverStarted, match="its join was refused: topics is missing; expected a l"):
        node_of(bus, client)


ANSWERS: dict[str, tuple[dict[str, Any], str]] = {
    "no tick": ({"tick": None}, "tick is null; expected the whole number of the tick"),
    "a text": ({"tick": "1"}, 'tick is "1"; expected the whole number of the tick'),
    "a boolean": ({"tick": True}, "tick is true; expected the whole number of the tick"),
    "a next": ({"next": "0.1"}, f'next is "0.1"; {TIME}'),
    "a past": ({"next": -1}, f"next is -1; {TIME}"),
    "a large next": ({"next": [10**400]}, "next is [1000"),
    "counts": (
        {"published": {"/cmd": 1.5}},
        'published is {"/cmd": 1.5}; expected an object with a whole number >= 0 for each topic',
    ),
    "calls": ({"calls": "startBench"}, f'calls is "startBench"; {NAMES}'),
}


@pytest.mark.parametrize("case", ANSWERS)
def test_an_answer_that_is_wrong_ends_the_run_at_once_and_the_client_is_told(case: str) -> None:
    bus = Bus()
    wrong, text = ANSWERS[case]

    def answer(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="a", **{"tick": tick["tick"], **wrong})

    bridge = FakeBridge(bus, answer)
    nodes = start_clients(bus, bridge, "a")
    bus.publisher("depth", Float64)(Float64(data=1.0))
    with pytest.raises(ClientLost) as excinfo:
        step(bus, nodes)
    assert f"Client 'a': at 0.1 s its answer was refused: {text}" in str(excinfo.value)
    assert bridge.errors[0].startswith(f"its answer was refused: {text}")


def test_an_answer_to_a_call_that_is_wrong_ends_the_run() -> None:
    bus = Bus()

    def answer(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="a", call=tick["call"], values=[1])

    bridge = FakeBridge(bus, answer)
    start_clients(bus, bridge, "a", services={"/init": "underwater_sensor_msgs/srv/GTpublish"})
    with pytest.raises(
        ClientLost, match=r"call of /init was refused: values is \[1\]; expected an"
    ):
        bus.services.call("init", GTpublish(groundTruth=np.zeros(8, np.float32)))


def test_a_wish_may_lie_beyond_all_times() -> None:
    bus = Bus()

    def answer(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(ACK, client="a", tick=tick["tick"], next=float("inf"))

    bridge = FakeBridge(bus, answer)
    nodes = start_clients(bus, bridge, "a", next=10**400)
    bus.publisher("depth", Float64)(Float64(data=1.0))
    for _ in range(3):
        step(bus, nodes)
    assert len(bridge.ticks) == 1


def test_another_program_of_the_same_name_is_told_and_changes_nothing() -> None:
    bus = Bus()

    def answer(bridge: FakeBridge, tick: dict[str, Any]) -> None:
        bridge.send_text(JOIN, client="a", topics=["/depth"], sender="second")
        bridge.send_text(ACK, client="a", tick=99, sender="second")
        bridge.send_text(JOIN, client="a", left=True, sender="second")
        bridge.send_text(ACK, client="a", tick=tick["tick"], sender="first")

    bridge = FakeBridge(bus, answer)
    nodes = start_clients(bus, bridge, "a", sender="first")
    for _ in range(2):
        bus.publisher("depth", Float64)(Float64(data=1.0))
        step(bus, nodes)
    assert len(bridge.ticks) == 2
    text = "client 'a' is first already; second is ignored"
    assert bridge.reports == 4 * [("second", text)]
    assert f"uwsim: test: {text}" in bridge.lines


def test_a_client_that_does_not_join_is_one_line() -> None:
    bus = Bus()
    bridge = FakeBridge(bus, is_silent)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=0.01)
    bridge.send_text(JOIN, client="b", topics=[])
    with pytest.raises(NeverStarted, match=r"No client 'a' has joined within 0.01 s"):
        node_of(bus, client)


def test_a_topic_for_observers_is_not_for_clients() -> None:
    bus = Bus()
    bus.hide_topic("depth")
    bridge = FakeBridge(bus, is_silent)
    (client,) = lockstep_clients([bridge], ["a"], timestep=TIMESTEP, limit=60.0)
    bridge.send_text(JOIN, client="a", topics=["/depth"])
    node = InProcessNode(
        bus, name="a", timestep=TIMESTEP, rng=np.random.default_rng(0), parameters={}
    )
    node.run(client)
    assert "for observers of the run" in str(node.error)


def test_a_client_needs_one_transport() -> None:
    with pytest.raises(BadSetting, match="expected one of --web, --ros1 and --ros2"):
        lockstep_clients([], ["a"], timestep=TIMESTEP, limit=60.0)
