"""Simulation time in step with the clock on the wall."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from ..errors import RunFailed

SHORTEST_SLEEP_S = 0.001
"""A step that is early by less is not held up [s]."""
MIN_SPEED = 1e-6
"""The least simulation time per real time: that of the longest wait between two steps."""
MAX_LAG_S = 0.2
"""A simulation that lags by more does not catch up: time is lost instead [s]."""


class Pace:
    """Holds the simulation up so that its time passes at ``speed`` times real time.

    `step` is called at the end of each step. A simulation that is too slow runs as fast as it can;
    after a short lag it catches up, after a long one the lost time stays lost.

    Args:
        clock: returns the simulation time [s].
        speed: simulation time per real time, > 0.
        max_lag: a step that is later than this ends the run [s]: a strict clock, for hardware in
            the loop; None: no step does.
        now: returns real time [s].
        sleep: waits for some time [s].
    """

    def __init__(
        self,
        clock: Callable[[], float],
        speed: float,
        *,
        max_lag: float | None = None,
        now: Callable[[], float] = time.perf_counter,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._clock, self._speed = clock, speed
        self._max_lag = math.inf if max_lag is None else max_lag
        self._now, self._sleep = now, sleep
        self._began: float | None = None
        self._first = 0.0
        self.lost = 0.0
        """Real time that was not caught up [s]."""

    def step(self) -> None:
        """Wait until it is time.

        Raises:
            RunFailed: the clock is strict, and it is later than that.
        """
        now = self._now()
        if self._began is None:
            self._began, self._first = now, self._clock()
            return
        early = self._began + (self._clock() - self._first) / self._speed - now
        if -early > self._max_lag:
            raise RunFailed(
                f"At {self._clock():g} s of simulation time the computer is {-early:.3g} s late; "
                f"--max-lag allows {self._max_lag:g} s."
            )
        if early >= SHORTEST_SLEEP_S:
            self._sleep(early)
        elif early < -MAX_LAG_S:
            self._began -= early
            self.lost -= early
