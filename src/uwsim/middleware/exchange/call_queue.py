"""The queue of calls of services from outside."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future

from ..work_budget import WorkBudget

MAX_CALLS = 1000
"""The maximum number of calls that wait for the end of a step."""
FLOOD_SHARE, FLOOD_BURST = 0.01, 0.05
"""The budget for a flood of calls: the fraction of the wall time, and the longest burst [s]."""
CALLS_AT_ONCE = 10
"""The number of calls answered together while the simulation waits; a longer queue is a flood."""
Call = tuple[str, object, "Future[object]"]
"""The name of the service, the request, and the future of the response."""


class CallQueue:
    """A queue of calls; any thread adds calls, the thread of the simulation answers them."""

    def __init__(self) -> None:
        self._calls: deque[Call] = deque()
        self._budget = WorkBudget(FLOOD_SHARE, FLOOD_BURST)

    def __bool__(self) -> bool:
        """Return whether a call waits."""
        return bool(self._calls)

    def add(self, call: Call) -> bool:
        """Add a call; return False if too many calls wait."""
        if len(self._calls) >= MAX_CALLS:
            return False
        self._calls.append(call)
        return True

    def take(self) -> list[Call]:
        """Remove and return all calls, in their order."""
        return [self._calls.popleft() for _ in range(len(self._calls))]

    def serve(self, answer: Callable[[Call], None], limit: int | None) -> None:
        """Answer calls in their order.

        Args:
            answer: the function that answers a call.
            limit: the number of calls that are answered now. None: all; but if more than
                `CALLS_AT_ONCE` wait, only as many as the budget allows, so that a flood of calls
                does not stop the simulation.
        """
        n_waiting = len(self._calls)
        is_flood = limit is None and n_waiting > CALLS_AT_ONCE
        for _ in range(n_waiting if limit is None else min(limit, n_waiting)):
            if is_flood and self._budget.delay > 0.0:
                return
            start_time = time.thread_time()
            answer(self._calls.popleft())
            self._budget.spend(time.thread_time() - start_time)
