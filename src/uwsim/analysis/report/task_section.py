"""The section of a report about a task: success, failures, phases."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ...results.result import Result
from ...results.table import number_text, sensible_decimals
from ...statistics import TrialTime, success_curve
from ..plots import written_unit
from ..task import (
    TaskCell,
    crossing_sentence,
    draw_task_figures,
    find_crossings,
    success_times,
    task_cells,
    task_measure,
)
from ..templates import data_url
from .rows import ColumnHead

DETAILS = ("time_lifted", "slip", "excursion", "impulse_on_object")
"""The details of the measure that judges the task whose medians are in the table."""


@dataclass(frozen=True, kw_only=True)
class TaskRow:
    """One level in the table of a task."""

    level: tuple[str, ...]
    """The values of the swept parameters."""
    success: str
    """The number of successes: ``9 of 10``."""
    limits: str
    """The confidence limits of the success rate: ``55 to 100 %``."""
    is_at_least_half: bool
    """True if half or more of the episodes succeed."""
    failures: str
    """The failures: ``2 dropped, 1 missed``."""
    time: str
    """The median time to success over all episodes; a dash if fewer than half succeed."""
    time_limits: str
    """The confidence limits of this median: ``41.2 to 55.0``; a dash for an unknown limit."""
    medians: tuple[str, ...]
    """The medians over the successes; a dash if there is none."""


@dataclass(frozen=True, kw_only=True)
class TaskSection:
    """The section of a report about a task."""

    lead: str
    """The sentence with the number of successes over all episodes."""
    sentences: tuple[str, ...]
    """The sentences on the levels between which the success rate falls below 50 %."""
    figures: tuple[tuple[str, str], ...]
    """The caption, and the image as a data URL, of each figure."""
    median_heads: tuple[ColumnHead, ...]
    """The names and units of the medians."""
    level_heads: tuple[ColumnHead, ...]
    """The names and units of the parameters."""
    rows: tuple[TaskRow, ...]
    """The rows of the table, one for each level."""


def task_section(result: Result, folder: Path) -> TaskSection | None:
    """Return the section; None if no measure of the result judges a task.

    Args:
        result: the result.
        folder: the folder for the figures as PNG.
    """
    judge = task_measure(result)
    if judge is None:
        return None
    cells = task_cells(result)
    columns_by_name = {column.name: column for column in result.columns}
    names = [column.name for column in result.columns_of_kind("measure") if column is not judge]
    names += [f"{judge.name}.{detail}" for detail in DETAILS]
    columns = [columns_by_name[name] for name in names if name in columns_by_name]
    trials = success_times(result)
    n = sum(cell.success.n for cell in cells)
    n_ok = sum(cell.success.successes for cell in cells)
    return TaskSection(
        lead=f"{n_ok} of {n} episodes succeeded.",
        sentences=tuple(crossing_sentence(result, crossing) for crossing in find_crossings(result)),
        figures=tuple(
            (caption, data_url(path.read_bytes(), "png"))
            for path, caption in draw_task_figures(result, folder).items()
        ),
        median_heads=tuple(
            (c.name.removeprefix(f"{judge.name}."), written_unit(c.unit or "")) for c in columns
        ),
        level_heads=tuple(
            (c.name, written_unit(c.unit or "")) for c in result.columns_of_kind("level")
        ),
        rows=tuple(
            _row(result, cell, [column.name for column in columns], trials) for cell in cells
        ),
    )


def _row(
    result: Result, cell: TaskCell, columns: list[str], trials: Sequence[TrialTime] | None
) -> TaskRow:
    success = cell.success
    time, time_limits = _time_texts([trials[row] for row in cell.rows] if trials else [])
    return TaskRow(
        level=tuple(f"{value:g}" for value in cell.level),
        success=f"{success.successes} of {success.n}",
        limits=f"{100 * success.low:.0f} to {100 * success.high:.0f} %",
        is_at_least_half=success.value >= 0.5,
        failures=", ".join(f"{n} {status}" for status, n in cell.failures.items()),
        time=time,
        time_limits=time_limits,
        medians=tuple(_median(result, cell, column) for column in columns),
    )


def _time_texts(trials: Sequence[TrialTime]) -> tuple[str, str]:
    """Return the median time to success [s] and its limits, as text."""
    curve = success_curve(trials)
    if curve is None:
        return "–", ""
    median = curve.median
    value, low, high = (
        "–" if time is None or math.isinf(time) else f"{time:.1f}"
        for time in (median.value, median.low, median.high)
    )
    return value, f"{low} to {high}"


def _median(result: Result, cell: TaskCell, column: str) -> str:
    value = cell.median(result, column)
    return "–" if value is None else number_text(value, sensible_decimals([value]))
