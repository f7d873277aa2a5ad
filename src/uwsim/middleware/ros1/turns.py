"""Turns of the requests of a server, one at a time and in a share of the wall time."""

from __future__ import annotations

import heapq
import itertools
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from ..work_budget import WorkBudget

SHARE, BURST = 0.1, 0.5
"""The share of the wall time in which requests are worked on, and the time at once [s]."""
REQUEST_COST = 1e-4
"""The time that a request takes besides what is measured [s]: its thread, its header."""
PER_BYTE = 1e-4
"""How much later a longer request has its turn [s per byte], so that those of nodes, which are
short, do not wait behind a flood of long ones."""


class Turns:
    """Lets threads work one at a time, and makes them wait when they have worked too much."""

    def __init__(self) -> None:
        self._budget = WorkBudget(SHARE, BURST)
        self._changed = threading.Condition()
        self._waiting: list[tuple[float, int]] = []  # a heap; the first is next
        self._numbers = itertools.count()
        self._is_busy = False

    @contextmanager
    def turn(self, n_bytes: int) -> Iterator[None]:
        """Wait for the turn of a request of this length; the work is done in the context."""
        turn = (time.monotonic() + PER_BYTE * n_bytes, next(self._numbers))
        with self._changed:
            heapq.heappush(self._waiting, turn)
            while self._is_busy or self._waiting[0] != turn or self._budget.delay > 0.0:
                is_next = not self._is_busy and self._waiting[0] == turn
                self._changed.wait(self._budget.delay if is_next else None)
            heapq.heappop(self._waiting)
            self._is_busy = True
        began = time.thread_time()
        try:
            yield
        finally:
            self._budget.spend(REQUEST_COST + time.thread_time() - began)
            with self._changed:
                self._is_busy = False
                self._changed.notify_all()
