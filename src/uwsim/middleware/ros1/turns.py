"""A queue of the requests to a server: one at a time, within a fraction of the wall time."""

from __future__ import annotations

import heapq
import itertools
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from ..work_budget import WorkBudget

SHARE = 0.1
"""The greatest fraction of the wall time for requests [1]."""
BURST = 0.5
"""The longest time for requests without a pause [s]."""
REQUEST_COST = 1e-4
"""The time that a request takes in addition to the measured time [s], for its thread and header."""
DELAY_PER_BYTE = 1e-4
"""The delay of the turn of a request [s/byte], so that the short requests of nodes do not wait for
a flood of long requests."""


class Turns:
    """A queue in which threads work one at a time, and wait if they exceed their share."""

    def __init__(self) -> None:
        self._budget = WorkBudget(SHARE, BURST)
        self._condition = threading.Condition()
        self._waiting_turns: list[tuple[float, int]] = []  # a heap; the first is next
        self._numbers = itertools.count()
        self._is_busy = False

    @contextmanager
    def turn(self, n_bytes: int) -> Iterator[None]:
        """Wait for the turn of a request of ``n_bytes``; the work is done in the context."""
        turn = (time.monotonic() + DELAY_PER_BYTE * n_bytes, next(self._numbers))
        with self._condition:
            heapq.heappush(self._waiting_turns, turn)
            while self._is_busy or self._waiting_turns[0] != turn or self._budget.delay > 0.0:
                is_next = not self._is_busy and self._waiting_turns[0] == turn
                self._condition.wait(self._budget.delay if is_next else None)
            heapq.heappop(self._waiting_turns)
            self._is_busy = True
        start_time = time.thread_time()
        try:
            yield
        finally:
            self._budget.spend(REQUEST_COST + time.thread_time() - start_time)
            with self._condition:
                self._is_busy = False
                self._condition.notify_all()
