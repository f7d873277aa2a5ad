"""Reading from a connection until a deadline, however slowly something comes."""

from __future__ import annotations

import io
import socket
import time
from typing import Any


class DeadlineReader(io.RawIOBase):
    """A stream of what a connection receives, for a limited time.

    The connection stays open until the stream is closed, as with `socket.socket.makefile`.

    Args:
        connection: read from; its timeout is changed.
        limit: how long all of it may take [s].

    Raises:
        TimeoutError: while reading, after that time.
    """

    def __init__(self, connection: socket.socket, limit: float) -> None:
        self._connection, self._before = connection, connection.gettimeout()
        self._end = time.monotonic() + limit
        self._hold = connection.makefile("rb")  # nothing is read through it

    def readable(self) -> bool:
        """It is."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Read what has come, at least one byte; 0 at the end."""
        self._connection.settimeout(time_left(self._end))
        try:
            return self._connection.recv_into(buffer)
        finally:
            self._connection.settimeout(self._before)

    def close(self) -> None:
        """Close the stream."""
        super().close()
        self._hold.close()


def time_left(end: float) -> float:
    """Return how long it is until a moment of the monotonic clock [s]; raises TimeoutError."""
    left = end - time.monotonic()
    if left <= 0.0:
        raise TimeoutError("the deadline is over")
    return left
