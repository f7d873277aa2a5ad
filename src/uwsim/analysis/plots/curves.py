"""Curves: a column of a result over its levels."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from ...results.per_level import LevelInterval, intervals_of, rows_by_level
from ...results.result import Column, Result
from ...results.table import unit_of


@dataclass(frozen=True, kw_only=True)
class Curve:
    """One line of a plot: a column over the innermost level, means over repeats."""

    name: str
    """What the legend calls it."""
    x: tuple[float, ...]
    """The innermost level's values."""
    mean: tuple[float, ...]
    """Mean at each level; NaN, which matplotlib leaves out, where there is none."""
    low: tuple[float, ...]
    """Lower limit of the 95 % interval; NaN likewise."""
    high: tuple[float, ...]
    """Upper limit; NaN likewise."""
    n_missing: tuple[int, ...]
    """How many repeats have no value at each level."""
    values: tuple[tuple[float, ...], ...]
    """The values at each level, one a repeat that has one."""
    losses: tuple[tuple[float, str], ...]
    """(level, status) of the first level of each repeat that did not end ``ok``."""
    why: str | None
    """The first reason why a value is missing."""

    @property
    def is_empty(self) -> bool:
        """Whether no level has a value."""
        return bool(np.all(np.isnan(self.mean))) if self.mean else True

    @property
    def span(self) -> tuple[float, float] | None:
        """The least mean, and the greatest mean or limit; None where there is no value."""
        known = [v for v in self.mean if not np.isnan(v)]
        limits = [v for v in self.high if not np.isnan(v)]
        return (min(known), max(known + limits)) if known else None

    @property
    def mean_text(self) -> str:
        """The span of its means: ``48.6``, or ``32 to 48.6``."""
        known = [f"{v:.3g}" for v in sorted(self.mean) if not np.isnan(v)] or ["nan"]
        return " to ".join(dict.fromkeys([known[0], known[-1]]))

    @property
    def loss_text(self) -> str:
        """``lost at 1.2``, or over repeats ``lost at 1.15 to 1.25``; empty without a loss."""
        if not self.losses:
            return ""
        words = sorted({status for _, status in self.losses})
        levels = [level for level, _ in self.losses]
        span = f"{min(levels):g}" + (f" to {max(levels):g}" if min(levels) < max(levels) else "")
        return f"{' or '.join(words)} at {span}"


def curves_of(result: Result, column: str) -> list[Curve]:
    """Return one curve, or with nested levels one for each combination of the outer ones."""
    outer = result.columns_of_kind("level")[:-1]
    numbers, rows = result.numbers(column), rows_by_level(result)
    found: dict[tuple[float, ...], list[LevelInterval]] = {}
    for entry in intervals_of(result, column):
        found.setdefault(entry.level[:-1], []).append(entry)
    return [
        Curve(
            name=", ".join(level_text(c, value) for c, value in zip(outer, key, strict=True)),
            x=tuple(entry.level[-1] if entry.level else 0.0 for entry in entries),
            mean=tuple(_or_nan(entry.interval.mean) for entry in entries),
            low=tuple(_or_nan(entry.interval.low) for entry in entries),
            high=tuple(_or_nan(entry.interval.high) for entry in entries),
            n_missing=tuple(entry.n_missing for entry in entries),
            values=tuple(
                tuple(v for row in rows[entry.level] if (v := numbers[row]) is not None)
                for entry in entries
            ),
            losses=_losses(result, key),
            why=next((entry.reason for entry in entries if entry.reason), None),
        )
        for key, entries in found.items()
    ]


def level_text(column: Column, value: float) -> str:
    """Return a level as text: ``fog 0.5 m⁻¹``."""
    return f"{column.name} {value:g}" + (f" {written_unit(column.unit)}" if column.unit else "")


def written_unit(unit: str) -> str:
    """Return a unit as it is written behind a number: 1/m as m⁻¹."""
    return re.sub(r"^1/(\w+)$", r"\1⁻¹", unit)


def label_of(result: Result, column: Column) -> str:
    """Return what an axis is called: ``total [px]``, the unit of a sum being that of its parts."""
    unit = unit_of(result, column)
    return f"{column.name} [{written_unit(unit)}]" if unit else column.name


def algorithm_of(result: Result) -> str:
    """Return the name of the algorithm a result is about."""
    return result.run.algorithm or ""


def repeats_of(result: Result) -> list[tuple[object, ...]]:
    """Return which repeat every row belongs to: its cells of kind ``run``."""
    runs = [result.index(column.name) for column in result.columns_of_kind("run")]
    return [tuple(row[i] for i in runs) for row in result.rows]


def _or_nan(value: float | None) -> float:
    return float("nan") if value is None else value


def _losses(result: Result, outer: tuple[float, ...]) -> tuple[tuple[float, str], ...]:
    status = result.columns_of_kind("status")
    if not status or not result.columns_of_kind("level"):
        return ()
    cells = result.values(status[0].name)
    repeats = repeats_of(result)
    first: dict[tuple[object, ...], tuple[float, str]] = {}
    for level, rows in rows_by_level(result).items():
        for row in rows:
            if level[:-1] == outer and cells[row] not in ("ok", None):
                first.setdefault(repeats[row], (level[-1], str(cells[row])))
    return tuple(first.values())
