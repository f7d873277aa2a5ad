"""The TCP port of a node: accepts subscribers and clients of services, each in a thread."""

from __future__ import annotations

import re
import socket
import threading
from collections.abc import Callable

from ..log import Log
from .tcpros import PeerError, close, encode_header, read_header, write

MAX_CONNECTIONS = 256
"""The maximum number of open connections; further connections are closed."""
NUMBER_PATTERN = re.compile(r"[0-9a-f]{32}|[0-9]+")
"""The pattern of MD5 sums and lengths, which are left out of the kind of an event in the log."""
HEADER_TIMEOUT = 10.0
"""The time limit for a client to send its whole header [s]."""
Serve = Callable[[socket.socket, dict[str, str]], None]
"""A function that serves a connection, given its header; it may raise PeerError."""


class Listener:
    """A TCP server that listens until `close`.

    Args:
        host: the address to listen on.
        log: the log for events.
        find_handler: a function that returns, for the header of a connection, the function that
            serves the connection, or the text of a refusal.
        header_timeout: the time limit for a client to send its header [s].
    """

    def __init__(
        self,
        host: str,
        log: Log,
        find_handler: Callable[[dict[str, str]], Serve | str],
        *,
        header_timeout: float = HEADER_TIMEOUT,
    ) -> None:
        self._log, self._find_handler, self._header_timeout = log, find_handler, header_timeout
        self._lock = threading.Lock()
        self._connections: set[socket.socket] = set()
        self._is_closed = False
        self._socket = socket.create_server((host, 0), backlog=128)
        self.port = int(self._socket.getsockname()[1])
        """The port of the server."""
        threading.Thread(target=self._accept, name="ros1-listener", daemon=True).start()

    def _accept(self) -> None:
        while True:
            try:
                connection, _ = self._socket.accept()
            except OSError:
                if self._is_closed:
                    return
                continue
            with self._lock:
                is_full = len(self._connections) >= MAX_CONNECTIONS
                if not is_full and not self._is_closed:
                    self._connections.add(connection)
            if is_full or self._is_closed:
                self._log.report(f"more than {MAX_CONNECTIONS} connections; one is refused")
                close(connection)
                continue
            threading.Thread(
                target=self._serve, args=(connection,), name="ros1-connection", daemon=True
            ).start()

    def _serve(self, connection: socket.socket) -> None:
        caller = "a peer"
        try:
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            connection.settimeout(self._header_timeout)
            header = read_header(connection, self._header_timeout)
            connection.settimeout(self._header_timeout)
            caller = header.get("callerid", caller)[:100]
            handler = self._find_handler(header)
            if isinstance(handler, str):
                write(connection, encode_header({"error": handler}))
                raise PeerError(f"it was refused: {handler}")
            handler(connection, header)
        except (PeerError, OSError) as error:
            if not self._is_closed:
                self._log.report(
                    f"{caller}: {error}", kind=NUMBER_PATTERN.sub("#", f"connection {error}")[:200]
                )
        finally:
            with self._lock:
                self._connections.discard(connection)
            close(connection)

    @property
    def n_connections(self) -> int:
        """The number of open connections."""
        return len(self._connections)

    def close(self) -> None:
        """Stop listening and close all connections."""
        with self._lock:
            self._is_closed = True
            connections = list(self._connections)
        close(self._socket)
        for connection in connections:
            close(connection)
