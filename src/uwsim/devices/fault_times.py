"""The times at which a fault is present: an interval, or random occurrences in it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..base.record import Record

TIME_TOLERANCE = 1e-9
"""The tolerance of times [s]."""


class FaultTiming(Protocol):
    """The times of a fault."""

    @property
    def start(self) -> float:
        """The time from which on the fault may be present [s]."""

    @property
    def end(self) -> float | None:
        """The time until which the fault may be present [s]; None: there is no end."""

    @property
    def rate(self) -> float | None:
        """The mean rate of random occurrences [1/s]; None: the fault is present all the time."""

    @property
    def duration(self) -> float:
        """The duration of each occurrence [s]; 0: one sample or step."""


@dataclass(slots=True)
class FaultState(Record):
    """The state of the occurrences of a fault."""

    rng: np.random.Generator
    """The random generator of the times."""
    next_start: float
    """The time of the next occurrence [s]."""
    last_end: float
    """The time at which the last occurrence ends [s]."""


class FaultTimes:
    """The times at which a fault is present; calls must be in ascending order of time.

    With a rate, occurrences are a Poisson process: the intervals between them are exponential.
    """

    def __init__(self, spec: FaultTiming, rng: np.random.Generator) -> None:
        self._spec = spec
        self.state = FaultState(rng, math.inf, -math.inf)
        """The state of the occurrences."""
        if spec.rate is not None:
            self.state.next_start = spec.start + self._draw_interval()

    def _draw_interval(self) -> float:
        rate = self._spec.rate
        return float(self.state.rng.exponential(1.0 / rate)) if rate else 0.0

    def is_present(self, time: float) -> bool:
        """Return whether the fault is present at ``time`` [s]."""
        spec, time = self._spec, time + TIME_TOLERANCE
        if time < spec.start or (spec.end is not None and time >= spec.end):
            return False
        if spec.rate is None:
            return True
        has_begun = False
        while self.state.next_start <= time:
            has_begun = has_begun or spec.duration == 0.0
            self.state.last_end = max(self.state.last_end, self.state.next_start + spec.duration)
            self.state.next_start += self._draw_interval()
        return has_begun or time < self.state.last_end

    def next_change(self, time: float) -> float:
        """Return the next time after ``time`` at which the fault may begin or end [s]."""
        changes = (self._spec.start, self._spec.end, self.state.next_start, self.state.last_end)
        return min((t for t in changes if t is not None and t > time), default=math.inf)
