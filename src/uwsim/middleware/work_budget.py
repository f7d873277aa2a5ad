"""A limit on the time that work for external programs takes from a simulation."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable


class WorkBudget:
    """A limit on the fraction of wall time for some work (a token bucket); any thread may use it.

    Args:
        share: the fraction of the wall time, above 0 and at most 1.
        burst: the longest work that may be done without a pause [s].
        clock: a function that returns the wall time [s].
    """

    def __init__(
        self, share: float, burst: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._share, self._burst, self._clock = share, burst, clock
        self._balance, self._refill_time = burst, clock()
        self._lock = threading.Lock()

    def spend(self, seconds: float) -> None:
        """Count work that was done [s]."""
        with self._lock:
            self._refill()
            self._balance -= seconds

    @property
    def delay(self) -> float:
        """The time until more work may be done [s]; 0: now."""
        with self._lock:
            self._refill()
            return max(0.0, -self._balance / self._share)

    def _refill(self) -> None:
        now = self._clock()
        self._balance = min(self._burst, self._balance + self._share * (now - self._refill_time))
        self._refill_time = now
