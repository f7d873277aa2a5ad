r"""Signal: the statistics of a quantity that is sampled at many steps of a level.

Over the n samples :math:`x_k` of a level, these are

.. math::
    \text{mean} = \frac1n \sum x_k \quad
    \text{rms} = \sqrt{\tfrac1n \sum x_k^2} \quad
    \text{max} = \max_k |x_k| \quad
    \text{std} = \sqrt{\tfrac1n \sum (x_k - \text{mean})^2} \quad n

so that ``rms^2 = mean^2 + std^2``. If the quantity is the norm of a vector, each component of the
vector has the same statistics.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

STATISTICS = ("mean", "rms", "max", "std", "n")
"""The names of the statistics."""
VALUES = ("last", "mean", "rms", "max")
"""The valid texts of ``u:value`` for a measure that samples a signal."""


class Signal:
    """The running statistics of a sampled total and its components (Welford's algorithm).

    Args:
        components: the names of the components.
    """

    def __init__(self, components: Sequence[str]) -> None:
        self.components = tuple(components)
        size = 1 + len(self.components)
        self.n = 0
        """The number of samples."""
        # Plain floats: a few numbers at every step cost more as arrays.
        self._last_sample = [0.0] * size
        self._mean = [0.0] * size
        self._squares = [0.0] * size  # sum of squared deviations from the mean
        self._square_sums = [0.0] * size
        self._max = [0.0] * size

    def add(self, total: float, components: Sequence[float]) -> None:
        """Add a sample: the total and its k components."""
        sample = [total, *components]
        self.n = n = self.n + 1
        means, squares, sums, maxima = self._mean, self._squares, self._square_sums, self._max
        for i, value in enumerate(sample):
            deviation = value - means[i]
            mean = means[i] = means[i] + deviation / n
            squares[i] += deviation * (value - mean)
            sums[i] += value * value
            size = abs(value)
            if size > maxima[i]:
                maxima[i] = size
        self._last_sample = sample

    def value(self, statistic: str) -> float | None:
        """Return the last, mean, rms, max or std of the total; None without samples."""
        return self._statistic(statistic, 0)

    @property
    def last_sample(self) -> tuple[float | None, ...]:
        """The newest total and components."""
        if not self.n:
            return (None,) * (1 + len(self.components))
        return tuple(self._last_sample)

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
            return self._last_sample[index]
        if name == "mean":
            return self._mean[index]
        if name == "rms":
            return math.sqrt(self._square_sums[index] / self.n)
        if name == "max":
            return self._max[index]
        return math.sqrt(max(0.0, self._squares[index]) / self.n)
