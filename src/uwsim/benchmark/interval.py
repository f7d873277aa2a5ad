"""Intervals: how sure a number is that was found with several seeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .result import Result


@dataclass(frozen=True, kw_only=True)
class Interval:
    """A mean and where it lies; without limits there were too few values to say."""

    n: int
    """Number of values."""
    mean: float | None
    """Arithmetic mean, in the values' unit; None without values."""
    std: float | None
    """Standard deviation of the sample (n - 1); None below two values."""
    low: float | None
    """Lower limit; None below two values."""
    high: float | None
    """Upper limit; None below two values."""

    @property
    def half(self) -> float | None:
        """Half of the width, for ``mean ± half``; None below two values."""
        return None if self.low is None or self.high is None else (self.high - self.low) / 2


@dataclass(frozen=True, kw_only=True)
class LevelInterval:
    """One column at one level, over all repeats."""

    level: tuple[float, ...]
    """The updaters' references, outermost first."""
    interval: Interval
    """Over the repeats that have a value: what is missing is counted, never guessed."""
    n_missing: int
    """Number of repeats without a value."""
    why: str | None
    """The reason of the first missing value."""


def mean_interval(values: Sequence[float], *, confidence: float = 0.95) -> Interval:
    r"""Return the mean and its two-sided Student interval.

    .. math:: \bar x \pm t_{(1+c)/2,\,n-1}\, s / \sqrt n

    exact for independent normal values. Below two values there are no limits.
    """
    from scipy.special import stdtrit

    n = len(values)
    if n == 0:
        return Interval(n=0, mean=None, std=None, low=None, high=None)
    mean = math.fsum(values) / n
    if n == 1:
        return Interval(n=1, mean=mean, std=None, low=None, high=None)
    std = math.sqrt(math.fsum((v - mean) ** 2 for v in values) / (n - 1))
    half = float(stdtrit(n - 1, (1 + confidence) / 2)) * std / math.sqrt(n)
    return Interval(n=n, mean=mean, std=std, low=mean - half, high=mean + half)


def binomial_interval(
    successes: int, n: int, *, confidence: float = 0.95
) -> tuple[float, float] | None:
    """Return the exact (Clopper and Pearson 1934) limits of a rate of success; None for n = 0."""
    from scipy.special import betaincinv

    if n == 0:
        return None
    tail = (1 - confidence) / 2
    low = float(betaincinv(successes, n - successes + 1, tail)) if successes > 0 else 0.0
    high = float(betaincinv(successes + 1, n - successes, 1 - tail)) if successes < n else 1.0
    return low, high


def rows_by_level(result: Result) -> dict[tuple[float, ...], list[int]]:
    """Return level -> its row numbers (one a repeat), in the order first played."""
    columns = [result.numbers(column.name) for column in result.of_kind("level")]
    found: dict[tuple[float, ...], list[int]] = {}
    for row in range(len(result.rows)):
        level = tuple(v for column in columns if (v := column[row]) is not None)
        found.setdefault(level, []).append(row)
    return found


def per_level(result: Result, column: str, *, confidence: float = 0.95) -> list[LevelInterval]:
    """Return a column's mean and interval at every level, over the repeats."""
    values = result.numbers(column)
    found = []
    for level, rows in rows_by_level(result).items():
        present = [v for row in rows if (v := values[row]) is not None]
        reasons = [result.why(row, column) for row in rows if values[row] is None]
        found.append(
            LevelInterval(
                level=level,
                interval=mean_interval(present, confidence=confidence),
                n_missing=len(rows) - len(present),
                why=next((why for why in reasons if why), None),
            )
        )
    return found
