"""A node and its master: what one says while the other is asking."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.middleware.ros1.nodes import Graph
from tests.support.waiting import wait_until
from uwsim.messages import Float64
from uwsim.middleware.ros1 import Master
from uwsim.middleware.ros1.xmlrpc import Answer, call


class OvertakenAnswer(Master):
    """Its update of the publishers is there before its answer, which is older."""

    def _register_subscriber(self, caller: str, topic: str, kind: str, uri: str) -> Answer:
        code, text, publishers = super()._register_subscriber(caller, topic, kind, uri)
        if publishers:
            call(uri, "publisherUpdate", "/master", topic, publishers)
        return [code, text, []]


@pytest.fixture
def graph() -> Iterator[Graph]:
    new_graph = Graph(OvertakenAnswer)
    yield new_graph
    new_graph.close()


def test_a_publisher_that_comes_while_a_topic_is_registered_is_kept(graph: Graph) -> None:
    other = graph.node("/other")
    publish = other.bus.publisher("topic", Float64)
    graph.wait_until_ready()
    sim = graph.node()
    actual: list[Any] = []
    sim.bus.subscribe("topic", Float64, actual.append)
    graph.wait_until_ready()
    wait_until(lambda: other.bus.has_subscribers("topic"), graph.step)
    publish(Float64(2.5))
    wait_until(lambda: actual, graph.step)
    assert actual == [Float64(2.5)]
