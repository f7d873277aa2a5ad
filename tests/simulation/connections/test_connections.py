"""Streams to programs outside: they never block, connect again, and have limits."""

from __future__ import annotations

import select
import socket
import time
from collections.abc import Callable, Iterator

import pytest

from uwsim.errors import UwsimError
from uwsim.simulation.connections import OpenConnections
from uwsim.simulation.connections.tcp_streams import MAX_SEND_BUFFER
from uwsim.world import ByteStream


@pytest.fixture
def connections() -> Iterator[OpenConnections]:
    opened = OpenConnections()
    yield opened
    opened.close()


def wait_until(is_true: Callable[[], bool]) -> None:
    end = time.monotonic() + 10.0
    while not is_true():
        assert time.monotonic() < end
        time.sleep(0.005)


def receive(stream: ByteStream, size: int) -> bytes:
    data = b""
    while len(data) < size:
        data += stream.receive(timeout=5.0)
    return data


def test_a_client_connects_to_a_server_that_starts_later(connections: OpenConnections) -> None:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    stream = connections.open(f"tcp:127.0.0.1:{port}")
    assert not stream.is_connected
    assert not stream.send(b"lost")
    assert stream.receive() == b""
    with socket.create_server(("127.0.0.1", port)) as server:
        peer, _ = server.accept()
        wait_until(lambda: stream.is_connected)
        assert stream.send(b"hello")
        assert peer.recv(5) == b"hello"
        peer.sendall(b"answer")
        assert receive(stream, 6) == b"answer"
        peer.close()
        wait_until(lambda: not stream.receive() and bool(select.select([server], [], [], 0)[0]))
        peer, _ = server.accept()  # it has connected again
        wait_until(lambda: stream.is_connected)
        peer.close()


def test_bytes_for_a_peer_that_does_not_read_are_refused_whole(
    connections: OpenConnections,
) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        stream = connections.open(f"tcp:127.0.0.1:{server.getsockname()[1]}")
        peer, _ = server.accept()
        wait_until(lambda: stream.is_connected)
        piece, n_sent = bytes(range(250)) * 4, 0
        while stream.send(piece):
            n_sent += len(piece)
            assert n_sent < 100_000_000
        assert n_sent > MAX_SEND_BUFFER
        received = b""
        while len(received) < n_sent:
            stream.receive()  # sends what waits
            received += peer.recv(65536)
        assert received == piece * (n_sent // len(piece))
        peer.close()


def test_a_server_has_one_client_after_the_other(connections: OpenConnections) -> None:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    stream = connections.open(f"tcpin:127.0.0.1:{port}")
    assert not stream.is_connected
    for text in (b"first", b"second"):
        with socket.create_connection(("127.0.0.1", port)) as client:
            client.sendall(text)
            assert receive(stream, len(text)) == text
            assert stream.send(b"yes")
            assert client.recv(3) == b"yes"
        wait_until(lambda: stream.receive() == b"" and not stream.is_connected)


def test_a_udp_port_answers_the_last_sender(connections: OpenConnections) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    server = connections.open(f"udpin:127.0.0.1:{port}")
    assert not server.is_connected
    assert not server.send(b"nobody")
    client = connections.open(f"udpout:127.0.0.1:{port}")
    assert client.send(b"question")
    assert receive(server, 8) == b"question"
    assert server.send(b"answer")
    assert receive(client, 6) == b"answer"
    assert client.receive() == b""


@pytest.mark.parametrize(
    ("address", "expected"),
    [
        ("tpc:127.0.0.1:5760", "Did you mean 'tcp'?"),
        ("tcp:5760", "expected tcp:HOST:PORT"),
        ("tcp:127.0.0.1:0", "expected tcp:HOST:PORT"),
        ("udpin:127.0.0.1:99999999999999999999", "expected udpin:HOST:PORT"),
        ("tcpin:203.0.113.1:5760", "cannot be opened"),
        ("udpout:no host:5760", "cannot be opened"),
    ],
)
def test_an_invalid_address_is_an_error_that_states_the_form(
    connections: OpenConnections, address: str, expected: str
) -> None:
    with pytest.raises(UwsimError, match=expected.replace("?", r"\?")):
        connections.open(address)


def test_the_system_probes_a_silent_peer(connections: OpenConnections) -> None:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    stream = connections.open(f"tcpin:127.0.0.1:{port}")
    with socket.create_connection(("127.0.0.1", port)):
        wait_until(lambda: stream.is_connected)
        connection = vars(stream)["_socket"]
        assert connection.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE)
        if hasattr(socket, "TCP_KEEPIDLE"):
            assert connection.getsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPIDLE) == 5
