"""The levels of the result of a task: success rates, failures, medians over the successes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from statistics import median

from ...results.per_level import rows_by_level
from ...results.result import Column, Result
from ...statistics import Rate, rate

JUDGING_DETAIL = "time_done"
"""The name of the detail by which the measure that judges a task is recognised."""


@dataclass(frozen=True, kw_only=True)
class TaskCell:
    """The outcomes of the episodes (one for each seed) of a task at one level."""

    level: tuple[float, ...]
    """The values of the swept parameters, outermost first."""
    success: Rate
    """The rate of episodes that ended ``ok``, with exact 95 % limits."""
    failures: Mapping[str, int]
    """The number of episodes with each other status, the most frequent status first."""
    rows: tuple[int, ...]
    """The numbers of the level's rows in the result."""

    def median(self, result: Result, column: str) -> float | None:
        """Return the median of a column over the successes of the level; None without any."""
        status = result.values(result.columns_of_kind("status")[0].name)
        values = result.numbers(column)
        ok_rows = [row for row in self.rows if status[row] == "ok"]
        present_values = [value for row in ok_rows if (value := values[row]) is not None]
        return median(present_values) if present_values else None


def task_measure(result: Result) -> Column | None:
    """Return the column of the measure that judges the task; None without a task."""
    suffix = f".{JUDGING_DETAIL}"
    names = [
        column.name for column in result.columns_of_kind("detail") if column.name.endswith(suffix)
    ]
    if not names or not result.columns_of_kind("status"):
        return None
    return result.columns[result.index(names[0].removesuffix(suffix))]


def task_cells(result: Result) -> list[TaskCell]:
    """Return the outcomes at each level, in the order of execution."""
    status = [str(cell) for cell in result.values(result.columns_of_kind("status")[0].name)]
    cells = []
    for level, rows in rows_by_level(result).items():
        counts = Counter(status[row] for row in rows)
        n_ok = counts.pop("ok", 0)
        success = rate(n_ok, len(rows))
        assert success is not None
        failures = dict(sorted(counts.items(), key=lambda item: (-item[1], item[0])))
        cells.append(TaskCell(level=level, success=success, failures=failures, rows=tuple(rows)))
    return cells
