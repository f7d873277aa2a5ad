"""A UDP port that talks to one peer, whose datagrams others cannot displace."""

from __future__ import annotations

import select
import socket
from collections.abc import Sequence

from ...world import Address
from .drop_counts import DropCounter

MAX_BYTES = 2048
"""The maximum size of a received datagram [bytes]; a longer one is cut."""


class PeerPort:
    """A UDP port of this computer (`uwsim.world.DatagramPort`).

    As soon as the peer is set, a second socket, connected to the peer, receives its datagrams. The
    kernel puts those of other senders into the queue of the first socket, where they wait or are
    dropped. However many they are, they neither delay nor displace those of the peer.

    Args:
        host: the address of this computer.
        port: the UDP port; 0: any free port.
    """

    def __init__(self, host: str, port: int) -> None:
        family, _, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_DGRAM)[0]
        self._open_socket = socket.socket(family, socket.SOCK_DGRAM)
        self._peer_socket: socket.socket | None = None
        self._peer: Address | None = None
        self._drops = DropCounter(self._open_socket)
        try:
            self._open_socket.setblocking(False)
            self._open_socket.bind(address)
        except OSError:
            self._open_socket.close()
            raise

    @property
    def address(self) -> Address:
        """The host and the port at which datagrams are received."""
        host, port = self._open_socket.getsockname()[:2]
        return host, port

    @property
    def peer(self) -> Address | None:
        """The host and the port of the peer; None if it is not known."""
        return self._peer

    def set_peer(self, peer: Address | None) -> None:
        """Set the peer; from now on, `receive` returns its datagrams only. None: anyone's."""
        if self._peer_socket is not None:
            self._peer_socket.close()
            self._peer_socket = None
        self._peer = peer
        if peer is None:
            return
        peer_socket = socket.socket(self._open_socket.family, socket.SOCK_DGRAM)
        try:
            for shared_socket in (self._open_socket, peer_socket):
                shared_socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            peer_socket.setblocking(False)
            peer_socket.bind(self._open_socket.getsockname())
            peer_socket.connect(peer)
        except OSError:
            peer_socket.close()
            raise
        finally:  # no other program shares the port
            self._open_socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 0)
        peer_socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 0)
        self._peer_socket = peer_socket

    def receive(self, timeout: float = 0.0) -> tuple[bytes, Address] | None:
        """Return the next datagram and its sender; wait for it for ``timeout`` [s] at most."""
        port_socket = self._peer_socket or self._open_socket
        data = _receive(port_socket)
        if data is not None or timeout <= 0.0:
            return data
        try:
            select.select([port_socket], [], [], timeout)
        except (OSError, ValueError):  # the port is closed
            return None
        return _receive(port_socket)

    def receive_others(self, limit: int) -> Sequence[tuple[bytes, Address]]:
        """Return datagrams of other senders than the peer, ``limit`` at most."""
        if self._peer_socket is None:
            return ()
        datagrams: list[tuple[bytes, Address]] = []
        while len(datagrams) < limit and (data := _receive(self._open_socket)) is not None:
            datagrams.append(data)
        return datagrams

    @property
    def n_dropped(self) -> int:
        """The number of datagrams that the system dropped, as those of others filled a queue."""
        return self._drops.n_dropped

    def send(self, data: bytes) -> bool:
        """Send a datagram to the peer; return False if there is none or it was not sent."""
        if self._peer_socket is None:
            return False
        try:
            self._peer_socket.send(data)
        except OSError:  # the peer's port is closed, or the network is down
            return False
        return True

    def close(self) -> None:
        """Close the port."""
        if self._peer_socket is not None:
            self._peer_socket.close()
        self._open_socket.close()


def _receive(port_socket: socket.socket) -> tuple[bytes, Address] | None:
    """Return a datagram and its sender; None if there is none."""
    for _ in range(2):  # an earlier send to a closed port is reported once, before the datagrams
        try:
            data, sender = port_socket.recvfrom(MAX_BYTES)
        except ConnectionError:
            continue
        except OSError:
            return None
        return data, (sender[0], sender[1])
    return None
