"""The levels at which the success rate crosses 50 % along one swept parameter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...results.result import Result
from ..plots import level_text, level_word
from .cells import TaskCell, task_cells

Level = tuple[float, ...]

HALF_RATE = 0.5


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """The neighbouring levels along a parameter between which the success rate falls below 50 %."""

    parameter: int
    """The index of the level column that varies."""
    level: Level
    """The values of all parameters; the value of the varied parameter is not used."""
    last_above: TaskCell | None
    """The level before `first_below`; None if the first level is below 50 %."""
    first_below: TaskCell | None
    """The first level below 50 %; None if no level is."""


def cells_along(cells: Sequence[TaskCell], parameter: int, level: Level) -> list[TaskCell]:
    """Return the cells that differ from ``level`` in one parameter alone, sorted by it."""

    def other_values(values: Level) -> Level:
        return (*values[:parameter], *values[parameter + 1 :])

    line = [cell for cell in cells if other_values(cell.level) == other_values(level)]
    return sorted(line, key=lambda cell: cell.level[parameter])


def find_crossing(cells: Sequence[TaskCell], parameter: int, level: Level) -> Crossing:
    """Return the levels along one parameter between which the success rate falls below 50 %."""
    last_above = first_below = None
    for cell in cells_along(cells, parameter, level):
        if cell.success.value < HALF_RATE:
            first_below = cell
            break
        last_above = cell
    return Crossing(
        parameter=parameter, level=level, last_above=last_above, first_below=first_below
    )


def find_crossings(result: Result) -> list[Crossing]:
    """Return a crossing for each parameter that varies, at each combination of the others."""
    cells = task_cells(result)
    columns = result.columns_of_kind("level")
    crossings = []
    for parameter in range(len(columns)):
        if len({cell.level[parameter] for cell in cells}) < 2:
            continue
        starts = dict.fromkeys(
            (*cell.level[:parameter], 0.0, *cell.level[parameter + 1 :]) for cell in cells
        )
        crossings += [find_crossing(cells, parameter, start) for start in starts]
    return crossings


def crossing_sentence(result: Result, crossing: Crossing) -> str:
    """Return the sentence ``The success rate falls below 50 % between fog 0.75 and 1 m⁻¹ ...``."""
    columns = result.columns_of_kind("level")
    column = columns[crossing.parameter]
    label = level_word(column)
    fixed = [
        level_text(other, value)
        for i, (other, value) in enumerate(zip(columns, crossing.level, strict=True))
        if i != crossing.parameter and other.name != "none"
    ]
    subject = f"At {', '.join(fixed)} the success rate" if fixed else "The success rate"
    cell_above, cell_below = crossing.last_above, crossing.first_below
    if cell_below is None:
        assert cell_above is not None
        last_level = level_text(column, cell_above.level[crossing.parameter])
        return f"{subject} is 50 % or above up to {last_level} ({_count_text(cell_above)})."
    level_below = level_text(column, cell_below.level[crossing.parameter])
    n_below = _count_text(cell_below)
    if cell_above is None:
        return f"{subject} is below 50 % from the first level on, {level_below} ({n_below})."
    value_above = f"{cell_above.level[crossing.parameter]:g}"
    value_below = f"{cell_below.level[crossing.parameter]:g}"
    unit = level_below.removeprefix(column.name).strip().removeprefix(value_below).strip()
    return (
        f"{subject} falls below 50 % between {label} {value_above} and {value_below} {unit} "
        f"({_count_text(cell_above)}, then {n_below})."
    )


def _count_text(cell: TaskCell) -> str:
    return f"{cell.success.successes} of {cell.success.n}"
