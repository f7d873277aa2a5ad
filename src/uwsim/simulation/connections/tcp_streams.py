"""Streams of bytes over TCP, and a client that connects again."""

from __future__ import annotations

import select
import socket
import threading
from contextlib import suppress

MAX_RECEIVE = 65536
"""The greatest number of bytes that one call receives [bytes]."""
MAX_SEND_BUFFER = 65536
"""The greatest number of bytes that wait for a slow peer [bytes]."""
RETRY_PERIOD = 0.2
"""The wall time between two attempts to connect [s]."""
CONNECT_TIMEOUT = 1.0
"""The wall time after which an attempt to connect has failed [s]."""
KEEP_ALIVE = {"TCP_KEEPIDLE": 5, "TCP_KEEPINTVL": 2, "TCP_KEEPCNT": 3}
"""The options by which the connection to a peer that is gone without a word ends after 11 s, so
that it can connect again: silence before a probe [s], the time between probes [s], their number."""


def acknowledge(connection: socket.socket) -> None:
    """Acknowledge what has arrived at once, where the system can.

    A peer that collects its bytes (Nagle's algorithm) would wait 40 ms for the acknowledgement.
    """
    option = getattr(socket, "TCP_QUICKACK", None)  # of Linux, which resets it after a while
    if option is not None:
        with suppress(OSError):
            connection.setsockopt(socket.IPPROTO_TCP, option, 1)


class TcpStream:
    """A TCP connection that does not block; the base of client and server."""

    def __init__(self) -> None:
        self._socket: socket.socket | None = None
        self._send_buffer = bytearray()

    @property
    def is_connected(self) -> bool:
        """True if there is a peer."""
        return self._socket is not None

    def receive(self, timeout: float = 0.0) -> bytes:
        """Return bytes that have arrived; wait for the first one for ``timeout`` [s] at most."""
        connection = self._socket
        if connection is None:
            return b""
        self._flush(connection)
        try:
            if timeout > 0.0:
                select.select([connection], [], [], timeout)
            data = connection.recv(MAX_RECEIVE)
            acknowledge(connection)
        except BlockingIOError:
            return b""
        except (OSError, ValueError):
            data = b""
        if not data:
            self._drop(connection)
        return data

    def send(self, data: bytes) -> bool:
        """Send all of ``data`` or nothing; return False if there is no peer or it does not read."""
        connection = self._socket
        if connection is None or len(self._send_buffer) + len(data) > MAX_SEND_BUFFER:
            return False
        self._send_buffer += data
        self._flush(connection)
        return self._socket is not None

    def _flush(self, connection: socket.socket) -> None:
        try:
            while self._send_buffer:
                del self._send_buffer[: connection.send(self._send_buffer)]
        except BlockingIOError:
            pass
        except OSError:
            self._drop(connection)

    def _adopt(self, connection: socket.socket) -> None:
        """Use a new connection."""
        connection.setblocking(False)
        with suppress(OSError):
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        with suppress(OSError, AttributeError):  # AttributeError: an option that a system lacks
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
            for name, value in KEEP_ALIVE.items():
                connection.setsockopt(socket.IPPROTO_TCP, getattr(socket, name), value)
        self._send_buffer.clear()
        self._socket = connection

    def _drop(self, connection: socket.socket) -> None:
        """Close the connection, which the peer has closed or which has failed."""
        connection.close()
        self._socket = None


class TcpClient(TcpStream):
    """A TCP client; a thread connects it to the server, also after a loss of the connection."""

    def __init__(self, host: str, port: int) -> None:
        super().__init__()
        self._address = (host, port)
        self._is_closed = threading.Event()
        self._connect()

    def _connect(self) -> None:
        self._thread = threading.Thread(target=self._try_to_connect, daemon=True)
        self._thread.start()

    def _try_to_connect(self) -> None:
        while not self._is_closed.is_set():
            try:
                connection = socket.create_connection(self._address, timeout=CONNECT_TIMEOUT)
            except OSError:
                self._is_closed.wait(RETRY_PERIOD)
                continue
            if connection.getsockname() == connection.getpeername():  # TCP connected to itself
                connection.close()
                self._is_closed.wait(RETRY_PERIOD)
                continue
            self._adopt(connection)
            return

    def _drop(self, connection: socket.socket) -> None:
        super()._drop(connection)
        if not self._is_closed.is_set():
            self._connect()

    def close(self) -> None:
        """Close the connection; connect no more."""
        self._is_closed.set()
        self._thread.join(timeout=CONNECT_TIMEOUT + RETRY_PERIOD)
        if self._socket is not None:
            self._drop(self._socket)
