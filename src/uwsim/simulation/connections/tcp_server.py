"""A TCP server of one client at a time, whose silent client a newer one replaces.

A program that has crashed, or whose cable is out, may keep its connection for minutes. So:

- The first client stays as long as it sends. If the stream only sends, it stays as long as its
  computer acknowledges bytes.
- A client that has sent nothing for `START_SILENCE` after it connected, or for `SILENCE` after its
  last bytes, gives way to the newest client that waits. Its connection is closed.
- Time during which the simulation does not look at the stream does not count.
"""

from __future__ import annotations

import select
import socket
import time
from collections.abc import Callable
from contextlib import suppress

from ...base.terminal import report
from .tcp_streams import TcpStream

START_SILENCE = 2.0
"""The wall time after which a client that has never sent gives way [s]."""
SILENCE = 5.0
"""The wall time after which a client that sent before gives way [s]."""
CHECK_PERIOD = 0.2
"""The wall time between two looks for waiting clients [s]."""
MAX_PAUSE = 0.5
"""The longest time between two looks at the stream that counts as silence [s]."""
MAX_WAITING = 16
"""The greatest number of waiting clients, of which the newest is accepted, in one look."""
MAX_REPORTS = 4
"""The number of lines that are printed; later events are counted only."""


class TcpServer(TcpStream):
    """A TCP server of one client at a time.

    Args:
        host: the address of this computer.
        port: the port.
        now: a function that returns the wall time [s].
        report_line: a function that prints a line for the user.
    """

    def __init__(
        self,
        host: str,
        port: int,
        *,
        now: Callable[[], float] = time.monotonic,
        report_line: Callable[[str], None] = report,
    ) -> None:
        super().__init__()
        self._name, self._now, self._report = f"tcpin:{host}:{port}", now, report_line
        self._listener = socket.create_server((host, port), backlog=MAX_WAITING)
        self._listener.setblocking(False)
        self._peer = ""
        self._has_sent = self._is_read = self._has_waiting = False
        self._active_time = self._look_time = self._check_time = 0.0
        self._n_reports = 0
        self.n_clients = 0
        """The number of clients so far."""
        self.n_replaced = 0
        """The number of silent clients that a newer one replaced."""
        self.n_waiting = 0
        """The number of times that a client had to wait, because another one was not silent."""

    @property
    def is_connected(self) -> bool:
        """True if a client is connected."""
        self._accept(0.0)
        return self._socket is not None

    @property
    def events(self) -> str:
        """The counts of unusual events; empty if there are none."""
        counts = {
            "silent clients replaced by newer ones": self.n_replaced,
            "clients had to wait for another one": self.n_waiting,
        }
        texts = [f"{n} {name}" for name, n in counts.items() if n]
        return f"{self._name}: {self.n_clients} clients; {', '.join(texts)}" if texts else ""

    def receive(self, timeout: float = 0.0) -> bytes:
        """Return bytes that have arrived; wait for a client or bytes for ``timeout`` [s]."""
        self._is_read = True
        self._accept(timeout)
        data = super().receive(timeout)
        if data:
            self._has_sent, self._active_time = True, self._now()
        elif self._socket is not None:
            self._check_waiting(self._socket)
        return data

    def send(self, data: bytes) -> bool:
        """Send all of ``data`` or nothing; return False if no client is connected or reads."""
        self._accept(0.0)
        if self._socket is not None and not self._is_read:
            self._check_waiting(self._socket)
        return super().send(data)

    def _accept(self, timeout: float) -> None:
        """Accept a client if there is none; wait for it for ``timeout`` [s]."""
        if self._socket is not None:
            return
        with suppress(OSError, ValueError):
            if timeout > 0.0:
                select.select([self._listener], [], [], timeout)
            self._begin(*self._listener.accept())

    def _begin(self, connection: socket.socket, address: tuple[str, int]) -> None:
        self._adopt(connection)
        self._peer = f"{address[0]}:{address[1]}"
        self._has_sent = self._has_waiting = False
        self._active_time = self._look_time = self._check_time = self._now()
        self.n_clients += 1

    def _check_waiting(self, connection: socket.socket) -> None:
        """Let the newest waiting client replace a silent one."""
        now = self._now()
        if self._is_read and now - self._look_time > MAX_PAUSE:  # the simulation was idle itself
            self._active_time = now
        self._look_time = now
        if now - self._check_time < CHECK_PERIOD:
            return
        self._check_time = now
        if not self._is_read and _has_acknowledged(connection):
            self._active_time = now
        try:
            is_waiting = bool(select.select([self._listener], [], [], 0.0)[0])
        except (OSError, ValueError):
            return
        silence = now - self._active_time
        if is_waiting and silence > (SILENCE if self._has_sent else START_SILENCE):
            self._replace(connection, silence)
        elif is_waiting and not self._has_waiting:
            self.n_waiting += 1
            self._note(f"a second client waits for {self._peer}, which is connected")
        self._has_waiting = is_waiting and self._socket is connection

    def _replace(self, connection: socket.socket, silence: float) -> None:
        last_client: tuple[socket.socket, tuple[str, int]] | None = None
        with suppress(OSError):
            for _ in range(MAX_WAITING):
                client = self._listener.accept()
                if last_client is not None:
                    last_client[0].close()
                last_client = client
        if last_client is None:
            return
        last_peer = self._peer
        self._drop(connection)
        self._begin(*last_client)
        self.n_replaced += 1
        self._note(f"{self._peer} replaces {last_peer}, which was silent for {silence:.1f} s")

    def _note(self, text: str) -> None:
        self._n_reports += 1
        if self._n_reports <= MAX_REPORTS:
            self._report(f"{self._name}: {text}")

    def close(self) -> None:
        """Close the connection and the port."""
        self._listener.close()
        if self._socket is not None:
            self._drop(self._socket)


def _has_acknowledged(connection: socket.socket) -> bool:
    """Return whether the other computer has acknowledged all bytes; True if that is not known."""
    try:
        import fcntl
        import termios

        waiting_bytes = fcntl.ioctl(connection, termios.TIOCOUTQ, b"\0" * 4)
    except (ImportError, AttributeError, OSError):
        return True
    return not any(waiting_bytes)
