"""The pace of a live view: speed, pause and single steps, by the wall clock."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping

from ...base.external_values import read_number

MAX_SPEED = 100.0
"""Of simulation time to wall time; above, as fast as it can."""
NAP = 0.01
"""Longest sleep between two looks at what viewers say [s]."""
BEHIND = 0.25
"""When the simulation is so far behind its pace it does not catch up [s]."""


class Clock:
    """Decides when a simulation waits.

    Args:
        speed: simulation time a second of the wall clock; 0: as fast as it can.
        wall: returns the wall time [s].
        nap: sleeps for some seconds.
    """

    def __init__(
        self,
        speed: float,
        wall: Callable[[], float] = time.monotonic,
        nap: Callable[[float], None] = time.sleep,
    ) -> None:
        self.speed = speed
        """Simulation time a second of the wall clock; 0: as fast as it can."""
        self.is_paused = False
        """Whether time stands still."""
        self._wall, self._nap = wall, nap
        self._began = 0.0, 0.0
        self._steps = 0

    def begin(self, now: float) -> None:
        """Count from a simulation time [s] and the present wall time."""
        self._began = now, self._wall()

    def control(self, message: Mapping[str, object]) -> bool:
        """Do what a viewer asks for; returns whether that changed anything."""
        action, speed = message.get("action"), read_number(message.get("speed"))
        if action == "pause":
            self.is_paused, self._steps = True, 0
        elif action == "play":
            self.is_paused = False
            self._began = math.nan, 0.0
        elif action == "step":
            self.is_paused, self._steps = True, self._steps + 1
        elif action == "speed" and speed is not None and speed >= 0.0:
            self.speed = 0.0 if speed > MAX_SPEED else speed
            self._began = math.nan, 0.0
        else:
            return False
        return True

    def waits(self, now: float) -> bool:
        """Whether the simulation, at a time [s], is not to go on yet."""
        if self.is_paused:
            return self._steps == 0
        return self.speed > 0.0 and self._ahead(now) > 0.0

    def sleep(self, now: float) -> None:
        """Sleep for a while."""
        ahead = NAP if self.is_paused else self._ahead(now)
        self._nap(min(NAP, max(ahead, 0.0005)))

    def stepped(self) -> None:
        """A step is about to be taken."""
        self._steps = max(0, self._steps - 1)

    def _ahead(self, now: float) -> float:
        """How far the simulation is ahead of its pace [s of the wall clock]."""
        began, wall = self._began
        if math.isnan(began):
            self._began = began, wall = now, self._wall()
        ahead = (now - began) / self.speed - (self._wall() - wall)
        if ahead < -BEHIND:
            self._began = now, self._wall()
        return ahead
