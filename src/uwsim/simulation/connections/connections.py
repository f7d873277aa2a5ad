"""The open connections of a scene, by their addresses."""

from __future__ import annotations

from typing import Protocol

from ...base.terminal import warn
from ...errors import UwsimError
from ...world import ByteStream
from ...world.addresses import parse_address
from .datagram_port import PeerPort
from .serial_streams import PseudoTerminal, SerialStream
from .tcp_server import TcpServer
from .tcp_streams import TcpClient
from .udp_streams import UdpStream


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
        """Close all streams and ports, and print their unusual events."""
        for stream in self._streams:
            if isinstance(stream, TcpServer | UdpStream) and stream.events:
                warn(stream.events)
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
