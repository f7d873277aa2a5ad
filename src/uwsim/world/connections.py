"""Protocols of streams of bytes to programs and instruments outside of the simulation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

Address = tuple[str, int]
"""The host and the port of a program outside."""


class ByteStream(Protocol):
    """A stream of bytes to one peer outside; its methods raise no error if the peer is absent."""

    @property
    def is_connected(self) -> bool:
        """True if there is a peer to which bytes can be sent."""

    def receive(self, timeout: float = 0.0) -> bytes:
        """Return bytes that have arrived, 64 KiB at most; empty if there are none.

        Args:
            timeout: the wall time for which to wait for the first byte [s].
        """

    def send(self, data: bytes) -> bool:
        """Send all of ``data``, or nothing; return False if there is no peer or it does not read.

        Datagrams contain exactly the bytes of one call.
        """


@runtime_checkable
class TerminalStream(ByteStream, Protocol):
    """A stream of a pseudo-terminal, whose path the other side has to know."""

    @property
    def has_reader(self) -> bool:
        """True if a program has read sent bytes; the terminal keeps some that nobody reads."""

    @property
    def path(self) -> str:
        """The path of the terminal."""


@runtime_checkable
class ServerStream(ByteStream, Protocol):
    """A stream of a server of one client at a time, which another one may replace."""

    @property
    def n_clients(self) -> int:
        """The number of clients so far."""


class DatagramPort(Protocol):
    """A UDP port that talks to one peer, whose datagrams others cannot displace."""

    @property
    def address(self) -> Address:
        """The host and the port at which datagrams are received."""

    @property
    def peer(self) -> Address | None:
        """The host and the port of the peer; None if it is not known."""

    def set_peer(self, peer: Address | None) -> None:
        """Set the peer; from now on, `receive` returns its datagrams only. None: anyone's."""

    def receive(self, timeout: float = 0.0) -> tuple[bytes, Address] | None:
        """Return the next datagram and its sender; wait for it for ``timeout`` [s] at most."""

    def receive_others(self, limit: int) -> Sequence[tuple[bytes, Address]]:
        """Return datagrams of other senders than the peer, ``limit`` at most."""

    @property
    def n_dropped(self) -> int:
        """The number of datagrams that the system dropped, as those of others filled a queue."""

    def send(self, data: bytes) -> bool:
        """Send a datagram to the peer; return False if there is none or it was not sent."""


class Connections(Protocol):
    """The connections of a simulation to programs outside, which it closes at its end."""

    def open(self, address: str) -> ByteStream:
        """Open a stream at an address, and return it at once; it connects when it can.

        Args:
            address: ``tcp:HOST:PORT`` connects to a server, and again if it is lost;
                ``tcpin:HOST:PORT`` waits for one client, which a newer one replaces if it is
                silent; ``udpout:HOST:PORT`` sends datagrams to
                an address; ``udpin:HOST:PORT`` receives them, and answers the last sender;
                ``serial:PATH:BIT_RATE`` is a serial line; ``pty`` or ``pty:LINK`` is a
                pseudo-terminal, with a symbolic link to it.

        Raises:
            UwsimError: the address is invalid, or its port is not free.
        """

    def open_port(self, port: int) -> DatagramPort:
        """Open a UDP port of this computer that talks to one peer; raise UwsimError if not free."""
