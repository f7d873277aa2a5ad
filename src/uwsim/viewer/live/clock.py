"""The pacing of a live view by the wall clock: real-time factor, pause and single steps."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping

from ...base.external_values import read_number

MAX_REAL_TIME_FACTOR = 100.0
"""The greatest limit on the real-time factor; a request above it removes the limit [1]."""
MAX_SLEEP = 0.01
"""The longest time between two checks for messages of viewers [s of wall time]."""
MAX_LAG = 0.25
"""The longest lag that the simulation catches up [s of wall time]."""


class Clock:
    """The pacing of a simulation: when it has to wait before its next step.

    Args:
        real_time_factor: the simulation time per wall time [1]; 0: no limit.
        wall: the function that returns the wall time [s].
        sleep: the function that waits for some seconds.
    """

    def __init__(
        self,
        real_time_factor: float,
        wall: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self.real_time_factor = real_time_factor
        """The simulation time per wall time [1]; 0: no limit."""
        self.is_paused = False
        """True while the simulation is paused."""
        self._wall, self._sleep = wall, sleep
        # the simulation and wall time at which the lead is 0 [s]; NaN: set at the next check
        self._start = 0.0, 0.0
        self._n_single_steps = 0  # the number of requested steps while paused

    def begin(self, now: float) -> None:
        """Start the pacing at a simulation time [s] and the present wall time."""
        self._start = now, self._wall()

    def apply_control(self, message: Mapping[str, object]) -> bool:
        """Apply a viewer's request; return whether it changed anything."""
        action, speed = message.get("action"), read_number(message.get("speed"))
        if action == "pause":
            self.is_paused, self._n_single_steps = True, 0
        elif action == "play":
            self.is_paused = False
            self._start = math.nan, 0.0
        elif action == "step":
            self.is_paused, self._n_single_steps = True, self._n_single_steps + 1
        elif action == "speed" and speed is not None and speed >= 0.0:
            self.real_time_factor = 0.0 if speed > MAX_REAL_TIME_FACTOR else speed
            self._start = math.nan, 0.0
        else:
            return False
        return True

    def has_to_wait(self, now: float) -> bool:
        """Return whether the simulation must wait at a simulation time [s]."""
        if self.is_paused:
            return self._n_single_steps == 0
        return self.real_time_factor > 0.0 and self._lead(now) > 0.0

    def sleep(self, now: float) -> None:
        """Sleep until the next check or step, at a simulation time [s]."""
        lead = MAX_SLEEP if self.is_paused else self._lead(now)
        self._sleep(min(MAX_SLEEP, max(lead, 0.0005)))

    def count_step(self) -> None:
        """Count the step that the simulation executes next."""
        self._n_single_steps = max(0, self._n_single_steps - 1)

    def _lead(self, now: float) -> float:
        """Return the time by which the simulation is ahead of its pacing [s of wall time]."""
        start, wall = self._start
        if math.isnan(start):
            self._start = start, wall = now, self._wall()
        lead = (now - start) / self.real_time_factor - (self._wall() - wall)
        if lead < -MAX_LAG:
            self._start = now, self._wall()
        return lead
