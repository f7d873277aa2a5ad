"""Reading from a connection until a deadline."""

from __future__ import annotations

import io
import socket
import time
from typing import Any


class DeadlineReader(io.RawIOBase):
    """A stream of the bytes that a connection receives, for a limited time.

    The connection stays open until the stream is closed, as with `socket.socket.makefile`.

    Args:
        connection: the connection to read from; its timeout is changed during each read.
        limit: the time limit for reading everything [s].

    Raises:
        TimeoutError: while reading, after the time limit.
    """

    def __init__(self, connection: socket.socket, limit: float) -> None:
        self._connection, self._old_timeout = connection, connection.gettimeout()
        self._end = time.monotonic() + limit
        self._open_file = connection.makefile("rb")  # only keeps the connection open

    def readable(self) -> bool:
        """Return True."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Read what has arrived, at least one byte; 0 at the end."""
        self._connection.settimeout(time_left(self._end))
        try:
            return self._connection.recv_into(buffer)
        finally:
            self._connection.settimeout(self._old_timeout)

    def close(self) -> None:
        """Close the stream."""
        super().close()
        self._open_file.close()


def time_left(deadline: float) -> float:
    """Return the time until a deadline on the monotonic clock [s]; raise TimeoutError after it."""
    seconds = deadline - time.monotonic()
    if seconds <= 0.0:
        raise TimeoutError("the deadline has passed")
    return seconds
