"""Limits on the undelivered messages of an algorithm."""

from __future__ import annotations

from collections import deque

from ...base.message_fields import size_of
from ...errors import NotAllowed

MAX_MESSAGES = 10_000
"""The maximum number of undelivered messages of one algorithm, delayed messages included."""
MAX_BYTES = 256 * 2**20
"""The maximum total size of these messages [bytes]."""


class UndeliveredMessages:
    """The number and size of an algorithm's published messages that are not delivered yet."""

    def __init__(self) -> None:
        self._deliveries: deque[tuple[int, int]] = deque()  # step of delivery, bytes
        self._n_bytes = 0

    def add(self, message: object, *, step: int, delay_steps: int) -> None:
        """Count a message that is published at a step.

        Raises:
            NotAllowed: the messages are too many, or too large in total.
        """
        while self._deliveries and self._deliveries[0][0] < step:
            self._n_bytes -= self._deliveries.popleft()[1]
        size = size_of(message)
        if len(self._deliveries) >= MAX_MESSAGES:
            raise NotAllowed(f"more than {MAX_MESSAGES} of its messages wait to be delivered")
        if self._n_bytes + size > MAX_BYTES:
            raise NotAllowed(f"messages of more than {MAX_BYTES // 2**20} MiB wait to be delivered")
        self._deliveries.append((step + delay_steps, size))
        self._n_bytes += size
