"""Nodes of ROS 1 that answer a call one byte at a time, or never."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress

import pytest

from tests.support.waiting import LIMIT, wait_until
from uwsim.middleware.log import Log
from uwsim.middleware.ros1.master import Master
from uwsim.middleware.ros1.node_calls import NodeCalls
from uwsim.middleware.ros1.tcpros import PeerError
from uwsim.middleware.ros1.xmlrpc import XmlRpcServer, call

KIND = "std_msgs/String"
NODE = "http://127.0.0.1:1/"
HEADER = b"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\nContent-Length: 100000\r\n\r\n"


@contextmanager
def dripping() -> Iterator[str]:
    """Answer each call with a byte every 20 ms; gives the address."""
    server = socket.create_server(("127.0.0.1", 0))
    is_over = threading.Event()

    def answer(connection: socket.socket) -> None:
        with connection, suppress(OSError):
            connection.recv(65536)
            connection.sendall(HEADER)
            while not is_over.wait(0.02):
                connection.sendall(b" ")

    def accept() -> None:
        with suppress(OSError):
            while True:
                connection, _ = server.accept()
                threading.Thread(target=answer, args=(connection,), daemon=True).start()

    threading.Thread(target=accept, daemon=True).start()
    yield f"http://127.0.0.1:{server.getsockname()[1]}/"
    is_over.set()
    with suppress(OSError):
        server.shutdown(socket.SHUT_RDWR)
    server.close()


def test_a_call_has_a_deadline_however_slowly_the_answer_comes() -> None:
    with dripping() as uri, pytest.raises(PeerError, match="does not answer"):
        call(uri, "publisherUpdate", "/master", "/chat", [], timeout=0.3)


def test_slow_subscribers_do_not_hold_up_others(monkeypatch: pytest.MonkeyPatch) -> None:
    arrivals: list[list[str]] = []

    def update(caller: str, topic: str, uris: list[str]) -> list[object]:
        arrivals.append(uris)
        return [1, "", 0]

    log = Log("test", lambda line: None)
    master = Master(log)
    honest_node = XmlRpcServer("127.0.0.1", 0, {"publisherUpdate": update}, log, "node")
    called_uris: list[str] = []

    def call_slowly(uri: str, method: str, *arguments: object, max_length: int) -> object:
        """Call the honest node; of others the call lasts until the end of the tests."""
        called_uris.append(uri)
        if uri.endswith(f":{honest_node.port}/"):
            return call(uri, method, *arguments, timeout=LIMIT)
        return threading.Event().wait()

    monkeypatch.setattr("uwsim.middleware.ros1.master.call", call_slowly)
    for n in range(8):
        for topic in ("/evil", "/more"):
            node = f"http://127.0.0.1:{n + 2}/"
            call(master.uri, "registerSubscriber", f"/evil{n}", topic, KIND, node)
    for topic in ("/evil", "/more"):
        call(master.uri, "registerPublisher", "/x", topic, KIND, NODE)
    wait_until(lambda: len(called_uris) == 8)
    node = f"http://127.0.0.1:{honest_node.port}/"
    call(master.uri, "registerSubscriber", "/honest", "/chat", KIND, node)
    call(master.uri, "registerPublisher", "/y", "/chat", KIND, NODE)
    wait_until(lambda: arrivals)
    assert arrivals == [[NODE]]
    master.close()
    assert all(entry.daemon for entry in threading.enumerate() if "ros1-master" in entry.name)
    honest_node.close()


def test_the_calls_of_a_node_are_made_in_their_order_one_at_a_time() -> None:
    calls = NodeCalls()
    finished_calls: list[str] = []
    is_free = threading.Event()

    def run_first() -> None:
        is_free.wait(LIMIT)
        finished_calls.append("1")

    calls.add("a", "1", run_first)
    wait_until(lambda: not calls._calls["a"])  # it has begun
    calls.add("a", "2", lambda: finished_calls.append("old"))
    calls.add("a", "3", lambda: finished_calls.append("3"))
    calls.add("a", "2", lambda: finished_calls.append("2"))
    calls.add("b", "1", lambda: finished_calls.append("b"))
    wait_until(lambda: finished_calls)
    assert finished_calls == ["b"]
    is_free.set()
    wait_until(lambda: len(finished_calls) == 4)
    assert finished_calls == ["b", "1", "2", "3"]
    calls.close()
