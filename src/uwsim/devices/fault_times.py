"""When a fault is present: from one time to another, or at random with a rate."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..base.record import Record

EARLY = 1e-9
"""Tolerance of times [s]."""


class Timed(Protocol):
    """The times of a fault."""

    @property
    def start(self) -> float:
        """From when on it may be present [s]."""

    @property
    def end(self) -> float | None:
        """Up to when; None: for ever [s]."""

    @property
    def rate(self) -> float | None:
        """How often it begins, between these; None: it is always present [1/s]."""

    @property
    def duration(self) -> float:
        """How long it stays each time; 0: one sample [s]."""


@dataclass(slots=True)
class FaultState(Record):
    """When a fault occurs."""

    random: np.random.Generator
    """The generator of its times."""
    next: float
    """When it occurs next [s]."""
    until: float
    """When the last occurrence ends [s]."""


class FaultTimes:
    """The times of one fault; asked at times that rise.

    With a rate it begins as a Poisson process does: the times between are exponential.
    """

    def __init__(self, spec: Timed, random: np.random.Generator) -> None:
        self._spec = spec
        self.state = FaultState(random, math.inf, -math.inf)
        """When it occurs."""
        if spec.rate is not None:
            self.state.next = spec.start + self._wait()

    def _wait(self) -> float:
        rate = self._spec.rate
        return float(self.state.random.exponential(1.0 / rate)) if rate else 0.0

    def acts(self, time: float) -> bool:
        """Whether the fault is present at ``time`` [s]."""
        spec, time = self._spec, time + EARLY
        if time < spec.start or (spec.end is not None and time >= spec.end):
            return False
        if spec.rate is None:
            return True
        has_begun = False
        while self.state.next <= time:
            has_begun = has_begun or spec.duration == 0.0
            self.state.until = max(self.state.until, self.state.next + spec.duration)
            self.state.next += self._wait()
        return has_begun or time < self.state.until

    def next_change(self, time: float) -> float:
        """Return when it may begin or end next, after ``time`` [s]."""
        ends = (self._spec.start, self._spec.end, self.state.next, self.state.until)
        return min((end for end in ends if end is not None and end > time), default=math.inf)
