"""Nodes that know nothing of lock-step: which outputs are waited for, and what is reported."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from threading import Thread
from time import sleep

import numpy as np
import pytest

from uwsim.bus import Bus, TopicEndpoints
from uwsim.errors import BadSetting, ClientLost, NeverStarted
from uwsim.messages import Float64
from uwsim.messages.services import Service
from uwsim.middleware.bridge import Bridge
from uwsim.middleware.connection import ConnectionSpec
from uwsim.middleware.lockstep import output_client
from uwsim.middleware.lockstep.output_client import OutputClient
from uwsim.middleware.lockstep.spec import (
    ClientSpec,
    OutputSpec,
    read_output,
    read_outputs,
    read_sync,
)
from uwsim.middleware.log import Log
from uwsim.simulation import InProcessNode

TIMESTEP = 0.002


class FakeBridge(Bridge):
    """A transport with a node at its other end, which acts on the clock and on messages."""

    def __init__(self, bus: Bus) -> None:
        super().__init__(bus, lambda: bus.step * TIMESTEP, Log("test", lambda line: None))
        self.lines: list[str] = []
        self.on_clock: Callable[[float], None] = lambda time: None
        self.on_message: Callable[[object], None] = lambda message: None
        self.published_topics = True

    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        pass

    def on_services(self, services: Mapping[str, Service]) -> None:
        pass

    def has_publisher(self, topic: str) -> bool:
        return self.published_topics

    def send(self, topic: str, message: object) -> None:
        self.lines.append(topic)
        self.on_message(message)

    def _publish_clock(self) -> None:
        self.lines.append("clock")
        self.on_clock(self.clock_topic.time())


@pytest.fixture(autouse=True)
def _stand_for_no_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(output_client, "READY_WAIT_S", 0.001)
    monkeypatch.setattr(output_client, "FIRST_WAIT_S", 0.001)


class Sea:
    """A bus with a depth that is published and a command that is read, and a node outside."""

    def __init__(self, *outputs: OutputSpec, limit: float = 60.0) -> None:
        self.bus = Bus()
        self.bridge = FakeBridge(self.bus)
        self.say = self.bus.publisher("depth", Float64)
        self.commands = self.bus.inbox("cmd", Float64)
        connection = ConnectionSpec(ros1=True)
        spec = ClientSpec(
            name="n", connection=connection, limit=limit, sync="output", outputs=outputs, settle=0.0
        )
        self.client = OutputClient(self.bridge, spec, timestep=TIMESTEP)
        self.node = InProcessNode(
            self.bus, name="n", timestep=TIMESTEP, rng=np.random.default_rng(0), parameters={}
        )

    def start(self) -> None:
        self.bridge.subscribers.add("depth")
        self.node.run(self.client)
        assert self.node.error is None

    def step(self) -> list[float]:
        """Take a step; returns the commands that came in it."""
        self.bus.step += 1
        self.bus.deliver()
        self.node.tick()
        self.bus.deliver()
        return [message.data for message in self.commands.take()]


def test_a_timer_of_the_node_is_waited_for_in_the_step_in_which_it_is_due() -> None:
    sea = Sea(OutputSpec(topic="cmd", rate=30.0))
    sea.start()
    due = [0.0]

    def fire(time: float) -> None:
        if time >= due[-1] + 1 / 30 - 1e-9:
            due.append(due[-1] + 1 / 30)
            sea.bridge.put("cmd", Float64(data=time))

    sea.bridge.on_clock = fire
    arrivals = {n: actual for n in range(1, 60) if (actual := sea.step())}
    assert arrivals == {17: [0.034], 34: [0.068], 50: [0.1]}


def test_messages_are_sent_before_the_time_is_told() -> None:
    sea = Sea(OutputSpec(topic="cmd", input_topic="depth"))
    sea.start()
    sea.bridge.lines.clear()
    sea.bridge.on_message = lambda message: sea.bridge.put("cmd", message)
    sea.say(Float64(data=1.0))
    assert sea.step() == [1.0]
    assert sea.bridge.lines == ["depth", "clock"]


def test_each_message_of_an_input_has_its_output_in_the_same_step() -> None:
    sea = Sea(OutputSpec(topic="cmd", input_topic="depth"))
    sea.start()
    sea.bridge.on_message = lambda message: sea.bridge.put("cmd", message)
    assert sea.step() == []
    for value in (1.0, 2.0):
        sea.say(Float64(data=value))
    assert sea.step() == [1.0, 2.0]


def two_outputs(*, limit: float = 60.0) -> Sea:
    """A sea in which a command and a status follow each depth."""
    outputs = [OutputSpec(topic=topic, input_topic="depth") for topic in ("cmd", "status")]
    sea = Sea(limit=limit)
    sea.bus.inbox("status", Float64)
    spec = replace(sea.client._spec, outputs=tuple(outputs))
    sea.client = OutputClient(sea.bridge, spec, timestep=TIMESTEP)
    return sea


def answer_on(sea: Sea, *topics: str) -> Callable[[object], None]:
    def answer(message: object) -> None:
        for topic in topics:
            sea.bridge.put(topic, message)

    return answer


def test_two_outputs_follow_one_input() -> None:
    sea = two_outputs(limit=0.5)
    sea.start()
    sea.bridge.on_message = answer_on(sea, "cmd", "status")
    for value in (1.0, 2.0, 3.0):
        sea.say(Float64(data=value))
        assert sea.step() == [value]
    n_arrived = sea.bridge.arrivals.n_arrived
    assert (n_arrived["cmd"], n_arrived["status"]) == (3, 3)


def test_of_two_outputs_the_one_that_is_missing_is_named() -> None:
    sea = two_outputs(limit=0.02)
    sea.start()
    sea.bridge.on_message = answer_on(sea, "cmd", "status")
    sea.say(Float64(data=1.0))
    sea.step()
    sea.bridge.on_message = answer_on(sea, "cmd")
    sea.say(Float64(data=2.0))
    with pytest.raises(ClientLost, match="did not publish on /status"):
        sea.step()


@pytest.mark.parametrize("n_silent", [1, 7])
def test_a_node_that_answers_nothing_until_it_is_initialised_is_waited_for_from_then_on(
    n_silent: int,
) -> None:
    sea = two_outputs(limit=5.0)
    sea.start()
    for value in range(n_silent):
        sea.say(Float64(data=float(value)))
        assert sea.step() == []
    sea.bridge.external_services.n_called += 1  # autoInit
    sea.bridge.on_message = answer_on(sea, "cmd", "status")
    for value in (10.0, 11.0):
        sea.say(Float64(data=value))
        assert sea.step() == [value]
    late_answer = Thread(
        target=lambda: (sleep(0.05), answer_on(sea, "cmd", "status")(Float64(data=12.0)))
    )
    sea.bridge.on_message = lambda message: late_answer.start()
    sea.say(Float64(data=12.0))
    assert sea.step() == [12.0]
    late_answer.join()


def test_an_initialised_node_that_answers_nothing_ends_the_run() -> None:
    sea = two_outputs(limit=0.02)
    sea.start()
    sea.say(Float64(data=1.0))
    sea.step()
    sea.bridge.external_services.n_called += 1
    sea.say(Float64(data=2.0))
    with pytest.raises(ClientLost, match="did not publish on /cmd"):
        sea.step()


def test_a_node_that_never_answers_ends_the_run() -> None:
    sea = Sea(OutputSpec(topic="cmd", input_topic="depth"), limit=0.01)
    sea.start()

    def run_on() -> None:
        for _ in range(100):
            sea.say(Float64(data=1.0))
            sea.step()

    with pytest.raises(ClientLost, match="did not publish on /cmd"):
        run_on()


def test_a_slow_first_answer_delays_no_later_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(output_client, "FIRST_WAIT_S", 0.1)
    sea = Sea(OutputSpec(topic="cmd", input_topic="depth"))
    sea.start()
    sea.say(Float64(data=1.0))
    assert sea.step() == []
    node = Thread(
        target=lambda: [(sleep(0.03), sea.bridge.put("cmd", Float64(data=x))) for x in (1.0, 2.0)]
    )
    sea.bridge.on_message = lambda message: node.start()
    sea.say(Float64(data=2.0))
    assert sea.step() == [1.0, 2.0]
    node.join()
    sea.bridge.on_message = answer_on(sea, "cmd")
    sea.say(Float64(data=3.0))
    assert sea.step() == [3.0]


def test_more_answers_than_inputs_end_the_run() -> None:
    sea = Sea(OutputSpec(topic="cmd", input_topic="depth"))
    sea.start()
    sea.bridge.on_message = answer_on(sea, "cmd", "cmd")
    sea.say(Float64(data=1.0))
    with pytest.raises(ClientLost, match="2 messages on /cmd"):
        sea.step()


def test_what_came_while_time_stood_is_not_taken_for_what_is_due() -> None:
    sea = Sea(OutputSpec(topic="cmd", rate=100.0), limit=0.05)
    sea.bridge.on_clock = lambda time: sea.bridge.put("cmd", Float64(data=-1.0))
    sea.start()
    sea.bridge.on_clock = lambda time: None
    assert sea.bridge.arrivals.n_arrived["cmd"] > 0
    for _ in range(4):
        sea.step()
    with pytest.raises(ClientLost):
        sea.step()


def test_an_output_that_does_not_come_ends_the_run() -> None:
    sea = Sea(OutputSpec(topic="cmd", rate=500.0), limit=0.01)
    sea.start()
    with pytest.raises(ClientLost, match=r"'n' did not publish on /cmd what was due at 0\.002 s"):
        sea.step()


def test_a_timer_of_rospy_that_fires_twice_at_first_is_waited_for_as_any_other() -> None:
    sea = Sea(OutputSpec(topic="cmd", rate=100.0))
    sea.start()
    due = [0.0]

    def fire(time: float) -> None:
        if time >= due[-1] + 0.01 - 1e-9:
            for _ in range(2 if len(due) == 1 else 1):
                sea.bridge.put("cmd", Float64(data=time))
            due.append(time)

    sea.bridge.on_clock = fire
    arrivals = {n: len(actual) for n in range(1, 20) if (actual := sea.step())}
    assert arrivals == {5: 2, 10: 1, 15: 1}


def test_a_node_that_does_not_go_by_the_clock_ends_the_run() -> None:
    sea = Sea(OutputSpec(topic="cmd", rate=10.0))
    sea.start()
    sea.bridge.on_clock = lambda time: sea.bridge.put("cmd", Float64(data=time))
    sea.step()

    def run_on() -> None:
        for _ in range(10):
            sea.step()

    with pytest.raises(ClientLost, match=r"1 messages on /cmd by 0\.01 s, where 0 are due"):
        run_on()


def test_who_is_not_there_is_named() -> None:
    sea = Sea(OutputSpec(topic="cmd", input_topic="depth"), limit=0.01)
    sea.bridge.published_topics = False
    with pytest.raises(NeverStarted, match="nobody publishes /cmd; nobody reads /depth"):
        sea.node.run(sea.client)


@pytest.mark.parametrize(
    ("output", "text"),
    [
        (OutputSpec(topic="cmb", rate=10.0), "has the topic /cmb. Did you mean '/cmd'"),
        (
            OutputSpec(topic="cmd", input_topic="depht"),
            "has the topic /depht. Did you mean '/depth'",
        ),
    ],
)
def test_a_topic_that_is_not_there_is_an_error(output: OutputSpec, text: str) -> None:
    sea = Sea(output)
    with pytest.raises(BadSetting, match=text):
        sea.node.run(sea.client)


def test_outputs_are_read_from_the_command_line() -> None:
    assert read_output("/cmd=10Hz") == OutputSpec(topic="cmd", rate=10.0)
    assert read_output("cmd = 2.5 Hz") == OutputSpec(topic="cmd", rate=2.5)
    assert read_output("/corners=/camera/image") == OutputSpec(
        topic="corners", input_topic="camera/image"
    )


@pytest.mark.parametrize("text", ["", "cmd", "/cmd=", "=10Hz", "cmd=0Hz", "cmd=-1Hz", "cmd=1e9Hz"])
def test_what_is_no_output_is_an_error(text: str) -> None:
    with pytest.raises(BadSetting, match="--output"):
        read_output(text)


@pytest.mark.parametrize("text", ["10", "1e", "10kHz", "1.1.1Hz", "1e999Hz", "nanHz", "infhz"])
def test_a_rate_has_its_unit(text: str) -> None:
    with pytest.raises(BadSetting, match="expected a rate"):
        read_output(f"cmd={text}")


@pytest.mark.parametrize(
    ("texts", "text"),
    [(["a=1Hz", "/a=2Hz"], "/a occurs twice"), (["a=/a"], "the input is the output itself")],
)
def test_outputs_that_contradict_are_an_error(texts: list[str], text: str) -> None:
    with pytest.raises(BadSetting, match=text):
        read_outputs(texts)


def test_what_is_waited_for_is_one_of_four() -> None:
    with pytest.raises(BadSetting, match="Did you mean 'output'"):
        read_sync("outputs")


@pytest.mark.parametrize(
    ("sync", "connection", "text"),
    [
        ("ack", ConnectionSpec(ros2=True), "lock-step, ros2, grade (a)"),
        ("step", ConnectionSpec(ros1=True), "lock-step, ros1, grade (b), not guaranteed"),
        ("output", ConnectionSpec(ros1=True), "lock-step, ros1, grade (c), not guaranteed"),
        ("none", ConnectionSpec(ros1=True), "free-running, ros1, not repeatable"),
    ],
)
def test_the_result_says_what_was_waited_for(
    sync: str, connection: ConnectionSpec, text: str
) -> None:
    spec = ClientSpec(name="n", connection=connection, sync=read_sync(sync))
    assert spec.participation == text
