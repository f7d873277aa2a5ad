"""The inbox of a reader of a topic."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

from .message_fields import size_of

M = TypeVar("M")
MAX_KEPT = 10_000
"""Number of messages that an unread inbox keeps."""
MAX_BYTES_KEPT = 256 * 2**20


class Inbox(Generic[M]):
    """The messages of one topic that one reader has not taken yet, and the last one.

    One that is not looked into keeps the newest, of `MAX_BYTES_KEPT` together at most.

    Args:
        n_kept: at most so many; `MAX_KEPT` if it is not given.
    """

    def __init__(self, n_kept: int | None = None) -> None:
        self._n_kept = MAX_KEPT if n_kept is None else n_kept
        self._new: deque[M] = deque()
        self._sizes: deque[int] = deque()
        self._n_bytes = 0
        self._stop: Callable[[], None] | None = None
        self.last: M | None = None
        """The newest message ever received."""
        self.last_step: int | None = None
        """The step at which it was delivered."""

    def receive(self, message: M, step: int) -> None:
        """Put a message in; called by the bus."""
        self._new.append(message)
        self._sizes.append(size_of(message))
        self._n_bytes += self._sizes[-1]
        while len(self._new) > self._n_kept or (
            self._n_bytes > MAX_BYTES_KEPT and len(self._new) > 1
        ):
            self._new.popleft()
            self._n_bytes -= self._sizes.popleft()
        self.last, self.last_step = message, step

    def take(self) -> list[M]:
        """Take out all messages that came since the last call, oldest first."""
        if not self._new:
            return []
        messages = list(self._new)
        self._empty()
        return messages

    def clear(self) -> None:
        """Forget everything."""
        self._empty()
        self.last, self.last_step = None, None

    def close(self) -> None:
        """Receive nothing more."""
        if self._stop is not None:
            self._stop()
            self._stop = None

    def _empty(self) -> None:
        self._new.clear()
        self._sizes.clear()
        self._n_bytes = 0

    def stop_with(self, stop: Callable[[], None]) -> None:
        """Have ``stop`` called by `close`; used by the bus."""
        self._stop = stop
