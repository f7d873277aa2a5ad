"""Streams of bytes as UDP datagrams."""

from __future__ import annotations

import select
import socket

from .drop_counts import DropCounter

MAX_BYTES = 65536
"""The greatest size of a datagram [bytes]."""


class UdpStream:
    """A UDP port that does not block.

    Args:
        host: the address of the peer, or of this computer.
        port: the UDP port.
        is_bound: True to receive at the address and to answer the last sender; False to send to the
            address, and to receive from it alone.
    """

    def __init__(self, host: str, port: int, *, is_bound: bool) -> None:
        family, _, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_DGRAM)[0]
        self._socket = socket.socket(family, socket.SOCK_DGRAM)
        self._peer = None if is_bound else address
        try:
            self._socket.setblocking(False)
            if is_bound:
                self._socket.bind(address)
            else:
                self._socket.connect(address)
        except OSError:
            self._socket.close()
            raise
        self._is_bound = is_bound
        self._name, self._drops = f"UDP {host}:{port}", DropCounter(self._socket)

    @property
    def is_connected(self) -> bool:
        """True if the address of the peer is known."""
        return self._peer is not None

    @property
    def events(self) -> str:
        """The number of datagrams that the system dropped; empty if there are none."""
        n_dropped = self._drops.n_dropped
        return f"{self._name}: {n_dropped} datagrams dropped, as the queue was full" * (
            n_dropped > 0
        )

    def receive(self, timeout: float = 0.0) -> bytes:
        """Return the next datagram; wait for it for ``timeout`` [s] at most; empty if none."""
        try:
            if timeout > 0.0:
                select.select([self._socket], [], [], timeout)
            data, sender = self._socket.recvfrom(MAX_BYTES)
        except (OSError, ValueError):  # nothing has arrived, or the peer's port is not open
            return b""
        if self._is_bound:
            self._peer = sender
        return data

    def send(self, data: bytes) -> bool:
        """Send a datagram; return False if no peer is known, or its port is known to be closed."""
        if self._peer is None:
            return False
        try:
            if self._is_bound:
                self._socket.sendto(data, self._peer)
                return True
            try:
                self._socket.send(data)
            except ConnectionError:  # of an earlier datagram
                self._socket.send(data)
        except OSError:
            return False
        # on this computer, the answer of a port that nobody has opened is here at once
        return not self._socket.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)

    def close(self) -> None:
        """Close the port."""
        self._socket.close()
