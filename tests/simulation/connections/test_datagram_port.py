"""A port with a peer: others neither displace nor delay its datagrams, and are counted."""

from __future__ import annotations

import socket
import sys
from collections.abc import Iterator

import pytest

from uwsim.errors import UwsimError
from uwsim.simulation.connections import OpenConnections
from uwsim.world import DatagramPort


@pytest.fixture
def port() -> Iterator[DatagramPort]:
    connections = OpenConnections()
    yield connections.open_port(0)
    connections.close()


@pytest.fixture
def peer() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer:
        peer.bind(("127.0.0.1", 0))
        peer.settimeout(5.0)
        yield peer


def test_anyone_is_heard_until_the_peer_is_set(port: DatagramPort, peer: socket.socket) -> None:
    assert port.receive() is None
    assert not port.send(b"nobody")
    peer.sendto(b"hello", port.address)
    assert port.receive(timeout=5.0) == (b"hello", peer.getsockname())
    port.set_peer(peer.getsockname())
    assert port.peer == peer.getsockname()
    assert port.send(b"answer")
    assert peer.recvfrom(100) == (b"answer", port.address)


def test_a_flood_of_others_does_not_displace_the_peer(
    port: DatagramPort, peer: socket.socket
) -> None:
    port.set_peer(peer.getsockname())
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as flood:
        flood.bind(("127.0.0.1", 0))
        for _ in range(20_000):  # more than a queue of the kernel holds
            flood.sendto(b"x" * 1000, port.address)
        peer.sendto(b"hello", port.address)
        assert port.receive(timeout=5.0) == (b"hello", peer.getsockname())
        assert port.receive() is None
        assert port.receive_others(3) == [(b"x" * 1000, flood.getsockname())] * 3
        n_read = 3 + len(port.receive_others(20_000))
        if sys.platform == "linux":
            assert n_read + port.n_dropped == 20_000


def test_another_peer_replaces_the_first(port: DatagramPort, peer: socket.socket) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as first:
        first.bind(("127.0.0.1", 0))
        port.set_peer(first.getsockname())
    assert port.send(b"into a closed port")
    port.set_peer(None)
    peer.sendto(b"second", port.address)
    assert port.receive(timeout=5.0) == (b"second", peer.getsockname())
    port.set_peer(peer.getsockname())
    peer.sendto(b"third", port.address)
    assert port.receive(timeout=5.0) == (b"third", peer.getsockname())


def test_a_closed_peer_does_not_end_the_port(port: DatagramPort, peer: socket.socket) -> None:
    address = peer.getsockname()
    port.set_peer(address)
    peer.close()
    for _ in range(3):
        port.send(b"lost")
        assert port.receive(timeout=0.01) is None
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as restarted:
        restarted.bind(address)
        restarted.sendto(b"again", port.address)
        assert port.receive(timeout=5.0) == (b"again", address)


def test_a_huge_datagram_is_cut(port: DatagramPort, peer: socket.socket) -> None:
    peer.sendto(b"x" * 60_000, port.address)
    received = port.receive(timeout=5.0)
    assert received is not None
    assert len(received[0]) == 2048


def test_no_other_program_shares_the_port(port: DatagramPort, peer: socket.socket) -> None:
    port.set_peer(peer.getsockname())
    number = port.address[1]
    with pytest.raises(UwsimError, match=rf"UDP port {number} of 127.0.0.1 cannot be opened"):
        OpenConnections().open_port(number)
