"""A program that takes the steps itself: when time passes, and what it is answered."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import Future

import numpy as np
import pytest

from uwsim.bus import Bus, TopicEndpoints
from uwsim.errors import ClientLost, NeverStarted
from uwsim.messages import Float64
from uwsim.messages.services import Service
from uwsim.messages.simulation_control import Result, StepSimulation, StepSimulationResponse
from uwsim.middleware.bridge import Bridge
from uwsim.middleware.connection import ConnectionSpec
from uwsim.middleware.lockstep.spec import ClientSpec
from uwsim.middleware.lockstep.step_client import StepClient
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.simulation import InProcessNode

TIMESTEP = 0.002


class FakeBridge(Bridge):
    """A transport whose program acts while the simulation waits."""

    def __init__(self, bus: Bus) -> None:
        super().__init__(bus, lambda: bus.step * TIMESTEP, Log("test", lambda line: None))
        self.services: Mapping[str, Service] = {}

    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        pass

    def on_services(self, services: Mapping[str, Service]) -> None:
        self.services = services

    def send(self, topic: str, message: object) -> None:
        pass


class Program:
    """Calls for steps, each next call when the one before is answered."""

    def __init__(self, bridge: FakeBridge, *calls: int) -> None:
        self._bridge, self._left = bridge, list(calls)
        self.answers: list[tuple[int, int]] = []  # number of the step, code of the answer
        self.first_call: Callable[[], None] = lambda: None

    def go_on(self) -> None:
        if self._left:
            self.first_call()
            requests = self._bridge.request("step_simulation", StepSimulation(self._left.pop(0)))
            requests.add_done_callback(self._take_answer)

    def _take_answer(self, answer: Future[object]) -> None:
        response = answer.result()
        assert isinstance(response, StepSimulationResponse)
        self.answers.append((self._bridge.bus.step, response.result.result))
        self.go_on()


def attach_client(bridge: FakeBridge, limit: float = 60.0) -> InProcessNode:
    connection = ConnectionSpec(web=WebOptions(port=0))
    spec = ClientSpec(name="s", connection=connection, limit=limit, sync="step")
    node = InProcessNode(
        bridge.bus, name="s", timestep=TIMESTEP, rng=np.random.default_rng(0), parameters={}
    )
    node.run(StepClient(bridge, spec, timestep=TIMESTEP))
    assert node.error is None
    node.tick()  # step 0
    return node


def step(bridge: FakeBridge, node: InProcessNode) -> None:
    bridge.bus.step += 1
    bridge.bus.deliver()
    node.tick()
    bridge.bus.deliver()


def test_a_call_is_answered_when_its_steps_are_done() -> None:
    bridge = FakeBridge(Bus())
    program = Program(bridge, 3, 1, 2, 1)
    program.go_on()
    node = attach_client(bridge)
    assert "step_simulation" in bridge.services
    for _ in range(6):
        step(bridge, node)
    assert program.answers == [(n, 1) for n in (3, 4, 6)]


def test_what_was_published_before_a_call_is_on_the_bus_before_its_first_step() -> None:
    bridge = FakeBridge(Bus())
    commands = bridge.bus.inbox("cmd", Float64)
    program = Program(bridge, 2, 2, 2)
    program.first_call = lambda: bridge.put("cmd", Float64(data=float(bridge.bus.step)))
    program.go_on()
    node = attach_client(bridge)
    arrivals = [[message.data for message in commands.take()]]
    for _ in range(4):
        step(bridge, node)
        arrivals.append([message.data for message in commands.take()])
    assert arrivals == [[0.0], [], [2.0], [], [4.0]]


def test_calls_that_cannot_be_done_are_refused_and_time_stands() -> None:
    bridge = FakeBridge(Bus())
    refusals = [bridge.request("step_simulation", StepSimulation(n)) for n in (0, 10**8)]
    first_call = bridge.request("step_simulation", StepSimulation(1))
    second = bridge.request("step_simulation", StepSimulation(1))
    attach_client(bridge)
    codes = [answer.result(0) for answer in (*refusals, second)]
    assert [code.result.result for code in codes] == [  # type: ignore[attr-defined]
        Result.OPERATION_FAILED,
        Result.OPERATION_FAILED,
        Result.INCORRECT_STATE,
    ]
    assert not first_call.done()


def test_a_program_that_never_calls_is_named() -> None:
    with pytest.raises(NeverStarted, match=r"'s' has not called /step_simulation within 0\.01 s"):
        attach_client(FakeBridge(Bus()), limit=0.01)


def test_a_program_that_calls_no_more_ends_the_run() -> None:
    bridge = FakeBridge(Bus())
    program = Program(bridge, 1)
    program.go_on()
    node = attach_client(bridge, limit=0.01)
    with pytest.raises(ClientLost, match=r"has not called /step_simulation at 0\.002 s"):
        step(bridge, node)
