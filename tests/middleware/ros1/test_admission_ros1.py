"""Over ROS 1 senders are told apart by the names of their nodes."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import numpy as np
import pytest

from tests.middleware.ros1.nodes import Graph
from tests.support.waiting import wait_until
from uwsim.errors import UwsimError
from uwsim.messages import (
    Empty,
    EmptyResponse,
    Float32MultiArray,
    GTpublish,
    GTpublishResponse,
    String,
    floats,
)
from uwsim.middleware.admission import SingleProgram
from uwsim.middleware.ros1 import Ros1Bridge

OWN_NODE, OTHER = "node /tracker", "node /stranger"


@pytest.fixture
def graph() -> Iterator[Graph]:
    actual = Graph()
    yield actual
    actual.close()


@pytest.fixture
def sim(graph: Graph) -> Ros1Bridge:
    actual = graph.node()
    actual.admission = SingleProgram(lambda sender, text: None)
    actual.admission.admit(OWN_NODE)
    return actual


def test_another_node_on_the_topic_is_not_heard(graph: Graph, sim: Ros1Bridge) -> None:
    estimates = sim.bus.inbox("corners", Float32MultiArray)
    say = [
        graph.node(name).bus.publisher("corners", Float32MultiArray)
        for name in ("/stranger", "/tracker")
    ]
    graph.wait_until_ready()
    wait_until(lambda: sim.n_connected("/corners") == 2, graph.step)
    assert sim.admission is not None
    arrivals: list[float] = []
    refusals: list[object] = []

    def publish() -> None:
        for publisher, value in zip(say, (99.0, 1.0), strict=True):
            publisher(floats([value]))
        graph.step()
        arrivals.extend(float(message.data[0]) for message in estimates.take())
        refusals.extend(sim.admission.pop_refusals() if sim.admission is not None else ())

    wait_until(lambda: arrivals and refusals, publish)
    assert set(arrivals) == {1.0}
    assert {entry[:2] for entry in refusals if isinstance(entry, tuple)} == {(OTHER, "/corners")}


@pytest.mark.parametrize(("caller", "is_answered"), [("/tracker", True), ("/stranger", False)])
def test_another_node_calls_no_service(
    graph: Graph, sim: Ros1Bridge, caller: str, is_answered: bool
) -> None:
    sim.bus.services.serve("reset", Empty, lambda request: EmptyResponse())
    other = graph.node(caller)
    graph.wait_until_ready()
    answers: list[object] = []

    def call() -> None:
        try:
            answers.append(other.bus.services.call("reset", Empty()))
        except UwsimError as error:
            answers.append(str(error))

    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    wait_until(lambda: answers, sim.step)
    assert (answers == [EmptyResponse()]) == is_answered
    assert is_answered or "takes part" in str(answers[0])


@pytest.mark.parametrize(("offerer", "is_taken"), [("/tracker", True), ("/stranger", False)])
def test_another_node_is_not_given_the_ground_truth(
    graph: Graph, sim: Ros1Bridge, offerer: str, is_taken: bool
) -> None:
    requests: list[GTpublish] = []

    def answer(request: GTpublish) -> GTpublishResponse:
        requests.append(request)
        return GTpublishResponse()

    other = graph.node(offerer)
    other.bus.services.serve("autoInit", GTpublish, answer)
    graph.wait_until_ready()
    answers: list[object] = []

    def call() -> None:
        try:
            request = GTpublish(np.arange(8, dtype=np.float32))
            answers.append(sim.bus.services.call("autoInit", request))
        except UwsimError as error:
            answers.append(str(error))

    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    wait_until(lambda: answers, other.step)
    assert (answers == [GTpublishResponse()], len(requests)) == (is_taken, int(is_taken))
    assert is_taken or "/stranger does not take part" in str(answers[0])


def test_a_message_to_one_node_reaches_no_other(graph: Graph, sim: Ros1Bridge) -> None:
    sim.bus.publisher("tick", String)
    inboxes = [graph.node(name).bus.inbox("tick", String) for name in ("/stranger", "/tracker")]
    graph.wait_until_ready()
    wait_until(lambda: sim.n_connected("/tick") == 2, graph.step)
    arrivals: list[list[str]] = [[], []]

    def send() -> None:
        sim.send_to(OTHER, "tick", String(data="no"))
        sim.send("tick", String(data="all"))
        graph.step()
        for texts, inbox in zip(arrivals, inboxes, strict=True):
            texts.extend(message.data for message in inbox.take())

    wait_until(lambda: all("all" in texts for texts in arrivals), send)
    assert "no" in arrivals[0]
    assert "no" not in arrivals[1]
