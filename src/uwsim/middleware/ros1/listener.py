"""The TCP port of a node: accepts subscribers and clients of services, each in a thread."""

from __future__ import annotations

import re
import socket
import threading
from collections.abc import Callable

from ..log import Log
from .tcpros import PeerError, close, encode_header, read_header, write

MAX_CONNECTIONS = 256
"""Connections at the same time; more are closed."""
NUMBER = re.compile(r"[0-9a-f]{32}|[0-9]+")
"""What does not tell two kinds of events apart: MD5 sums, lengths."""
HEADER_TIMEOUT = 10.0
"""How long a client may take to send its whole header [s]."""
Serve = Callable[[socket.socket, dict[str, str]], None]
"""Serves a connection with its header; may raise PeerError."""


class Listener:
    """Listens until `close`.

    Args:
        host: address to listen on.
        log: where it reports.
        choose: returns what serves a connection header, or the text of a refusal.
        header_timeout: how long a client may take to send its header [s].
    """

    def __init__(
        self,
        host: str,
        log: Log,
        choose: Callable[[dict[str, str]], Serve | str],
        *,
        header_timeout: float = HEADER_TIMEOUT,
    ) -> None:
        self._log, self._choose, self._header_timeout = log, choose, header_timeout
        self._lock = threading.Lock()
        self._open: set[socket.socket] = set()
        self._is_closed = False
        self._socket = socket.create_server((host, 0), backlog=128)
        self.port = int(self._socket.getsockname()[1])
        """Its port."""
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
                is_full = len(self._open) >= MAX_CONNECTIONS
                if not is_full and not self._is_closed:
                    self._open.add(connection)
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
            serve = self._choose(header)
            if isinstance(serve, str):
                write(connection, encode_header({"error": serve}))
                raise PeerError(f"it was refused: {serve}")
            serve(connection, header)
        except (PeerError, OSError) as error:
            if not self._is_closed:
                self._log.report(
                    f"{caller}: {error}", kind=NUMBER.sub("#", f"connection {error}")[:200]
                )
        finally:
            with self._lock:
                self._open.discard(connection)
            close(connection)

    @property
    def n_connections(self) -> int:
        """Connections there are."""
        return len(self._open)

    def close(self) -> None:
        """Stop listening and close all connections."""
        with self._lock:
            self._is_closed = True
            connections = list(self._open)
        close(self._socket)
        for connection in connections:
            close(connection)
