"""Sampling times: a sample is due at the first step at or after its time."""

from __future__ import annotations

import math
from collections.abc import Callable


def sample_step(n: int, rate: float, timestep: float) -> int:
    """Step at which sample ``n`` of a sensor with ``rate`` [Hz] is taken."""
    return math.ceil(n / (rate * timestep) - 1e-9)


class SampleTimer:
    """Calls a function at the samples of a rate."""

    STATE = ("_start", "_n_samples", "due")
    """Attributes of its state, for snapshots."""

    def __init__(self, start: int, rate: float, timestep: float, call: Callable[[], None]) -> None:
        self._start, self._rate, self._timestep, self._call = start, rate, timestep, call
        self._n_samples = 0
        self.due = start
        """Step of the next sample."""

    def tick(self, step: int) -> None:
        """Call the function if a sample is due at this step."""
        if step >= self.due:
            self._n_samples += 1
            self.due = self._start + sample_step(self._n_samples, self._rate, self._timestep)
            self._call()
