r"""Signal: the statistics of a quantity that is sampled many times in a level.

In addition to its value a measure of a signal has, over the samples of the level,

.. math::
    \text{mean} = \frac1n \sum x_k \quad
    \text{rms} = \sqrt{\tfrac1n \sum x_k^2} \quad
    \text{max} = \max_k |x_k| \quad
    \text{std} = \sqrt{\tfrac1n \sum (x_k - \text{mean})^2} \quad n

and the same for each of its components. ``rms^2 = mean^2 + std^2``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

STATISTICS = ("mean", "rms", "max", "std", "n")
VALUES = ("last", "mean", "rms", "max")
"""What ``u:value`` may be for a measure of a signal."""


class Signal:
    """A total and its components, sampled; keeps running sums, not samples (Welford)."""

    def __init__(self, components: Sequence[str]) -> None:
        self.components = tuple(components)
        size = 1 + len(self.components)
        self.n = 0
        """How many samples there were."""
        # Plain floats: a few numbers at every step are dearer as arrays.
        self._last = [0.0] * size
        self._mean = [0.0] * size
        self._squares = [0.0] * size  # sum of squared deviations from the mean
        self._power = [0.0] * size  # sum of squares
        self._max = [0.0] * size

    def add(self, total: float, components: Sequence[float]) -> None:
        """Take one sample: the total and its components, k plain floats."""
        sample = [total, *components]
        self.n = n = self.n + 1
        means, squares, power, most = self._mean, self._squares, self._power, self._max
        for i, value in enumerate(sample):
            off = value - means[i]
            mean = means[i] = means[i] + off / n
            squares[i] += off * (value - mean)
            power[i] += value * value
            size = abs(value)
            if size > most[i]:
                most[i] = size
        self._last = sample

    def value(self, which: str) -> float | None:
        """Return the last, mean, rms, max or std of the total; None without samples."""
        return self._statistic(which, 0)

    @property
    def last(self) -> tuple[float | None, ...]:
        """The newest total and components."""
        if not self.n:
            return (None,) * (1 + len(self.components))
        return tuple(self._last)

    @property
    def details(self) -> dict[str, float | None]:
        """All statistics of the total and of each component, by column suffix."""
        details: dict[str, float | None] = {}
        for index, component in enumerate(("", *self.components)):
            prefix = f"{component}." if component else ""
            for name in STATISTICS:
                details[prefix + name] = self._statistic(name, index)
        return details

    def _statistic(self, name: str, index: int) -> float | None:
        if name == "n":
            return float(self.n)
        if not self.n:
            return None
        if name == "last":
            return self._last[index]
        if name == "mean":
            return self._mean[index]
        if name == "rms":
            return math.sqrt(self._power[index] / self.n)
        if name == "max":
            return self._max[index]
        return math.sqrt(max(0.0, self._squares[index]) / self.n)
