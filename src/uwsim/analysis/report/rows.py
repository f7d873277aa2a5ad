"""The tables of a report: a line for each level, and every cell of every row."""

from __future__ import annotations

from dataclasses import dataclass

from ...results.result import Column, Result
from ...results.table import GAP, CellText, exact_decimals, lines, shown_columns, unit_of
from ..plots import written_unit
from .outcomes import reason_kind

MAX_LINES = 1000
"""The greatest number of levels in the table; further levels are in result.json only."""
MAX_CELLS = 15_000
"""The greatest number of cells in the table of all columns."""
MIN_LONG_REASON = 80
"""The number of characters above which a reason that differs only in numbers is not repeated."""
MAX_REASON_LENGTH = 100
"""The greatest number of characters of a reason in the table of all columns."""
ColumnHead = tuple[str, str]
"""The name and unit of a column."""


@dataclass(frozen=True, kw_only=True)
class TableRow:
    """One level in the table."""

    cells: tuple[tuple[str, str], ...]
    """The value and interval of levels, measures, total and time; an interval may be empty."""
    status: str
    """The status: ``ok``, ``lost``, ... or ``8 of 10 ok``."""
    rate: str
    """The confidence limits of the rate of ``ok``: ``44 to 97 %``; empty without repeats."""
    is_ok: bool
    """True if every repeat ended ``ok``."""
    reason: str
    """The reason, or ``as above``; with repeats, the number of each status."""
    begins_outer_level: bool
    """True if an outer level begins with this row."""
    rows: tuple[int, ...]
    """The numbers of its rows in the result, one for each repeat."""


def column_heads(result: Result) -> list[ColumnHead]:
    """Return the name and unit of each column of the table."""
    return [_column_head(result, column) for column in shown_columns(result)]


def level_rows(result: Result) -> list[TableRow]:
    """Return the table with a row for each level; repeats are combined."""
    table_rows: list[TableRow] = []
    previous_reason = ""
    outer_level: tuple[float, ...] | None = None
    for line in lines(result)[:MAX_LINES]:
        table_rows.append(
            TableRow(
                cells=tuple(_printed_cell(cell) for cell in line.cells),
                status=line.status,
                rate=line.rate,
                is_ok=line.is_ok,
                reason=_shorten_repeated_reason(line.reason, previous_reason),
                begins_outer_level=outer_level is not None and line.level[:-1] != outer_level,
                rows=line.rows,
            )
        )
        previous_reason, outer_level = line.reason, line.level[:-1]
    return table_rows


def all_cells(result: Result) -> tuple[list[ColumnHead], list[list[tuple[str, str]]]]:
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


def _column_head(result: Result, column: Column) -> ColumnHead:
    name = "total" if column.kind == "score" else column.name
    return name, written_unit(unit_of(result, column))


def _shorten_repeated_reason(reason: str, previous_reason: str) -> str:
    """Replace a reason that equals the reason of the row above, or differs only in numbers."""
    if reason and reason == previous_reason:
        return "as above"
    if len(reason) > MIN_LONG_REASON and reason_kind(reason) == reason_kind(previous_reason):
        return "as above, with other numbers"
    return reason


def _printed_cell(cell: CellText) -> tuple[str, str]:
    """Return value and interval with typographic signs and dashes."""
    value = "–" if cell.value == GAP else cell.value.replace("-", "−")
    return value, f"[{cell.limits}]".replace("-", "−") if cell.limits else ""


def _cell(result: Result, row: int, column: Column, decimals: int | None) -> tuple[str, str]:
    value = result.rows[row][result.index(column.name)]
    if value is None:
        reason = result.reason(row, column.name) or "no reason was recorded"
        is_long = len(reason) > MAX_REASON_LENGTH
        return "–", f"{reason[: MAX_REASON_LENGTH - 1]}…" if is_long else reason
    if isinstance(value, str):
        return value, ""
    return (f"{value:.{decimals}f}" if decimals is not None else _number(value)), ""


def _number(value: float) -> str:
    return f"{value:.0f}" if float(value).is_integer() and abs(value) < 1e6 else f"{value:.4g}"
