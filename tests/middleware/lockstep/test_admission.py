"""A scored run is changed by the program that takes part alone; what others send is counted."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from uwsim.bus import Bus, TopicEndpoints
from uwsim.errors import NeverStarted, UwsimError
from uwsim.messages import Empty, EmptyResponse, Float64, String
from uwsim.messages.services import Service
from uwsim.messages.simulation_control import StepSimulation
from uwsim.middleware.admission import MAX_KINDS, SingleProgram
from uwsim.middleware.bridge import Bridge
from uwsim.middleware.connection import ConnectionSpec
from uwsim.middleware.lockstep.external_client import make_client
from uwsim.middleware.lockstep.spec import ClientSpec, OutputSpec, Sync
from uwsim.middleware.lockstep.topics import ACK, JOIN, TICK
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.simulation import InProcessNode

TIMESTEP = 0.1
OWN_SENDER, OTHER = "client 127.0.0.1:4001", "client 127.0.0.1:4002"


class FakeBridge(Bridge):
    """A transport that tells senders apart; what it sends is kept."""

    def __init__(self, bus: Bus) -> None:
        super().__init__(bus, lambda: bus.step * TIMESTEP, Log("test", lambda line: None))
        self.ticks: list[dict[str, Any]] = []
        self.reports: list[tuple[str, str]] = []
        self.single_messages: list[tuple[str, dict[str, Any]]] = []

    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        pass

    def on_services(self, services: Mapping[str, Service]) -> None:
        pass

    def send(self, topic: str, message: object) -> None:
        if topic == TICK and isinstance(message, String):
            self.ticks.append(text := json.loads(message.data))
            if "tick" in text:
                self.answer(text)

    def answer(self, text: dict[str, Any]) -> None:
        """The program acknowledges; before that, it and the other publish."""
        for sender, value in ((OTHER, 99.0), (OWN_SENDER, 1.0), (OTHER, 99.0)):
            self.put("estimate", Float64(data=value), sender)
        self.send_text(ACK, sender=OTHER, tick=text["tick"], published={"/estimate": 3})
        self.send_text(ACK, sender=OWN_SENDER, tick=text["tick"], published={"/estimate": 1})

    def send_text(self, topic: str, *, sender: str, **content: Any) -> None:
        self.put(topic, String(data=json.dumps({"client": "a", **content})), sender)

    def send_to(self, client_name: str, topic: str, message: object) -> None:
        assert (topic, type(message)) == (TICK, String)
        self.single_messages.append((client_name, json.loads(message.data)))

    def report_error(self, client_name: str, text: str) -> None:
        self.reports.append((client_name, text))


class Run:
    """A run of one program outside."""

    def __init__(self, sync: Sync = "ack", **options: Any) -> None:
        self.bus = Bus()
        self.bus.publisher("depth", Float64)
        self.estimates = self.bus.inbox("estimate", Float64)
        self.status = self.bus.inbox("status", String)
        self.n_started = 0
        self.bus.services.serve("startBench", Empty, self._start)
        self.bridge = FakeBridge(self.bus)
        spec = ClientSpec(
            name="a",
            connection=ConnectionSpec(web=WebOptions(port=0)),
            limit=5.0,
            sync=sync,
            **options,
        )
        self.client: Any = make_client(spec, [self.bridge], timestep=TIMESTEP)
        self.node = InProcessNode(
            self.bus, name="a", timestep=TIMESTEP, rng=np.random.default_rng(0), parameters={}
        )

    def _start(self, request: Empty) -> EmptyResponse:
        self.n_started += 1
        return EmptyResponse()

    def start(self) -> None:
        self.node.run(self.client)
        assert self.node.error is None

    def step(self) -> None:
        self.bus.step += 1
        self.bridge.step()
        self.bus.deliver()
        self.node.tick()
        self.bus.deliver()

    def call_error(self, sender: str) -> str | None:
        """Call startBench; returns the error."""
        future = self.bridge.request("startBench", Empty(), sender)
        self.bridge.step()
        error = future.exception(timeout=5.0)
        assert error is None or isinstance(error, UwsimError)
        return None if error is None else str(error)


def test_after_the_join_only_the_joined_connection_publishes_and_calls() -> None:
    run = Run()
    run.bridge.send_text(JOIN, sender=OWN_SENDER, topics=["/depth"], next=0.0)
    run.start()
    run.step()
    run.bridge.put("status", String(data="failed: falsified"), OTHER)
    assert "takes part" in str(run.call_error(OTHER))
    assert run.call_error(OWN_SENDER) is None
    assert (run.n_started, [m.data for m in run.estimates.take()]) == (1, [1.0])
    assert run.status.take() == []
    assert run.client.pop_refusals() == (
        (OTHER, "/estimate", 2),
        (OTHER, "/startBench", 1),
        (OTHER, "/status", 1),
        (OTHER, f"/{ACK}", 1),
    )
    assert run.client.pop_refusals() == ()
    assert {sender for sender, _ in run.bridge.reports} == {OTHER}


def test_what_the_program_publishes_before_its_join_is_kept_and_that_of_others_is_not() -> None:
    run = Run()
    for sender, text in (
        (OTHER, "failed: falsified"),
        (OWN_SENDER, "tracking"),
        (OTHER, "lost: no"),
    ):
        run.bridge.put("status", String(data=text), sender)
    assert "takes part" in str(run.call_error(OTHER))
    run.bridge.send_text(JOIN, sender=OWN_SENDER, topics=["/depth"])
    run.start()
    assert [message.data for message in run.status.take()] == ["tracking"]


@pytest.mark.parametrize("sender", [OWN_SENDER, OTHER, ""])
def test_answers_from_before_the_join_are_dropped(sender: str) -> None:
    run = Run()
    run.bridge.send_text(ACK, sender=sender, tick=1)
    run.bridge.send_text(ACK, sender=sender, call=1, values={})
    run.bridge.send_text(JOIN, sender=OWN_SENDER, topics=["/depth"], next=0.0)
    run.bridge.answer = lambda text: None  # type: ignore[method-assign]
    run.start()
    run.bridge.wait_for(lambda: False, 0.01)
    run.client._limit = 0.05
    with pytest.raises(UwsimError, match="did not answer the tick"):
        run.step()


@pytest.mark.parametrize("secret", [None, "", "guess", "opensesame ", 7, ["opensesame"]])
def test_a_join_without_the_secret_is_refused_and_the_right_one_still_counts(
    secret: object,
) -> None:
    run = Run(secret="opensesame")
    fields = {} if secret is None else {"secret": secret}
    for _ in range(150):  # more than the joins that wait
        run.bridge.send_text(JOIN, sender=OTHER, topics=["/depth"], **fields)
    run.bridge.send_text(JOIN, sender=OWN_SENDER, topics=["/depth"], secret="opensesame", next=0.0)
    for _ in range(150):
        run.bridge.send_text(JOIN, sender=OTHER, topics=["/depth"], **fields)
    run.start()
    run.step()
    assert [message.data for message in run.estimates.take()] == [1.0]
    assert any(sender == OTHER and "secret" in text for sender, text in run.bridge.reports)


@pytest.mark.parametrize(
    "text",
    [
        *('{"client": "a", "topics": ' + "[" * n + "]" * n + "}" for n in (100, 700, 965, 970)),
        r'{"client": "a", "topics": [], "secret": "\ud800"}',
        r'{"client": "a", "topics": ["\ud800"], "secret": "opensesame"}',
    ],
)
def test_a_join_that_cannot_be_read_is_none(text: str) -> None:
    run = Run(secret="opensesame" if "secret" in text else None)
    run.bridge.put(JOIN, String(data=text), OTHER)
    run.bridge.send_text(JOIN, sender=OWN_SENDER, topics=["/depth"], next=0.0, secret="opensesame")
    run.start()
    run.step()
    assert [message.data for message in run.estimates.take()] == [1.0]


@pytest.mark.parametrize(
    "join", [{"topics": ["/depth"]}, {"topics": 5, "secret": "opensesame"}, {"topics": []}]
)
def test_a_join_that_is_refused_is_told_to_who_sent_it_alone(join: dict[str, Any]) -> None:
    """The program that is waited for read that its own was refused, and ended."""
    run = Run(secret="opensesame")
    run.bridge.send_text(JOIN, sender=OTHER, id="others", next=0.0, **join)
    run.bridge.send_text(
        JOIN, sender=OWN_SENDER, id="its", topics=["/depth"], secret="opensesame", next=0.0
    )
    run.start()
    ((sender, text),) = run.bridge.single_messages
    assert (sender, text["client"], text["id"]) == (OTHER, "a", "others")
    assert "its join was refused" in text["error"]
    assert not any("error" in tick for tick in run.bridge.ticks)


def test_with_a_secret_nobody_else_can_join() -> None:
    run = Run(secret="opensesame")
    run.client._limit = 0.05
    run.bridge.send_text(JOIN, sender=OTHER, topics=["/depth"], secret="sesame")
    with pytest.raises(NeverStarted, match="No client 'a' has joined"):
        run.client.start(run.node)


def test_a_program_that_is_known_by_an_id_alone_is_not_answered_for_without_it() -> None:
    run = Run()
    run.bridge.answer = lambda text: None  # type: ignore[method-assign]
    run.bridge.send_text(JOIN, sender="", topics=["/depth"], next=0.0, id="7f")
    run.start()
    run.client._limit = 0.05
    run.bridge.send_text(ACK, sender="", tick=1)
    run.bridge.send_text(ACK, sender="", tick=1, id="8a")
    with pytest.raises(UwsimError, match="did not answer the tick"):
        run.step()


def test_of_a_program_that_takes_the_steps_the_first_caller_takes_part() -> None:
    run = Run("step")
    run.bridge.put("estimate", Float64(data=99.0), OTHER)
    run.bridge.put("estimate", Float64(data=1.0), OWN_SENDER)
    assert "takes part" in str(run.call_error(OTHER))
    first_call = run.bridge.request("step_simulation", StepSimulation(steps=2), OWN_SENDER)
    second = run.bridge.request("step_simulation", StepSimulation(steps=1), OTHER)
    run.start()
    assert "takes part" in str(second.exception(timeout=5.0))
    assert [message.data for message in run.estimates.take()] == [1.0]
    assert not first_call.done()


OUTPUTS = (OutputSpec(topic="estimate", input_topic="depth"), OutputSpec(topic="speed", rate=10.0))


def test_outputs_belong_to_who_published_them_first_and_else_only_they_publish() -> None:
    run = Run("output", outputs=OUTPUTS)
    put, admission = run.bridge.put, run.bridge.admission
    assert run.call_error(OTHER) is None  # a tracker starts the benchmark before its first output
    put("status", String(data="failed: falsified"), OTHER)
    put("status", String(data="tracking"), OWN_SENDER)
    for value, sender in ((1.0, OWN_SENDER), (99.0, OTHER)):
        put("estimate", Float64(data=value), sender)
    put("speed", Float64(data=0.5), "node /another_part")
    assert "takes part" in str(run.call_error(OTHER))
    assert run.bridge.arrivals.n_arrived == {"estimate": 1, "status": 1, "speed": 1}
    run.bridge.step()
    assert [message.data for message in run.estimates.take()] == [1.0]
    assert [message.data for message in run.status.take()] == ["tracking"]
    put("status", String(data="failed: falsified"), OTHER)
    assert admission is not None
    assert (OTHER, "/status", 1) in admission.pop_refusals()


def test_in_real_time_each_topic_belongs_to_who_published_it_first_until_it_leaves() -> None:
    run = Run("none")
    put, admission = run.bridge.put, run.bridge.admission
    for value, sender in ((1.0, OWN_SENDER), (99.0, OTHER), (2.0, OWN_SENDER)):
        put("estimate", Float64(data=value), sender)
    put("status", String(data="tracking"), OTHER)  # a system of several programs
    run.bridge.step()
    assert [message.data for message in run.estimates.take()] == [1.0, 2.0]
    assert [message.data for message in run.status.take()] == ["tracking"]
    assert admission is not None
    admission.remove(OWN_SENDER)
    put("estimate", Float64(data=3.0), OTHER)
    run.bridge.step()
    assert [message.data for message in run.estimates.take()] == [3.0]


def test_a_flood_of_senders_and_topics_is_counted_without_growing() -> None:
    lines: list[str] = []
    admission = SingleProgram(lambda sender, text: lines.append(text))
    admission.admit(OWN_SENDER)
    for n in range(10 * MAX_KINDS):
        assert not admission.may_publish(f"t{n % 333}", f"client {n}", lambda: None, 8)
    refusals = admission.pop_refusals()
    assert sum(n for _, _, n in refusals) == 10 * MAX_KINDS
    assert len(refusals) == len(lines) == MAX_KINDS + 1
