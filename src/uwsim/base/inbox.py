"""The inbox of a subscriber of a topic."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

from .message_fields import size_of

M = TypeVar("M")
MAX_MESSAGES = 10_000
"""The greatest number of messages in an inbox that is not read."""
MAX_BYTES = 256 * 2**20
"""The greatest size of all messages in an inbox [bytes]; the newest is kept whatever its size."""


class Inbox(Generic[M]):
    """The messages of a topic that a subscriber has not taken yet, and the newest message.

    An inbox that is full discards its oldest messages.

    Args:
        max_messages: the greatest number of messages; None: `MAX_MESSAGES`.
    """

    def __init__(self, max_messages: int | None = None) -> None:
        self._max_messages = MAX_MESSAGES if max_messages is None else max_messages
        self._messages: deque[M] = deque()
        self._sizes: deque[int] = deque()
        self._n_bytes = 0
        self._stop: Callable[[], None] | None = None
        self.last_message: M | None = None
        """The newest message, taken or not."""
        self.last_step: int | None = None
        """The step at which the newest message was delivered; None before the first message."""

    def receive(self, message: M, step: int) -> None:
        """Add a message; called by the bus."""
        self._messages.append(message)
        self._sizes.append(size_of(message))
        self._n_bytes += self._sizes[-1]
        while len(self._messages) > self._max_messages or (
            self._n_bytes > MAX_BYTES and len(self._messages) > 1
        ):
            self._messages.popleft()
            self._n_bytes -= self._sizes.popleft()
        self.last_message, self.last_step = message, step

    def take(self) -> list[M]:
        """Remove and return all messages that arrived since the last call, oldest first."""
        if not self._messages:
            return []
        messages = list(self._messages)
        self._empty()
        return messages

    def clear(self) -> None:
        """Remove all messages, also the newest."""
        self._empty()
        self.last_message, self.last_step = None, None

    def close(self) -> None:
        """End the subscription."""
        if self._stop is not None:
            self._stop()
            self._stop = None

    def _empty(self) -> None:
        self._messages.clear()
        self._sizes.clear()
        self._n_bytes = 0

    def set_stop(self, stop: Callable[[], None]) -> None:
        """Set the function that ends the subscription, for `close`; called by the bus."""
        self._stop = stop
