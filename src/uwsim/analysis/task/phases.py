"""The time that an algorithm spends in each phase of a task."""

from __future__ import annotations

from ...results.result import Result
from .cells import TaskCell, task_measure


def phase_means(result: Result, cell: TaskCell) -> dict[str, float]:
    """Return the mean time in each phase over all episodes of a level, in order of phases [s]."""
    judge = task_measure(result)
    if judge is None:
        return {}
    prefix = f"{judge.name}.time."
    means = {}
    for column in result.columns_of_kind("detail"):
        if column.name.startswith(prefix):
            values = result.numbers(column.name)
            times = [v for row in cell.rows if (v := values[row]) is not None]
            if times:
                means[column.name.removeprefix(prefix)] = sum(times) / len(times)
    return means
