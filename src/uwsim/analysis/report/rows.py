"""The tables of a report: a line a level, and every cell of every row."""

from __future__ import annotations

from dataclasses import dataclass

from ...results.result import Column, Result
from ...results.table import GAP, CellText, exact_decimals, lines, shown_columns, unit_of
from ..plots import written_unit
from .outcomes import kind_of

MAX_LINES = 1000
"""Greatest number of levels in the table; others are in result.json only, with a note."""
MAX_CELLS = 15_000
"""Greatest number of cells in the table of all columns."""
LONG_REASON = 80
"""Longer reasons are not repeated where only numbers differ."""
MAX_REASON_LENGTH = 100
"""Letters of a reason behind a cell of that table."""
Head = tuple[str, str]
"""Name and unit of a column."""


@dataclass(frozen=True, kw_only=True)
class TableRow:
    """One level in the table."""

    cells: tuple[tuple[str, str], ...]
    """(value, interval) of levels, measures, total, time; an interval may be empty."""
    status: str
    """``ok``, ``lost``, ... or ``8 of 10 ok``."""
    rate: str
    """Limits of that rate: ``44 to 97 %``."""
    ok: bool
    """Whether every repeat ended ``ok``."""
    why: str
    """The reason, ``as above``, or over repeats how many ended how."""
    begins: bool
    """Whether an outer level begins here."""
    rows: tuple[int, ...]
    """Numbers of its rows in the result, one a repeat."""


def heads(result: Result) -> list[Head]:
    """Return name and unit of the table's columns."""
    return [_head(result, column) for column in shown_columns(result)]


def level_rows(result: Result) -> list[TableRow]:
    """Return the table, a row a level; repeats are gathered."""
    found: list[TableRow] = []
    above = ""
    outer: tuple[float, ...] | None = None
    for line in lines(result)[:MAX_LINES]:
        found.append(
            TableRow(
                cells=tuple(_printed(cell) for cell in line.cells),
                status=line.status,
                rate=line.rate,
                ok=line.is_ok,
                why=_told_once(line.reason, above),
                begins=outer is not None and line.level[:-1] != outer,
                rows=line.rows,
            )
        )
        above, outer = line.reason, line.level[:-1]
    return found


def all_cells(result: Result) -> tuple[list[Head], list[list[tuple[str, str]]]]:
    """Return all columns, and the rows as (text, reason) cells."""
    decimals = {
        column.name: exact_decimals(
            [float(v) for v in result.numbers(column.name) if v is not None]
        )
        for column in result.columns_of_kind("level")
    }
    n_rows = min(len(result.rows), max(1, MAX_CELLS // max(1, len(result.columns))))
    rows = [
        [_cell(result, row, column, decimals.get(column.name)) for column in result.columns]
        for row in range(n_rows)
    ]
    return [(column.name, unit_of(result, column)) for column in result.columns], rows


def _head(result: Result, column: Column) -> Head:
    name = "total" if column.kind == "score" else column.name
    return name, written_unit(unit_of(result, column))


def _told_once(why: str, above: str) -> str:
    """Leave out the reason of the line above, a long one also if only numbers differ."""
    if why and why == above:
        return "as above"
    if len(why) > LONG_REASON and kind_of(why) == kind_of(above):
        return "as above, with other numbers"
    return why


def _printed(cell: CellText) -> tuple[str, str]:
    """Value and interval, with signs and gaps as they are printed."""
    value = "–" if cell.value == GAP else cell.value.replace("-", "−")
    return value, f"[{cell.limits}]".replace("-", "−") if cell.limits else ""


def _cell(result: Result, row: int, column: Column, decimals: int | None) -> tuple[str, str]:
    value = result.rows[row][result.index(column.name)]
    if value is None:
        why = result.reason(row, column.name) or "no reason was given"
        return "–", why if len(why) <= MAX_REASON_LENGTH else f"{why[: MAX_REASON_LENGTH - 1]}…"
    if isinstance(value, str):
        return value, ""
    return (f"{value:.{decimals}f}" if decimals is not None else _number(value)), ""


def _number(value: float) -> str:
    return f"{value:.0f}" if float(value).is_integer() and abs(value) < 1e6 else f"{value:.4g}"
