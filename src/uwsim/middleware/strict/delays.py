"""A histogram of delays with bounded memory, for percentiles of runs of any length."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

MIN_DELAY = 1e-5
"""The delay from which on bins are distinguished [s]; shorter ones are in the first bin."""
BINS_PER_DECADE = 50
"""The number of bins of a decade: a percentile is exact to 5 %."""
N_DECADES = 7
"""The number of decades; longer delays are in the last bin."""
N_BINS = N_DECADES * BINS_PER_DECADE + 1
"""The number of bins."""


class Delays:
    """The delays of a stream or a step, in bins of equal ratio; what is early is counted apart."""

    def __init__(self) -> None:
        self.counts: npt.NDArray[np.int64] = np.zeros(N_BINS, np.int64)
        """The number of delays > 0 in each bin."""
        self.n_early = 0
        """The number of delays <= 0."""
        self.max_delay = 0.0
        """The max_delay delay [s]; 0 if none is positive."""

    @property
    def n(self) -> int:
        """The number of delays."""
        return self.n_early + int(self.counts.sum())

    def add(self, delay: float) -> None:
        """Add a delay [s]; it is negative for what is early."""
        if delay <= 0.0:
            self.n_early += 1
            return
        self.max_delay = max(self.max_delay, delay)
        index = 0
        if delay > MIN_DELAY:
            index = 1 + int(BINS_PER_DECADE * math.log10(delay / MIN_DELAY))
        self.counts[min(index, N_BINS - 1)] += 1

    def merge(self, delays: Delays) -> None:
        """Add all delays of another histogram."""
        self.counts += delays.counts
        self.n_early += delays.n_early
        self.max_delay = max(self.max_delay, delays.max_delay)

    def percentile(self, percent: float) -> float:
        """Return the delay that a percentage of all delays does not exceed [s]; NaN without any.

        It is the upper edge of the bin of the nearest rank, and the max_delay delay at most; 0 for
        what is early.
        """
        if self.n == 0:
            return math.nan
        rank = math.ceil(percent / 100.0 * self.n) - self.n_early
        if rank <= 0:
            return 0.0
        index = int(np.searchsorted(np.cumsum(self.counts), rank))
        return min(float(bin_edges()[index + 1]), self.max_delay)


def bin_edges() -> npt.NDArray[np.float64]:
    """Return the edges of the bins, (N_BINS + 1,) [s]; the first is 0, the second `MIN_DELAY`."""
    edges = [MIN_DELAY * 10.0 ** (i / BINS_PER_DECADE) for i in range(N_BINS)]
    return np.array([0.0, *edges])
