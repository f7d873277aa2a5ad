"""A limit on the time that the work for peers takes from a simulation."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable


class WorkBudget:
    """A share of wall time that some work may take (a token bucket). Any thread may use it.

    Args:
        share: of the wall time, above 0 and at most 1.
        burst: how much work may be done at once after a rest [s].
        clock: returns the wall time [s].
    """

    def __init__(
        self, share: float, burst: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._share, self._burst, self._clock = share, burst, clock
        self._left, self._since = burst, clock()
        self._lock = threading.Lock()

    def spend(self, seconds: float) -> None:
        """Count work that was done [s]."""
        with self._lock:
            self._refill()
            self._left -= seconds

    @property
    def delay(self) -> float:
        """The time until more work may be done [s]; 0: now."""
        with self._lock:
            self._refill()
            return max(0.0, -self._left / self._share)

    def _refill(self) -> None:
        now = self._clock()
        self._left = min(self._burst, self._left + self._share * (now - self._since))
        self._since = now
