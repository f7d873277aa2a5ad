"""What is to be done at a later step: calls at the samples of a rate, and commands that came."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeVar

from ..base.sampling import SampleTimer

M = TypeVar("M")


class Schedule:
    """Timers, and the commands of the next step.

    Args:
        timestep: length of a step [s].
    """

    STATE = ("_timers", "due")
    """Attributes of its state, for snapshots; commands are saved with the stage."""

    def __init__(self, timestep: float) -> None:
        self._timestep = timestep
        self._timers: list[SampleTimer] = []
        self.due = math.inf
        """The step before which no timer is due."""
        self.commands: list[tuple[Callable[[Any], None], Any]] = []
        """What came during this step: a method of an interface, and its message."""

    def every(self, step: int, rate: float, call: Callable[[], None]) -> Callable[[], None]:
        """Have ``call`` called at the samples of ``rate`` [Hz] from a step on.

        Returns:
            How to stop.
        """
        timer = SampleTimer(step, rate, self._timestep, call)
        self._timers.append(timer)
        self.due = min(self.due, timer.due)
        return lambda: self._timers.remove(timer) if timer in self._timers else None

    def at_next_step(self, obey: Callable[[M], None], message: M) -> None:
        """Have ``obey(message)`` called at the start of the next step."""
        self.commands.append((obey, message))

    def apply_commands(self) -> None:
        """Carry out what arrived during the last step, in its order."""
        commands, self.commands = self.commands, []
        for obey, message in commands:
            obey(message)

    def tick(self, step: int) -> None:
        """Call what is due at a step."""
        if step < self.due:
            return
        for timer in self._timers:
            timer.tick(step)
        self.due = min((timer.due for timer in self._timers), default=math.inf)
