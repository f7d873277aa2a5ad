"""Connections of WebSocket servers take no more than their share, of time and of open files."""

from __future__ import annotations

import contextlib
import json
import socket
from collections.abc import Iterator

import pytest
from websockets.sync.client import connect

from tests.support.waiting import wait_until
from uwsim.bus import Bus
from uwsim.middleware import limited_connection
from uwsim.middleware.limited_connection import LARGE_FRAME, ConnectionLimits, LimitedConnection
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.server import WebBridge
from uwsim.viewer.live.server import LiveServer

N_WAITING = 64
"""Connections that may be open without a handshake."""
PING = b"\x89\x80\0\0\0\0"
"""A frame that asks a server whether it is there, masked."""


@contextlib.contextmanager
def web_bridge() -> Iterator[WebBridge]:
    new_bridge = WebBridge(Bus(), lambda: 0.0, WebOptions(port=0), Log("web", lambda line: None))
    new_bridge.step()
    yield new_bridge
    new_bridge.close()


@pytest.fixture
def bridge() -> Iterator[WebBridge]:
    with web_bridge() as new_bridge:
        yield new_bridge


@pytest.fixture
def impatient(bridge: WebBridge, monkeypatch: pytest.MonkeyPatch) -> WebBridge:
    """A server whose clients have a small burst, and pause for a short time only."""
    monkeypatch.setattr(limited_connection, "PAUSE", 0.01)
    limits = bridge._limits
    limits.share, limits.burst, limits.work = 0.5, 0.001, None
    return bridge


@contextlib.contextmanager
def serve(kind: str) -> Iterator[tuple[int, str, ConnectionLimits]]:
    """A server: its port, the address of its socket, and its limits."""
    if kind == "web":
        with web_bridge() as bridge:
            yield bridge.port, f"ws://127.0.0.1:{bridge.port}", bridge._limits
    else:
        server = LiveServer(lambda: "page")
        address = server.url.replace("http://", "ws://").replace("/?", "/socket?")
        yield server.port, address, server._limits
        server.close()


@pytest.mark.parametrize("kind", ["web", "view"])
def test_connections_that_say_nothing_take_few_open_files(kind: str) -> None:
    with serve(kind) as (port, address, limits), contextlib.ExitStack() as stack:
        n = 3 * N_WAITING
        clients = [
            stack.enter_context(socket.create_connection(("127.0.0.1", port))) for _ in range(n)
        ]
        for entry in clients[: n - N_WAITING]:  # the oldest are broken off
            entry.settimeout(60.0)
            with contextlib.suppress(ConnectionResetError):
                assert entry.recv(1) == b""
        assert len(limits._open_connections) <= N_WAITING
        with connect(address, open_timeout=60.0) as client:  # there is room for who asks
            assert client.ping().wait(60.0)


@pytest.mark.slow
def test_pings_beyond_the_share_wait(impatient: WebBridge, monkeypatch: pytest.MonkeyPatch) -> None:
    """The library answers them itself, before anything of ours sees them."""
    pauses: list[float] = []
    pause = LimitedConnection.pause

    def count_pause(connection: LimitedConnection) -> float:
        assert pause.fget is not None
        actual: float = pause.fget(connection)
        pauses.extend([actual] if actual else [])
        return actual

    monkeypatch.setattr(LimitedConnection, "pause", property(count_pause))
    with connect(f"ws://127.0.0.1:{impatient.port}", ping_interval=None) as client:
        wait_until(lambda: len(pauses) > 3, lambda: client.socket.sendall(PING * 1000))
    assert any("sends faster than the server reads" in line for line in impatient.log.lines)


def test_pings_within_the_share_are_answered(bridge: WebBridge) -> None:
    with connect(f"ws://127.0.0.1:{bridge.port}", ping_interval=None) as client:
        for _ in range(5):
            assert client.ping().wait(60.0)
    assert not any("sends faster" in line for line in bridge.log.lines)


def test_who_rests_is_read_again(impatient: WebBridge) -> None:
    with connect(f"ws://127.0.0.1:{impatient.port}", ping_interval=None) as client:
        client.socket.sendall(PING * 20_000)
        assert client.ping(b"the last").wait(60.0)


def test_a_large_frame_counts_wholly_for_its_client_and_little_for_others(
    bridge: WebBridge,
) -> None:
    limits = bridge._limits
    with connect(f"ws://127.0.0.1:{bridge.port}") as client:
        client.ping().wait(60.0)
        (connection,) = limits._open_connections
        connection.spend(0.5)  # [s]
        assert 15.0 < connection.pause < 26.0  # 0.5 s are 2 % of 25 s
        assert limits.work is not None
        assert limits.work.delay < 2.0


def test_a_large_frame_waits_for_large_frames_of_others_alone(bridge: WebBridge) -> None:
    """A new connection has a new budget: two that take turns took half of the time."""
    large_frame = json.dumps({"op": "nonsense", "id": "large", "blanks": " " * LARGE_FRAME})
    small_frame = json.dumps({"op": "nonsense", "id": "small"})
    address = f"ws://127.0.0.1:{bridge.port}"
    with connect(address) as client:
        client.send(large_frame)
        assert json.loads(client.recv(60.0))["id"] == "large"
    bridge._limits.large_frames.spend(0.3)  # [s] of another client: 15 s are to go by
    with connect(address) as client, connect(address) as other:
        client.send(large_frame)
        other.send(small_frame)
        assert json.loads(other.recv(60.0))["id"] == "small"
        with pytest.raises(TimeoutError):
            client.recv(1.0)
        bridge._limits.large_frames.spend(-1.0)
        assert json.loads(client.recv(60.0))["id"] == "large"


def test_a_large_frame_of_who_has_left_is_not_handled(bridge: WebBridge) -> None:
    bridge._limits.large_frames.spend(1e6)
    with connect(f"ws://127.0.0.1:{bridge.port}") as client:
        client.send(json.dumps({"op": "nonsense", "blanks": " " * LARGE_FRAME}))
        assert client.ping().wait(60.0)
        (session,) = bridge._sessions
    wait_until(lambda: not bridge._sessions)
    assert not any("nonsense" in line for line in bridge.log.lines)
    assert session._has_left
