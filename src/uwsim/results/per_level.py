"""Mean and confidence interval of every level over several seeds."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from ..statistics import Interval, Rate, mean_interval, rate
from .result import Result

SAME = 9
"""Decimals to which the levels of two results agree."""


@dataclass(frozen=True, kw_only=True)
class LevelInterval:
    """One column at one level, over all repeats."""

    level: tuple[float, ...]
    """The swept parameters, outermost first."""
    interval: Interval
    """Over the repeats that have a value: what is missing is counted, never guessed."""
    n_missing: int
    """Number of repeats without a value."""
    why: str | None
    """The reason of the first missing value."""


@dataclass(frozen=True, kw_only=True)
class LevelRate:
    """How often one level ended ``ok``, over all repeats."""

    level: tuple[float, ...]
    """The swept parameters, outermost first."""
    seeds: tuple[int | None, ...]
    """The seed of every repeat, in the order of execution; None where not recorded."""
    success: Rate | None
    """Repeats that ended ``ok`` among all; None when the result has no status."""


def rows_by_level(result: Result) -> dict[tuple[float, ...], list[int]]:
    """Return level -> its row numbers (one a repeat), in the order of execution."""
    columns = [result.numbers(column.name) for column in result.of_kind("level")]
    found: dict[tuple[float, ...], list[int]] = {}
    for row in range(len(result.rows)):
        level = tuple(v for column in columns if (v := column[row]) is not None)
        found.setdefault(level, []).append(row)
    return found


def rounded(level: tuple[float, ...]) -> tuple[float, ...]:
    """Return a level as it is compared with those of other results."""
    return tuple(round(value, SAME) for value in level)


def only_levels(result: Result, levels: Collection[tuple[float, ...]]) -> Result:
    """Return the rows of a result at some levels, `rounded`, and what belongs to these rows."""
    chosen = [rows for level, rows in rows_by_level(result).items() if rounded(level) in levels]
    new = {row: i for i, row in enumerate(sorted(row for rows in chosen for row in rows))}
    return replace(
        result,
        rows=tuple(result.rows[row] for row in new),
        missing=tuple(replace(m, row=new[m.row]) for m in result.missing if m.row in new),
        images=tuple(replace(m, row=new[m.row]) for m in result.images if m.row in new),
        refused=tuple(replace(m, row=new[m.row]) for m in result.refused if m.row in new),
        remarks=tuple(replace(m, row=new[m.row]) for m in result.remarks if m.row in new),
    )


def seeds_of(result: Result) -> tuple[int | None, ...]:
    """Return the seed of every row: the column ``seed``, else that of the run."""
    if any(column.name == "seed" for column in result.of_kind("run")):
        return tuple(None if v is None else round(v) for v in result.numbers("seed"))
    return (result.run.seed,) * len(result.rows)


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


def success_per_level(result: Result, *, confidence: float = 0.95) -> list[LevelRate]:
    """Return how often every level ended ``ok``, over the repeats."""
    status = result.of_kind("status")
    cells = result.values(status[0].name) if status else None
    seeds = seeds_of(result)
    found = []
    for level, rows in rows_by_level(result).items():
        n_ok = None if cells is None else sum(cells[row] == "ok" for row in rows)
        found.append(
            LevelRate(
                level=level,
                seeds=tuple(seeds[row] for row in rows),
                success=None if n_ok is None else rate(n_ok, len(rows), confidence=confidence),
            )
        )
    return found
