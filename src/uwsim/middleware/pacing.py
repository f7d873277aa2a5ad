"""Pacing of a simulation by a real-time factor."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from ..errors import RunFailed

SHORTEST_SLEEP_S = 0.001
"""The shortest sleep at the end of a step [s]."""
MIN_REAL_TIME_FACTOR = 1e-6
"""The minimum real-time factor, which bounds the wait between two steps."""
MAX_CATCH_UP_S = 0.2
"""The longest lag that a simulation catches up [s]; a longer lag is kept."""


class Pace:
    """A limit on the speed of a simulation: at most ``real_time_factor`` times real time.

    `step` is called at the end of each step. A simulation that is too slow runs as fast as it can.
    After a short lag it catches up with real time; after a long lag it does not.

    Args:
        clock: a function that returns the simulation time [s].
        real_time_factor: the simulation time per real time [1], > 0.
        max_lag: the lag behind real time above which the run ends, for hardware in the loop [s];
            None: no limit.
        now: a function that returns the real time [s].
        sleep: a function that waits for a time [s].
        on_lag: a function that is called in each step but the first with the lag of the simulation
            behind real time [s], negative if it is early.
    """

    def __init__(
        self,
        clock: Callable[[], float],
        real_time_factor: float,
        *,
        max_lag: float | None = None,
        now: Callable[[], float] = time.perf_counter,
        sleep: Callable[[float], None] = time.sleep,
        on_lag: Callable[[float], None] | None = None,
    ) -> None:
        self._clock, self._real_time_factor = clock, real_time_factor
        self._max_lag = math.inf if max_lag is None else max_lag
        self._now, self._sleep, self._on_lag = now, sleep, on_lag
        self._wall_start: float | None = None
        self._start_time = 0.0
        self.lost_time = 0.0
        """The sum of the lags that were not caught up [s of real time]."""

    @property
    def is_started(self) -> bool:
        """True if the first step has ended, from which on times are due."""
        return self._wall_start is not None

    def due_at(self, simulation_time: float) -> float:
        """Return the real time at which a simulation time is due [s]; the pace has started."""
        assert self._wall_start is not None
        return self._wall_start + (simulation_time - self._start_time) / self._real_time_factor

    def step(self) -> None:
        """Wait until the step is due.

        Raises:
            RunFailed: the simulation lags behind real time by more than ``max_lag``.
        """
        now = self._now()
        if self._wall_start is None:
            self._wall_start, self._start_time = now, self._clock()
            return
        lead = self.due_at(self._clock()) - now
        if self._on_lag is not None:
            self._on_lag(-lead)
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
