"""The server ends with every connection closed, in whatever state it is."""

from __future__ import annotations

import gc
import socket
import sys
from contextlib import ExitStack

import pytest

from tests.support.handshakes import request_of
from tests.support.waiting import LIMIT, wait_until
from uwsim.bus import Bus
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.server import WebBridge


@pytest.fixture
def unraisable_errors(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Record what goes wrong where no error can be raised: a transport that was never closed."""
    monkeypatch.setattr("uwsim.middleware.web.server.CLOSE_TIMEOUT", 0.2)  # [s]
    actual: list[str] = []

    def record(args: sys.UnraisableHookArgs) -> None:
        actual.append(repr(args.exc_value))

    monkeypatch.setattr(sys, "unraisablehook", record)
    return actual


def open_connections() -> WebBridge:
    bridge = WebBridge(Bus(), lambda: 0.0, WebOptions(port=0), Log("web", lambda line: None))
    bridge.step()
    return bridge


def peer(bridge: WebBridge) -> socket.socket:
    return socket.create_connection(("127.0.0.1", bridge.port), LIMIT)


def close(bridge: WebBridge) -> None:
    bridge.close()
    assert not bridge._thread.is_alive()
    gc.collect()


def test_connections_that_are_accepted_while_it_closes_are_closed(
    unraisable_errors: list[str],
) -> None:
    bridge = open_connections()
    with ExitStack() as peers:

        def come_and_end() -> None:
            """Connect, and end the server in the same turn of its loop."""
            for _ in range(5):
                peers.enter_context(peer(bridge))
            assert bridge._end_event is not None
            bridge._end_event.set()

        bridge._loop.call_soon_threadsafe(come_and_end)
        bridge._thread.join(LIMIT)
        close(bridge)
    assert unraisable_errors == []


def test_connections_without_a_handshake_are_closed(unraisable_errors: list[str]) -> None:
    bridge = open_connections()
    with peer(bridge), peer(bridge) as second:
        second.sendall(b"GET / HTTP/1.1\r\n")
        wait_until(lambda: len(bridge._limits._open_connections) == 2)
        close(bridge)
    assert unraisable_errors == []


def test_a_connection_whose_client_takes_nothing_is_closed(unraisable_errors: list[str]) -> None:
    bridge = open_connections()
    with peer(bridge) as client:
        client.sendall(request_of("GET / HTTP/1.1"))
        assert client.recv(12) == b"HTTP/1.1 101"
        wait_until(lambda: bridge._sessions)
        (session,) = bridge._sessions
        for _ in range(8):
            session.reply({"op": "status", "msg": 2**20 * "a"})
        (connection,) = bridge._limits._open_connections
        wait_until(connection.transport.get_write_buffer_size)
        close(bridge)
    assert unraisable_errors == []
