"""Mean and confidence interval of every level over several seeds."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from ..base.deprecation import deprecated_name
from ..statistics import Interval, Rate, mean_interval, rate
from .result import Result

LEVEL_DECIMALS = 9
"""The number of decimals to which equal levels of two results agree."""


@dataclass(frozen=True, kw_only=True)
class LevelInterval:
    """The mean and confidence interval of one column at one level, over all repeats."""

    level: tuple[float, ...]
    """The values of the swept parameters, outermost first."""
    interval: Interval
    """The interval over the repeats with a value; missing values are counted, never estimated."""
    n_missing: int
    """The number of repeats without a value."""
    reason: str | None
    """The reason of the first missing value."""


@dataclass(frozen=True, kw_only=True)
class LevelRate:
    """The success rate of one level, over all repeats."""

    level: tuple[float, ...]
    """The values of the swept parameters, outermost first."""
    seeds: tuple[int | None, ...]
    """The seed of every repeat, in the order of execution; None if it is not recorded."""
    success: Rate | None
    """The rate of repeats that ended ``ok``; None if the result has no status."""


def rows_by_level(result: Result) -> dict[tuple[float, ...], list[int]]:
    """Return the row indices of each level (one for each repeat), in the order of execution."""
    columns = [result.numbers(column.name) for column in result.columns_of_kind("level")]
    row_numbers: dict[tuple[float, ...], list[int]] = {}
    for row in range(len(result.rows)):
        level = tuple(v for column in columns if (v := column[row]) is not None)
        row_numbers.setdefault(level, []).append(row)
    return row_numbers


def round_level(level: tuple[float, ...]) -> tuple[float, ...]:
    """Return a level rounded for comparison with levels of other results."""
    return tuple(round(value, LEVEL_DECIMALS) for value in level)


def select_levels(result: Result, levels: Collection[tuple[float, ...]]) -> Result:
    """Return a result with only the rows at some levels, rounded by `round_level`."""
    groups = [rows for level, rows in rows_by_level(result).items() if round_level(level) in levels]
    indices = {row: i for i, row in enumerate(sorted(row for rows in groups for row in rows))}
    return replace(
        result,
        rows=tuple(result.rows[row] for row in indices),
        missing_values=tuple(
            replace(m, row=indices[m.row]) for m in result.missing_values if m.row in indices
        ),
        images=tuple(replace(m, row=indices[m.row]) for m in result.images if m.row in indices),
        refused_messages=tuple(
            replace(m, row=indices[m.row]) for m in result.refused_messages if m.row in indices
        ),
        remarks=tuple(replace(m, row=indices[m.row]) for m in result.remarks if m.row in indices),
    )


def seeds_of(result: Result) -> tuple[int | None, ...]:
    """Return the seed of every row: from the column ``seed``, or else the seed of the run."""
    if any(column.name == "seed" for column in result.columns_of_kind("run")):
        return tuple(None if v is None else round(v) for v in result.numbers("seed"))
    return (result.run.seed,) * len(result.rows)


def intervals_of(result: Result, column: str, *, confidence: float = 0.95) -> list[LevelInterval]:
    """Return a column's mean and interval at every level, over the repeats."""
    values = result.numbers(column)
    intervals = []
    for level, rows in rows_by_level(result).items():
        present_values = [v for row in rows if (v := values[row]) is not None]
        reasons = [result.reason(row, column) for row in rows if values[row] is None]
        intervals.append(
            LevelInterval(
                level=level,
                interval=mean_interval(present_values, confidence=confidence),
                n_missing=len(rows) - len(present_values),
                reason=next((reason for reason in reasons if reason), None),
            )
        )
    return intervals


@deprecated_name("intervals_of")
def per_level(result: Result, column: str, *, confidence: float = 0.95) -> list[LevelInterval]:
    """Call `intervals_of`; this is its deprecated name."""
    return intervals_of(result, column, confidence=confidence)


def success_rates(result: Result, *, confidence: float = 0.95) -> list[LevelRate]:
    """Return the rate of repeats that ended ``ok``, for every level."""
    status = result.columns_of_kind("status")
    cells = result.values(status[0].name) if status else None
    seeds = seeds_of(result)
    rates = []
    for level, rows in rows_by_level(result).items():
        n_ok = None if cells is None else sum(cells[row] == "ok" for row in rows)
        rates.append(
            LevelRate(
                level=level,
                seeds=tuple(seeds[row] for row in rows),
                success=None if n_ok is None else rate(n_ok, len(rows), confidence=confidence),
            )
        )
    return rates
