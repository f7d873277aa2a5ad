"""The section of a report about a task: success, failures, phases."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ...results.result import Result
from ...results.table import number_text, sensible_decimals
from ..plots import written_unit
from ..task import (
    TaskCell,
    crossings,
    draw_task_figures,
    sentence,
    task_cells,
    task_measure,
)
from .images import data_url
from .rows import Head

DETAILS = ("time_lifted", "slip", "excursion", "impulse_on_object")
"""Of the measure that judges: what the table has of the successes."""


@dataclass(frozen=True, kw_only=True)
class TaskRow:
    """One level in the table of a task."""

    level: tuple[str, ...]
    """The swept parameters."""
    success: str
    """``9 of 10``."""
    limits: str
    """``55 to 100 %``."""
    is_half: bool
    """Whether half or more succeed."""
    failures: str
    """``2 dropped, 1 missed``."""
    medians: tuple[str, ...]
    """Of the successes; a dash where there are none."""


@dataclass(frozen=True, kw_only=True)
class TaskSection:
    """What a report says of a task."""

    lead: str
    """Successes of all episodes."""
    sentences: tuple[str, ...]
    """Where the rate crosses 50 %."""
    figures: tuple[tuple[str, str], ...]
    """(caption, image as a data URL)."""
    heads: tuple[Head, ...]
    """Name and unit of the medians."""
    level_heads: tuple[Head, ...]
    """Name and unit of the parameters."""
    rows: tuple[TaskRow, ...]
    """One a level."""


def task_section(result: Result, folder: Path) -> TaskSection | None:
    """Return the section; None for a result that is not of a task.

    Args:
        result: what is reported.
        folder: the figures are written there as PNG.
    """
    judge = task_measure(result)
    if judge is None:
        return None
    cells = task_cells(result)
    known = {column.name: column for column in result.columns}
    wanted = [column.name for column in result.columns_of_kind("measure") if column is not judge]
    wanted += [f"{judge.name}.{detail}" for detail in DETAILS]
    columns = [known[name] for name in wanted if name in known]
    n = sum(cell.success.n for cell in cells)
    n_ok = sum(cell.success.successes for cell in cells)
    return TaskSection(
        lead=f"{n_ok} of {n} episodes succeeded.",
        sentences=tuple(sentence(result, each) for each in crossings(result)),
        figures=tuple(
            (caption, data_url(path.read_bytes(), "png"))
            for path, caption in draw_task_figures(result, folder).items()
        ),
        heads=tuple(
            (c.name.removeprefix(f"{judge.name}."), written_unit(c.unit or "")) for c in columns
        ),
        level_heads=tuple(
            (c.name, written_unit(c.unit or "")) for c in result.columns_of_kind("level")
        ),
        rows=tuple(_row(result, cell, [column.name for column in columns]) for cell in cells),
    )


def _row(result: Result, cell: TaskCell, columns: list[str]) -> TaskRow:
    success = cell.success
    return TaskRow(
        level=tuple(f"{value:g}" for value in cell.level),
        success=f"{success.successes} of {success.n}",
        limits=f"{100 * success.low:.0f} to {100 * success.high:.0f} %",
        is_half=success.value >= 0.5,
        failures=", ".join(f"{n} {status}" for status, n in cell.failures.items()),
        medians=tuple(_median(result, cell, column) for column in columns),
    )


def _median(result: Result, cell: TaskCell, column: str) -> str:
    value = cell.median(result, column)
    return "–" if value is None else number_text(value, sensible_decimals([value]))
