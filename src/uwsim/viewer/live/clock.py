"""The pace of a live view by the wall clock: real-time factor, pause and single steps."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping

from ...base.external_values import read_number

MAX_REAL_TIME_FACTOR = 100.0
"""The greatest real-time factor; a request above it removes the limit [1]."""
MAX_SLEEP = 0.01
"""The greatest time between two checks of the viewers' messages [s]."""
MAX_LAG = 0.25
"""The greatest lag behind the pace that the simulation makes up [s of the wall clock]."""


class Clock:
    """The pace of a simulation.

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
        """The state of the simulation: True while it is paused."""
        self._wall, self._sleep = wall, sleep
        self._start = 0.0, 0.0  # simulation time (NaN: at the next check) and wall time [s]
        self._n_single_steps = 0  # to be made during the pause

    def begin(self, now: float) -> None:
        """Begin at a simulation time [s] and the present wall time."""
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
        """Count a step that the simulation makes next."""
        self._n_single_steps = max(0, self._n_single_steps - 1)

    def _lead(self, now: float) -> float:
        """Return the lead of the simulation over its pace [s of the wall clock]."""
        start, wall = self._start
        if math.isnan(start):
            self._start = start, wall = now, self._wall()
        lead = (now - start) / self.real_time_factor - (self._wall() - wall)
        if lead < -MAX_LAG:
            self._start = now, self._wall()
        return lead
