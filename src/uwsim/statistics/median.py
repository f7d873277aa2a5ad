"""The median of values that are known only to lie in brackets, with its confidence interval."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Median:
    """The median of a sample, and the confidence limits of the median of the population."""

    n: int
    """The number of values, at least 1."""
    value: float | None
    """The median of the sample; None if its bracket has an infinite end."""
    low: float | None
    """The lower limit, which may be minus infinity; None for too few values."""
    high: float | None
    """The upper limit, which may be infinity; None for too few values."""
    confidence: float | None
    """The confidence level of the limits, at least the requested one; None without limits."""


def median_interval(brackets: Sequence[tuple[float, float]], *, confidence: float = 0.95) -> Median:
    r"""Return the median of values that lie in brackets, with its exact confidence limits.

    The limits are order statistics. Of n independent values from any distribution, the number of
    values below the median of the distribution is binomial with the probability 1/2. The interval
    from the r-th smallest to the r-th largest value therefore misses that median with the
    probability

    .. math:: 2 \sum_{i<r} \binom{n}{i} 2^{-n}

    (Thompson 1936, *Ann. Math. Stat.* 7, 122). r is the largest number for which this probability
    is at most 1 - ``confidence``, so the limits hold with *at least* this confidence. The lower
    limit is the r-th smallest lower end of the brackets, the upper limit the r-th largest upper
    end. An end is infinite for a value beyond the range of a search.

    Args:
        brackets: the lower and upper end of the bracket of each value; ends may be infinite.
        confidence: the minimum probability that the limits enclose the median.
    """
    n = len(brackets)
    if n == 0:
        raise ValueError("a median needs at least one value")
    midpoints = sorted(_midpoint(low, high) for low, high in brackets)
    middle_pair = (midpoints[(n - 1) // 2], midpoints[n // 2])
    value = math.fsum(middle_pair) / 2 if all(map(math.isfinite, middle_pair)) else None
    rank = _limit_rank(n, confidence)
    if rank == 0:
        return Median(n=n, value=value, low=None, high=None, confidence=None)
    lows, highs = sorted(low for low, _ in brackets), sorted(high for _, high in brackets)
    miss_probability = 2 * sum(math.comb(n, i) for i in range(rank)) / 2**n
    return Median(
        n=n, value=value, low=lows[rank - 1], high=highs[n - rank], confidence=1 - miss_probability
    )


def min_values_for_median(confidence: float) -> int:
    """Return the minimum number of values for which there are limits of this confidence."""
    n = 1
    while _limit_rank(n, confidence) == 0:
        n += 1
    return n


def _limit_rank(n: int, confidence: float) -> int:
    """Return the largest r whose interval misses the median with at most 1 - confidence.

    It is 0 if there is none.
    """
    max_miss_probability = (1 - confidence) * (1 + 1e-12)  # 1 - 0.9375 is a little less than 2 / 32
    n_outcomes, rank = 0, 0
    while rank < n // 2:
        n_outcomes += math.comb(n, rank)
        if 2 * n_outcomes > max_miss_probability * 2**n:
            break
        rank += 1
    return rank


def _midpoint(low: float, high: float) -> float:
    return high if math.isinf(high) else low if math.isinf(low) else (low + high) / 2
