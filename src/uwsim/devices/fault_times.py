"""When a fault is present: from one time to another, or at random with a rate."""

from __future__ import annotations

import math
from typing import ClassVar, Protocol

import numpy as np

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


class FaultTimes:
    """The times of one fault; asked at times that rise.

    With a rate it begins as a Poisson process does: the times between are exponential.
    """

    STATE: ClassVar[tuple[str, ...]] = ("_random", "_next", "_until")
    """Attributes of its state, for snapshots."""

    def __init__(self, spec: Timed, random: np.random.Generator) -> None:
        self._spec, self._random = spec, random
        self._next = math.inf if spec.rate is None else spec.start + self._wait()
        self._until = -math.inf

    def _wait(self) -> float:
        return float(self._random.exponential(1.0 / self._spec.rate)) if self._spec.rate else 0.0

    def acts(self, time: float) -> bool:
        """Whether the fault is present at ``time`` [s]."""
        spec, time = self._spec, time + EARLY
        if time < spec.start or (spec.end is not None and time >= spec.end):
            return False
        if spec.rate is None:
            return True
        has_begun = False
        while self._next <= time:
            has_begun = has_begun or spec.duration == 0.0
            self._until = max(self._until, self._next + spec.duration)
            self._next += self._wait()
        return has_begun or time < self._until

    def next_change(self, time: float) -> float:
        """Return when it may begin or end next, after ``time`` [s]."""
        ends = (self._spec.start, self._spec.end, self._next, self._until)
        return min((end for end in ends if end is not None and end > time), default=math.inf)
