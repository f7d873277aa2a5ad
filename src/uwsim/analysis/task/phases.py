"""How long the phases of an algorithm took, over the levels of a result."""

from __future__ import annotations

from ...results.result import Result
from .cells import TaskCell, task_measure


def phase_means(result: Result, cell: TaskCell) -> dict[str, float]:
    """Mean time in each phase over all episodes of a level, in the phases' order [s]."""
    judge = task_measure(result)
    if judge is None:
        return {}
    prefix = f"{judge.name}.time."
    found = {}
    for column in result.columns_of_kind("detail"):
        if column.name.startswith(prefix):
            values = result.numbers(column.name)
            present = [v for row in cell.rows if (v := values[row]) is not None]
            if present:
                found[column.name.removeprefix(prefix)] = sum(present) / len(present)
    return found
