"""Limits on the undelivered messages of an algorithm."""

from __future__ import annotations

from collections import deque

from ...base.message_fields import size_of
from ...errors import NotAllowed

MAX_MESSAGES = 10_000
"""So many of one algorithm may be on their way: published in this step, or delayed."""
MAX_BYTES = 256 * 2**20
"""So much they may hold together."""


class UndeliveredMessages:
    """Number and size of an algorithm's published messages that are not delivered yet."""

    def __init__(self) -> None:
        self._waiting: deque[tuple[int, int]] = deque()  # step of delivery, bytes
        self._n_bytes = 0

    def add(self, message: object, *, step: int, delay_steps: int) -> None:
        """Count a message.

        Raises:
            NotAllowed: it is one too many.
        """
        while self._waiting and self._waiting[0][0] < step:
            self._n_bytes -= self._waiting.popleft()[1]
        size = size_of(message)
        if len(self._waiting) >= MAX_MESSAGES:
            raise NotAllowed(f"more than {MAX_MESSAGES} of its messages wait to be delivered")
        if self._n_bytes + size > MAX_BYTES:
            most = f"{MAX_BYTES // 2**20} MiB"
            raise NotAllowed(f"messages of more than {most} wait to be delivered")
        self._waiting.append((step + delay_steps, size))
        self._n_bytes += size
