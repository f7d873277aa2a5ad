"""The open connections of a scene, by their addresses."""

from __future__ import annotations

from typing import Protocol

from ...errors import UwsimError, did_you_mean
from ...world import ByteStream
from .tcp_streams import TcpClient, TcpServer
from .udp_streams import UdpStream

KINDS = ("tcp", "tcpin", "udpin", "udpout")
"""The kinds of addresses (`uwsim.world.Connections.open`)."""


class _ClosableStream(ByteStream, Protocol):
    def close(self) -> None: ...


class OpenConnections:
    """The open streams of a scene (`uwsim.world.Connections`)."""

    def __init__(self) -> None:
        self._streams: list[_ClosableStream] = []

    def open(self, address: str) -> ByteStream:
        """Open a stream; raise UwsimError if the address is invalid or its port is not free."""
        kind, host, port = parse_address(address)
        try:
            stream = _open_stream(kind, host, port)
        except OSError as error:
            reason = error.strerror or error
            raise UwsimError(f"{address} cannot be opened: {reason}.") from None
        self._streams.append(stream)
        return stream

    def close(self) -> None:
        """Close all streams."""
        for stream in self._streams:
            stream.close()
        self._streams.clear()


def _open_stream(kind: str, host: str, port: int) -> _ClosableStream:
    if kind == "tcp":
        return TcpClient(host, port)
    if kind == "tcpin":
        return TcpServer(host, port)
    return UdpStream(host, port, is_bound=kind == "udpin")


def parse_address(address: str) -> tuple[str, str, int]:
    """Return the kind, the host and the port of an address; raise UwsimError if it is invalid."""
    kind, _, rest = address.partition(":")
    host, _, port = rest.rpartition(":")
    if kind not in KINDS:
        raise UwsimError(
            f"{address[:80]!r} is not an address: its kind is {kind[:40]!r}; expected "
            f"{', '.join(KINDS)}.{did_you_mean(kind, KINDS)}"
        )
    if not host or not (port.isascii() and port.isdigit()) or not 0 < int(port[:9]) < 65536:
        raise UwsimError(f"{address[:80]!r} is not an address; expected {kind}:HOST:PORT.")
    return kind, host.strip("[]"), int(port)
