"""Answers of nodes and masters of ROS 1 that no library of ROS gives."""

from __future__ import annotations

import http.server
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from tests.middleware.ros1.nodes import Graph
from tests.support.waiting import LIMIT, wait_until
from uwsim.messages import Float64
from uwsim.middleware.log import Log
from uwsim.middleware.ros1.registrar import Registrar, Registrations
from uwsim.middleware.ros1.tcpros import PeerError
from uwsim.middleware.ros1.xmlrpc import XmlRpcServer, call

MAX_NESTING = 3000
INT = "<value><int>{}</int></value>"
LIST = "<value><array><data>{}</data></array></value>"
NESTED_LISTS = "<value><array><data>" * MAX_NESTING + "</data></array></value>" * MAX_NESTING
ODD_ANSWERS = {
    "a decimal that is none": "<value><bigdecimal>xx</bigdecimal></value>",
    "a member without a value": "<value><struct><member><name>a</name></member></struct></value>",
    "a text of nested lists": LIST.format(INT.format(0) + NESTED_LISTS + INT.format(0)),
    "nested lists": NESTED_LISTS,
    "a number for the list": INT.format(1),
}


@contextmanager
def answering(value: str) -> Iterator[str]:
    """Serve this value, in XML, to every call; gives the address."""
    body = f"<methodResponse><params><param>{value}</param></params></methodResponse>".encode()

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            self.rfile.read(int(self.headers["content-length"]))
            self.send_response(200)
            self.send_header("content-length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *args: object) -> None:
            """Print nothing."""

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}/"
    server.shutdown()
    server.server_close()


@pytest.mark.parametrize("case", ODD_ANSWERS)
def test_an_odd_answer_is_an_error_of_the_peer(case: str) -> None:
    with (
        answering(ODD_ANSWERS[case]) as uri,
        pytest.raises(PeerError, match="answer as ROS"),
    ):
        call(uri, "requestTopic", "/x", timeout=LIMIT)


def test_a_publisher_with_an_odd_answer_is_asked_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("uwsim.middleware.ros1.subscription.RETRY_INTERVAL", 0.02)  # [s]
    graph = Graph()
    sim = graph.node()
    sim.bus.subscribe("cmd", Float64, print)
    graph.wait_until_ready()
    with answering(ODD_ANSWERS["a text of nested lists"]) as uri:
        call(graph.master.uri, "registerPublisher", "/x", "/cmd", "std_msgs/Float64", uri)
        wait_until(lambda: sum("does not answer as ROS" in x for x in graph.lines) > 2, graph.step)
    graph.close()


def test_registering_goes_on_after_a_master_that_answers_with_a_number_for_a_list() -> None:
    answers: list[Any] = [7, []]
    arrivals: list[tuple[str, list[str]]] = []
    methods = {
        "registerSubscriber": lambda *_: [1, "", answers.pop(0)],
        "unregisterSubscriber": lambda *_: [1, "", 1],
        "lookupNode": lambda *_: [1, "", "http://127.0.0.1:1/"],
    }
    log = Log("test", lambda line: None)
    master = XmlRpcServer("127.0.0.1", 0, methods, log, "master")
    registrar = Registrar(
        f"http://127.0.0.1:{master.port}/",
        "/sim",
        "http://127.0.0.1:1/",
        log,
        lambda topic, uris: arrivals.append((topic, uris)),
        parameters={},
        poll=0.02,
    )
    registrar.set_registrations(Registrations(subscribers={"/cmd": "std_msgs/Float64"}))
    wait_until(lambda: arrivals)
    assert arrivals == [("/cmd", [])]
    registrar.close()
    master.close()
