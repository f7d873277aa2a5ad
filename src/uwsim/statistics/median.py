"""The median of interval-censored values, with its exact confidence interval."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Median:
    """A sample median and the confidence limits of the true median."""

    n: int
    """Number of values, at least 1."""
    value: float | None
    """Their median; None where it is censored."""
    low: float | None
    """Lower limit, minus infinity where it is censored; None: too few values."""
    high: float | None
    """Upper limit, likewise."""
    confidence: float | None
    """Confidence level of the limits, at least the requested one."""


def median_interval(brackets: Sequence[tuple[float, float]], *, confidence: float = 0.95) -> Median:
    r"""Return the median of values, each known to lie within a bracket, with its exact limits.

    The limits are order statistics: of n independent values the number below their median is
    binomial with rate 1/2 whatever their distribution, so from the r-th smallest to the r-th
    largest value is an interval that misses it with probability

    .. math:: 2 \sum_{i<r} \binom{n}{i} 2^{-n}

    (Thompson 1936, *Ann. Math. Stat.* 7, 122). r is the largest for which that is at most
    :math:`1 - c`: limits hold *at least* as surely as asked. Of brackets the r-th smallest lower
    and the r-th largest upper ends are taken, which lie outside. With infinite ends values need
    not even be known: those beyond the reach of a search still count.

    Args:
        brackets: (low, high) of each value; either may be infinite.
        confidence: how surely the limits shall hold the median.
    """
    n = len(brackets)
    if n == 0:
        raise ValueError("a median needs at least one value")
    middles = sorted(_middle(low, high) for low, high in brackets)
    centre = (middles[(n - 1) // 2], middles[n // 2])
    value = math.fsum(centre) / 2 if all(map(math.isfinite, centre)) else None
    rank = _rank(n, confidence)
    if rank == 0:
        return Median(n=n, value=value, low=None, high=None, confidence=None)
    lows, highs = sorted(low for low, _ in brackets), sorted(high for _, high in brackets)
    missed = 2 * sum(math.comb(n, i) for i in range(rank)) / 2**n
    return Median(n=n, value=value, low=lows[rank - 1], high=highs[n - rank], confidence=1 - missed)


def fewest_for_median(confidence: float) -> int:
    """Return how many values are needed before there are limits that sure."""
    n = 1
    while _rank(n, confidence) == 0:
        n += 1
    return n


def _rank(n: int, confidence: float) -> int:
    """The largest r whose interval misses with a probability of at most 1 - confidence."""
    allowed = (1 - confidence) * (1 + 1e-12)  # 1 - 0.9375 is a little less than 2 / 32
    below, rank = 0, 0
    while rank < n // 2:
        below += math.comb(n, rank)
        if 2 * below > allowed * 2**n:
            break
        rank += 1
    return rank


def _middle(low: float, high: float) -> float:
    return high if math.isinf(high) else low if math.isinf(low) else (low + high) / 2
