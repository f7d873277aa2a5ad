"""Where the success rate crosses 50 % along one swept parameter, the others at a fixed value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...results.result import Result
from ..plots import LEVEL_WORDS, level_text
from .cells import TaskCell, task_cells

HALF = 0.5


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """The first level along a parameter at which fewer than half of the episodes succeed."""

    parameter: int
    """Number of the level column that varies."""
    at: tuple[float, ...]
    """Values of all parameters; that of the one that varies does not count."""
    holds: TaskCell | None
    """The last level before it; None: the first level is below half already."""
    breaks: TaskCell | None
    """The level; None: half or more succeed everywhere."""


def along(cells: Sequence[TaskCell], parameter: int, at: tuple[float, ...]) -> list[TaskCell]:
    """Return the cells that differ from ``at`` in one parameter alone, in its order."""
    line = [
        cell
        for cell in cells
        if all(
            a == b for i, (a, b) in enumerate(zip(cell.level, at, strict=True)) if i != parameter
        )
    ]
    return sorted(line, key=lambda cell: cell.level[parameter])


def crossing(cells: Sequence[TaskCell], parameter: int, at: tuple[float, ...]) -> Crossing:
    """Find where the rate falls below half along one parameter."""
    holds = None
    for cell in along(cells, parameter, at):
        if cell.success.value < HALF:
            return Crossing(parameter=parameter, at=at, holds=holds, breaks=cell)
        holds = cell
    return Crossing(parameter=parameter, at=at, holds=holds, breaks=None)


def crossings(result: Result) -> list[Crossing]:
    """Return a crossing for each parameter that varies, at each value of the others."""
    cells = task_cells(result)
    columns = result.columns_of_kind("level")
    found = []
    for parameter in range(len(columns)):
        if len({cell.level[parameter] for cell in cells}) < 2:
            continue
        starts = dict.fromkeys(
            (*cell.level[:parameter], 0.0, *cell.level[parameter + 1 :]) for cell in cells
        )
        found += [crossing(cells, parameter, start) for start in starts]
    return found


def sentence(result: Result, found: Crossing) -> str:
    """Say where it is: ``At current 0 m/s it falls below 50 % between fog 0.75 and 1 m⁻¹``."""
    columns = result.columns_of_kind("level")
    column = columns[found.parameter]
    word = LEVEL_WORDS.get(column.name, column.name)
    fixed = [
        level_text(other, value)
        for i, (other, value) in enumerate(zip(columns, found.at, strict=True))
        if i != found.parameter and other.name != "none"
    ]
    where = f"At {', '.join(fixed)} " if fixed else ""
    it = "the success rate" if fixed else "The success rate"
    if found.breaks is None:
        assert found.holds is not None
        last = level_text(column, found.holds.level[found.parameter])
        return f"{where}{it} stays at 50 % or above up to {last} ({_of(found.holds)})."
    broken = level_text(column, found.breaks.level[found.parameter])
    if found.holds is None:
        return f"{where}{it} is below 50 % from the first level on, {broken} ({_of(found.breaks)})."
    held = f"{found.holds.level[found.parameter]:g}"
    value = f"{found.breaks.level[found.parameter]:g}"
    unit = broken.removeprefix(column.name).strip().removeprefix(value).strip()
    return (
        f"{where}{it} falls below 50 % between {word} {held} and {value} {unit} "
        f"({_of(found.holds)}, then {_of(found.breaks)})."
    )


def _of(cell: TaskCell) -> str:
    return f"{cell.success.successes} of {cell.success.n}"
