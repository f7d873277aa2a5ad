"""The real-time factor of a simulation."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from ..errors import RunFailed

SHORTEST_SLEEP_S = 0.001
"""The shortest sleep at the end of a step [s]."""
MIN_SPEED = 1e-6
"""The minimum real-time factor, which bounds the wait between two steps."""
MAX_CATCH_UP_S = 0.2
"""The maximum lag that a simulation catches up [s]; the time of a longer lag is lost."""


class Pace:
    """A limit on the pace of a simulation: its time passes at ``speed`` times real time.

    `step` is called at the end of each step. A simulation that is too slow runs as fast as it can;
    after a short lag it catches up, after a long one the lost time stays lost.

    Args:
        clock: returns the simulation time [s].
        speed: the real-time factor, > 0.
        max_lag: the lag behind real time above which the run ends, for hardware in the loop [s];
            None: no limit.
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
        self._wall_start: float | None = None
        self._start_time = 0.0
        self.lost_time = 0.0
        """The real time that was not caught up [s]."""

    def step(self) -> None:
        """Wait until the step is due.

        Raises:
            RunFailed: the simulation lags behind real time by more than ``max_lag``.
        """
        now = self._now()
        if self._wall_start is None:
            self._wall_start, self._start_time = now, self._clock()
            return
        lead = self._wall_start + (self._clock() - self._start_time) / self._speed - now
        if -lead > self._max_lag:
            raise RunFailed(
                f"At {self._clock():g} s of simulation time the computer is {-lead:.3g} s late; "
                f"--max-lag allows {self._max_lag:g} s."
            )
        if lead >= SHORTEST_SLEEP_S:
            self._sleep(lead)
        elif lead < -MAX_CATCH_UP_S:
            self._wall_start -= lead
            self.lost_time -= lead
