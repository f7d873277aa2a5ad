"""Curves: the values of a column of a result over its levels."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...results.per_level import LevelInterval, intervals_of, rows_by_level
from ...results.result import Column, Result
from ...results.table import unit_of


@dataclass(frozen=True, kw_only=True)
class Curve:
    """One line of a plot: the means of a column, over repeats, at each innermost level."""

    name: str
    """The name in the legend."""
    x: tuple[float, ...]
    """The values of the innermost level."""
    mean: tuple[float, ...]
    """The mean at each level; NaN, which is not drawn, if no repeat has a value."""
    low: tuple[float, ...]
    """The lower limit of the 95 % interval at each level; NaN if there is none."""
    high: tuple[float, ...]
    """The upper limit of the 95 % interval at each level; NaN if there is none."""
    n_missing: tuple[int, ...]
    """The number of repeats without a value at each level."""
    values: tuple[tuple[float, ...], ...]
    """The values at each level, one for each repeat that has a value."""
    losses: tuple[tuple[float, str], ...]
    """The level and status of the first level of each repeat that did not end ``ok``."""
    reason: str | None
    """The first reason why a value is missing."""

    @property
    def is_empty(self) -> bool:
        """True if no level has a value."""
        return bool(np.all(np.isnan(self.mean))) if self.mean else True

    @property
    def span(self) -> tuple[float, float] | None:
        """The minimum mean, and the greatest mean or upper limit; None if there is no value."""
        present_means = [v for v in self.mean if not np.isnan(v)]
        limits = [v for v in self.high if not np.isnan(v)]
        return (min(present_means), max(present_means + limits)) if present_means else None

    @property
    def mean_text(self) -> str:
        """The range of the means as text: ``48.6``, or ``32 to 48.6``."""
        mean_texts = [f"{v:.3g}" for v in sorted(self.mean) if not np.isnan(v)] or ["nan"]
        return " to ".join(dict.fromkeys([mean_texts[0], mean_texts[-1]]))

    @property
    def loss_text(self) -> str:
        """The text ``lost at 1.2``, with repeats ``lost at 1.15 to 1.25``; empty without a loss."""
        if not self.losses:
            return ""
        statuses = sorted({status for _, status in self.losses})
        levels = [level for level, _ in self.losses]
        span = f"{min(levels):g}" + (f" to {max(levels):g}" if min(levels) < max(levels) else "")
        return f"{' or '.join(statuses)} at {span}"


def curves_of(result: Result, column: str) -> list[Curve]:
    """Return the curves of a column: one for each combination of the outer levels, if any."""
    outer_columns = result.columns_of_kind("level")[:-1]
    numbers, rows = result.numbers(column), rows_by_level(result)
    level_intervals: dict[tuple[float, ...], list[LevelInterval]] = {}
    for entry in intervals_of(result, column):
        level_intervals.setdefault(entry.level[:-1], []).append(entry)
    return [
        Curve(
            name=", ".join(
                level_text(c, v) for c, v in zip(outer_columns, outer_level, strict=True)
            ),
            x=tuple(entry.level[-1] if entry.level else 0.0 for entry in entries),
            mean=tuple(_number(entry.interval.mean) for entry in entries),
            low=tuple(_number(entry.interval.low) for entry in entries),
            high=tuple(_number(entry.interval.high) for entry in entries),
            n_missing=tuple(entry.n_missing for entry in entries),
            values=tuple(
                tuple(v for row in rows[entry.level] if (v := numbers[row]) is not None)
                for entry in entries
            ),
            losses=_losses(result, outer_level),
            reason=next((entry.reason for entry in entries if entry.reason), None),
        )
        for outer_level, entries in level_intervals.items()
    ]


def level_text(column: Column, value: float) -> str:
    """Return a level as text: ``fog 0.5 m⁻¹``."""
    return f"{column.name} {value:g}" + (f" {written_unit(column.unit)}" if column.unit else "")


def levels_text(columns: Sequence[Column], level: Sequence[float]) -> str:
    """Return the values of nested levels as text: ``noise 0.02, fog 0.5 m⁻¹``."""
    texts = [level_text(c, v) for c, v in zip(columns, level, strict=True) if c.name != "none"]
    return ", ".join(texts) or "the only level"


def written_unit(unit: str) -> str:
    """Return a unit as it is written after a number: m⁻¹ for 1/m, µPa² for uPa2."""
    return re.sub(r"^1/(\w+)$", r"\1⁻¹", unit).replace("uPa2", "µPa²")


def label_of(result: Result, column: Column) -> str:
    """Return the label of an axis: ``total [px]``; a sum has the unit of its terms."""
    unit = unit_of(result, column)
    return f"{column.name} [{written_unit(unit)}]" if unit else column.name


def algorithm_of(result: Result) -> str:
    """Return the name of the algorithm of a result, without folders; empty without one."""
    return result.run.algorithm_label


def repeats_of(result: Result) -> list[tuple[object, ...]]:
    """Return the repeat of every row: its cells of kind ``run``."""
    runs = [result.index(column.name) for column in result.columns_of_kind("run")]
    return [tuple(row[i] for i in runs) for row in result.rows]


def _number(value: float | None) -> float:
    return float("nan") if value is None else value


def _losses(result: Result, outer_level: tuple[float, ...]) -> tuple[tuple[float, str], ...]:
    status = result.columns_of_kind("status")
    if not status or not result.columns_of_kind("level"):
        return ()
    cells = result.values(status[0].name)
    repeats = repeats_of(result)
    first_losses: dict[tuple[object, ...], tuple[float, str]] = {}
    for level, rows in rows_by_level(result).items():
        for row in rows:
            if level[:-1] == outer_level and cells[row] not in ("ok", None):
                first_losses.setdefault(repeats[row], (level[-1], str(cells[row])))
    return tuple(first_losses.values())
