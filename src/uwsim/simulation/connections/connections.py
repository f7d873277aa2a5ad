"""The open connections of a scene, by their addresses."""

from __future__ import annotations

from typing import Protocol

from ...errors import UwsimError, did_you_mean
from ...world import ByteStream
from .datagram_port import PeerPort
from .serial_streams import PseudoTerminal, SerialStream
from .tcp_streams import TcpClient, TcpServer
from .udp_streams import UdpStream

KINDS = ("tcp", "tcpin", "udpin", "udpout", "serial", "pty")
"""The kinds of addresses (`uwsim.world.Connections.open`)."""

MAX_BIT_RATE = 10_000_000
"""The greatest bit rate of a serial line [bit/s]."""


class _ClosableStream(ByteStream, Protocol):
    def close(self) -> None: ...


class OpenConnections:
    """The open streams and ports of a scene (`uwsim.world.Connections`).

    Args:
        host: the address of this computer at which `open_port` opens ports.
    """

    def __init__(self, host: str = "127.0.0.1") -> None:
        self._host = host
        self._streams: list[_ClosableStream | PeerPort] = []

    def open(self, address: str) -> ByteStream:
        """Open a stream; raise UwsimError if the address is invalid or its port is not free."""
        kind, host, number = parse_address(address)
        try:
            stream = _open_stream(kind, host, number)
        except OSError as error:
            reason = error.strerror or error
            raise UwsimError(f"{address} cannot be opened: {reason}.") from None
        self._streams.append(stream)
        return stream

    def open_port(self, port: int) -> PeerPort:
        """Open a UDP port that talks to one peer; raise UwsimError if it is not free."""
        try:
            peer_port = PeerPort(self._host, port)
        except OSError as error:
            reason = error.strerror or error
            raise UwsimError(
                f"UDP port {port} of {self._host} cannot be opened: {reason}."
            ) from None
        self._streams.append(peer_port)
        return peer_port

    def close(self) -> None:
        """Close all streams and ports."""
        for stream in self._streams:
            stream.close()
        self._streams.clear()


def _open_stream(kind: str, host: str, number: int) -> _ClosableStream:
    if kind == "serial":
        return SerialStream(host, number)
    if kind == "pty":
        return PseudoTerminal(host)
    if kind == "tcp":
        return TcpClient(host, number)
    if kind == "tcpin":
        return TcpServer(host, number)
    return UdpStream(host, number, is_bound=kind == "udpin")


def parse_address(address: str) -> tuple[str, str, int]:
    """Return the parts of an address; raise UwsimError if it is invalid.

    Returns:
        The kind, the host or path, and the port or the bit rate [bit/s].
    """
    kind, _, rest = address.partition(":")
    if kind not in KINDS:
        raise UwsimError(
            f"{address[:80]!r} is not an address: its kind is {kind[:40]!r}; expected "
            f"{', '.join(KINDS)}.{did_you_mean(kind, KINDS)}"
        )
    if kind == "pty":
        return kind, rest, 0
    host, _, number = rest.rpartition(":")
    max_number = MAX_BIT_RATE if kind == "serial" else 65535
    is_number = number.isascii() and number.isdigit()
    if not host or not is_number or not 0 < int(number[:9]) <= max_number:
        form = "serial:PATH:BIT_RATE" if kind == "serial" else f"{kind}:HOST:PORT"
        raise UwsimError(f"{address[:80]!r} is not an address; expected {form}.")
    return kind, host.strip("[]"), int(number)
