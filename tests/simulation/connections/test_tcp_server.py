"""A server of one client: a newer client replaces a silent one, and no other."""

from __future__ import annotations

import select
import socket
from collections.abc import Iterator

import pytest

from uwsim.simulation.connections.tcp_server import SILENCE, START_SILENCE, TcpServer


class Clock:
    """A wall clock that the test moves."""

    def __init__(self) -> None:
        self.time = 100.0

    def __call__(self) -> float:
        return self.time


class Site:
    """A server with a clock, and its printed lines."""

    def __init__(self) -> None:
        self.clock, self.lines = Clock(), list[str]()
        with socket.create_server(("127.0.0.1", 0)) as probe:
            self.port: int = probe.getsockname()[1]
        self.server = TcpServer(
            "127.0.0.1", self.port, now=self.clock, report_line=self.lines.append
        )

    def connect(self) -> socket.socket:
        """Return a new client, which has connected."""
        return socket.create_connection(("127.0.0.1", self.port), timeout=5.0)

    def poll(self, duration: float) -> bytes:
        """Receive for a time of the clock, as a simulation does in each of its steps."""
        data = b""
        for _ in range(round(duration / 0.1)):
            self.clock.time += 0.1
            data += self.server.receive()
        return data


@pytest.fixture
def site() -> Iterator[Site]:
    made_site = Site()
    yield made_site
    made_site.server.close()


def has_ended(client: socket.socket) -> bool:
    try:
        return bool(select.select([client], [], [], 5.0)[0]) and client.recv(1) == b""
    except ConnectionResetError:  # it was closed with bytes that nobody has read
        return True


def test_a_newer_client_replaces_one_that_has_sent_nothing(site: Site) -> None:
    with site.connect() as silent, site.connect() as controller:
        controller.sendall(b"command")
        assert site.poll(START_SILENCE - 0.3) == b""
        assert site.poll(0.8) == b"command"
        assert has_ended(silent)
    assert (site.server.n_clients, site.server.n_replaced, site.server.n_waiting) == (2, 1, 1)
    assert len(site.lines) == 2
    assert "a second client waits" in site.lines[0]
    assert "which was silent for 2." in site.lines[1]
    assert "2 clients; 1 silent clients replaced" in site.server.events


def test_a_client_that_has_sent_has_more_time(site: Site) -> None:
    with site.connect() as first, site.connect() as second:
        first.sendall(b"1")
        select.select([], [first], [], 5.0)
        assert site.server.receive(5.0) == b"1"
        second.sendall(b"2")
        assert site.poll(SILENCE - 0.3) == b""
        assert site.poll(0.8) == b"2"


def test_a_client_that_sends_stays(site: Site) -> None:
    with site.connect() as first, site.connect() as second:
        second.sendall(b"2")
        for _ in range(20):
            first.sendall(b"1")
            assert site.server.receive(5.0) == b"1"
            site.poll(1.0)
    assert (site.server.n_clients, site.server.n_replaced) == (1, 0)
    assert len(site.lines) == 1


def test_a_simulation_that_stands_still_replaces_nobody(site: Site) -> None:
    with site.connect() as first, site.connect():
        first.sendall(b"1")
        assert site.server.receive(5.0) == b"1"
        for _ in range(10):
            site.clock.time += 60.0
            assert site.server.receive() == b""
    assert site.server.n_replaced == 0


def test_a_reader_that_takes_its_bytes_stays(site: Site) -> None:
    with site.connect() as reader, site.connect():
        for _ in range(100):
            site.clock.time += 0.5
            assert site.server.send(b"reading")
            assert reader.recv(7) == b"reading"
    assert (site.server.n_clients, site.server.n_replaced) == (1, 0)


def test_a_reader_whose_buffers_are_full_is_replaced(site: Site) -> None:
    with site.connect(), site.connect() as reader:
        piece = b"x" * 10_000
        while site.server.send(piece):
            site.clock.time += 0.001
        for _ in range(40):
            site.clock.time += 0.1
            site.server.send(piece)
        assert reader.recv(1) == b"x"
    assert site.server.n_replaced == 1


def test_of_several_waiting_clients_the_newest_is_accepted(site: Site) -> None:
    with site.connect(), site.connect() as older, site.connect() as newer:
        older.sendall(b"older")
        newer.sendall(b"newer")
        assert site.poll(3.0) == b"newer"
        assert has_ended(older)


def test_many_events_print_few_lines(site: Site) -> None:
    clients = [site.connect()]
    for _ in range(10):
        clients.append(site.connect())
        site.poll(3.0)
    assert site.server.n_replaced == 10
    assert len(site.lines) == 4
    for client in clients:
        client.close()
