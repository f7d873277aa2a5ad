"""What is to be done at a later step: calls at the samples of a rate, and commands that came."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from ..base.record import Record
from ..base.sampling import SampleTimer, TimerState
from ..bus import Bus

M = TypeVar("M")


@dataclass(slots=True)
class ScheduleState(Record):
    """What is to be done later."""

    due: float = math.inf
    """The step before which no timer is due."""
    timers: list[TimerState] = field(default_factory=list)
    """How far each timer is."""
    commands: list[tuple[int, object]] = field(default_factory=list)
    """What came during this step: the number of who applies it, and the message."""


class Schedule:
    """Timers, and the commands of the next step.

    Args:
        bus: counts the steps.
        timestep: length of a step [s].
    """

    def __init__(self, bus: Bus, timestep: float) -> None:
        self._bus, self._timestep = bus, timestep
        self._timers: list[SampleTimer] = []
        self._appliers: list[Callable[[Any], None]] = []
        self.state = ScheduleState()
        """What is to be done later."""

    def every(self, rate: float, call: Callable[[], None]) -> Callable[[], None]:
        """Have ``call`` called at the samples of ``rate`` [Hz] from now on.

        Returns:
            How to stop.
        """
        timer = SampleTimer(self._bus.state.step, rate, self._timestep, call)
        self._timers.append(timer)
        self.state.timers.append(timer.state)
        self.state.due = min(self.state.due, timer.due)

        def stop() -> None:
            if timer in self._timers:
                self._timers.remove(timer)
                self.state.timers = [each.state for each in self._timers]

        return stop

    def at_next_step(self, apply: Callable[[M], None]) -> Callable[[M], None]:
        """Return what has ``apply(message)`` called at the start of the next step."""
        self._appliers.append(apply)
        number, state = len(self._appliers) - 1, self.state
        return lambda message: state.commands.append((number, message))

    def apply_commands(self) -> None:
        """Carry out what arrived during the last step, in its order."""
        commands, self.state.commands = self.state.commands, []
        for number, message in commands:
            self._appliers[number](message)

    def tick(self, step: int) -> None:
        """Call what is due at a step."""
        if step < self.state.due:
            return
        for timer in self._timers:
            timer.tick(step)
        self.state.due = min((timer.due for timer in self._timers), default=math.inf)
