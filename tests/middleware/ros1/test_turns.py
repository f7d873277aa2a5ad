"""Floods of requests at the XML-RPC servers of ROS 1."""

from __future__ import annotations

import gzip
import http.client
import threading
from collections.abc import Iterator
from contextlib import closing

import pytest

from tests.support.waiting import LIMIT, wait_until
from uwsim.middleware.log import Log
from uwsim.middleware.ros1 import turns
from uwsim.middleware.ros1.tcpros import PeerError
from uwsim.middleware.ros1.turns import Turns
from uwsim.middleware.ros1.xmlrpc import MAX_REQUEST, XmlRpcServer, call

REQUEST = b"<methodCall><methodName>getPid</methodName></methodCall>"


@pytest.fixture
def server() -> Iterator[XmlRpcServer]:
    log = Log("test", lambda line: None)
    new_server = XmlRpcServer("127.0.0.1", 0, {"getPid": lambda *_: [1, "", 5]}, log, "node")
    yield new_server
    new_server.close()


@pytest.fixture
def _one_request(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the first request take all the time there is."""
    monkeypatch.setattr(turns, "BURST", 1e-6)  # [s]
    monkeypatch.setattr(turns, "SHARE", 1e-7)


def post(server: XmlRpcServer, headers: dict[str, str], timeout: float = LIMIT) -> int:
    """Send a request; returns the status of its answer."""
    place = http.client.HTTPConnection("127.0.0.1", server.port, timeout=timeout)
    with closing(place) as connection:
        connection.request("POST", "/", gzip.compress(REQUEST), headers)
        return connection.getresponse().status


def test_a_compressed_request_is_refused(server: XmlRpcServer) -> None:
    assert post(server, {"Content-Encoding": "gzip"}) == 415
    assert call(f"http://127.0.0.1:{server.port}/", "getPid", "/x", timeout=LIMIT) == 5


@pytest.mark.usefixtures("_one_request")
def test_requests_wait_when_too_much_time_was_spent_on_them(server: XmlRpcServer) -> None:
    uri = f"http://127.0.0.1:{server.port}/"
    assert call(uri, "getPid", "/x", timeout=LIMIT) == 5
    with pytest.raises(PeerError, match="does not answer"):
        call(uri, "getPid", "/x", timeout=0.3)


@pytest.mark.usefixtures("_one_request")
def test_requests_that_are_refused_wait_as_well(server: XmlRpcServer) -> None:
    too_long = {"Content-Length": str(MAX_REQUEST + 1)}
    assert post(server, too_long) == 413
    with pytest.raises(TimeoutError):
        post(server, too_long, timeout=0.3)


def test_a_short_request_does_not_wait_behind_long_ones() -> None:
    shared_turns = Turns()
    order: list[int] = []

    def work(n_bytes: int) -> None:
        with shared_turns.turn(n_bytes):
            order.append(n_bytes)

    threads = [threading.Thread(target=work, args=(n,), daemon=True) for n in (900_000, 300)]
    with shared_turns.turn(0):
        for n_waiting, thread in enumerate(threads, 1):
            thread.start()
            wait_until(lambda n=n_waiting: len(shared_turns._waiting_turns) == n)
        assert not order
    for thread in threads:
        thread.join(LIMIT)
    assert order == [300, 900_000]
