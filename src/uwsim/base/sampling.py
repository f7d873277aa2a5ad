"""Sampling times: a sample is due at the first step at or after its time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from .record import Record


def sample_step(n: int, rate: float, timestep: float) -> int:
    """Step at which sample ``n`` of a sensor with ``rate`` [Hz] is taken."""
    return math.ceil(n / (rate * timestep) - 1e-9)


@dataclass(slots=True)
class TimerState(Record):
    """How far a timer is."""

    start: int
    """The step of the first sample."""
    n_samples: int
    """The samples taken."""
    due: int
    """The step of the next sample."""


class SampleTimer:
    """Calls a function at the samples of a rate."""

    def __init__(self, start: int, rate: float, timestep: float, call: Callable[[], None]) -> None:
        self._rate, self._timestep, self._call = rate, timestep, call
        self.state = TimerState(start, 0, start)
        """How far it is."""

    @property
    def due(self) -> int:
        """Step of the next sample."""
        return self.state.due

    def tick(self, step: int) -> None:
        """Call the function if a sample is due at this step."""
        state = self.state
        if step >= state.due:
            state.n_samples += 1
            state.due = state.start + sample_step(state.n_samples, self._rate, self._timestep)
            self._call()
