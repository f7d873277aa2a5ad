"""The table printed after a run: a line for each level, with units and reasons for gaps.

.. code-block:: text

      fog  corners  total  ended_at
    [1/m]     [px]   [px]       [s]  status
     0.00     1.83   4.24       2.0  ok
     1.20        -      -      50.0  lost    tracker lost at 48.6 s: ZNCC 0.43 on 5 frames

``ended_at`` is the benchmark's running time, summed over the levels so far; where levels are
independent, it counts from the start of the level.

With several repeats a measure is its mean with the 95 % interval, ``1.83 [1.71, 1.99]``, and the
status has the number that ended ``ok``, with the interval of the rate: ``8 of 10 ok, 44 to 97 %``.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from rich.table import Table
from rich.text import Text

from ..statistics import Interval, Rate, rate
from .per_level import intervals_of, rows_by_level
from .result import Column, Result

GAP = "-"
MIN_REASON_WIDTH = 30
"""The minimum width of a column of reasons; if less is left, they are printed under the table."""
MAX_DECIMALS = 4
"""The greatest number of decimals of a measure."""
MAX_FIXED = 1e7
"""The absolute value from which numbers have an exponent instead of fixed decimals."""


@dataclass(frozen=True)
class CellText:
    """A value as text, with its confidence limits: ``1.83 [1.71, 1.99]``."""

    value: str
    """``1.83``; ``-`` if there is no value."""
    limits: str = ""
    """``1.71, 1.99``; empty if there are no limits."""

    def __str__(self) -> str:
        return f"{self.value} [{self.limits}]" if self.limits else self.value


@dataclass(frozen=True, kw_only=True)
class LevelLine:
    """The line of one level in the table, as text."""

    level: tuple[float, ...]
    """The values of the swept parameters, outermost first."""
    cells: tuple[CellText, ...]
    """The texts in the columns of `shown_columns`."""
    status: str
    """``ok``, ``lost``, ...; with repeats, ``8 of 10 ok``."""
    rate: str
    """The confidence limits of the rate of ``ok``: ``44 to 97 %``; empty without repeats."""
    is_ok: bool
    """True if every repeat ended ``ok``."""
    reason: str
    """The reasons and remarks, each once; with repeats, how often each status and remark occurs."""
    rows: tuple[int, ...] = ()
    """The numbers of the level's rows, one for each repeat."""

    @property
    def status_text(self) -> str:
        """Status and rate: ``8 of 10 ok, 44 to 97 %``."""
        return f"{self.status}, {self.rate}" if self.rate else self.status


def shown_columns(result: Result) -> tuple[Column, ...]:
    """Return the columns of the table: levels, measures, total, time (not the details)."""
    return (
        result.columns_of_kind("level")
        + result.columns_of_kind("measure", "score")
        + result.columns_of_kind("time")
    )


def lines(result: Result) -> tuple[LevelLine, ...]:
    """Return the table's lines, one for each level; repeats are combined."""
    levels = rows_by_level(result)
    texts: list[list[CellText]] = []
    for i, column in enumerate(shown_columns(result)):
        if column.kind == "level":
            numbers = [level[i] for level in levels]
            decimals = exact_decimals(numbers)
            texts.append([CellText(number_text(value, decimals)) for value in numbers])
        else:
            intervals = [entry.interval for entry in intervals_of(result, column.name)]
            decimals = sensible_decimals([i.mean for i in intervals if i.mean is not None])
            texts.append([interval_text(interval, decimals) for interval in intervals])
    return tuple(
        LevelLine(
            level=level,
            cells=tuple(text[n] for text in texts),
            status=_status(result, rows),
            rate=_rate(result, rows),
            is_ok=all(status == "ok" for status in _statuses(result, rows)),
            reason=_reason_text(result, rows),
            rows=tuple(rows),
        )
        for n, (level, rows) in enumerate(levels.items())
    )


def table(result: Result, *, width: int = 80) -> Table:
    """Return the table for a terminal of ``width`` columns.

    Measures that do not fit are omitted and named below the table; levels and status are always
    shown. Reasons are in the last column if the width suffices, or else below the table.
    """
    level_lines = lines(result)
    columns = shown_columns(result)
    heads = [_head(result, column) for column in columns]
    widths = [
        max([len(name), len(unit), *(len(str(line.cells[i])) for line in level_lines)])
        for i, (name, unit) in enumerate(heads)
    ]
    status_width = max([len("status"), *(len(line.status_text) for line in level_lines)])
    indices = _fit_columns(columns, widths, width - status_width)
    text_table = Table(box=None, pad_edge=False, header_style="bold", caption_justify="left")
    for i in indices:
        head = Text("\n".join(heads[i]), justify="right")
        text_table.add_column(head, justify="right", no_wrap=True, min_width=widths[i])
    text_table.add_column(Text("status"), overflow="fold", min_width=min(status_width, width))
    taken_width = sum(widths[i] + 2 for i in indices) + status_width
    has_reason_column = width - taken_width - 2 >= MIN_REASON_WIDTH
    if has_reason_column and any(line.reason for line in level_lines):
        text_table.add_column(Text(""), overflow="fold")
    last_reason = ""
    for line in level_lines:
        cells = [*(str(line.cells[i]) for i in indices), line.status_text]
        if len(text_table.columns) > len(cells):
            cells.append("as above" if line.reason and line.reason == last_reason else line.reason)
            last_reason = line.reason
        text_table.add_row(*map(Text, cells), style="" if line.is_ok else "yellow")
    notes = [] if has_reason_column else _notes(level_lines, len(result.columns_of_kind("level")))
    if left_out := [name for i, (name, _) in enumerate(heads) if i not in indices]:
        notes.append(f"not shown, too narrow: {', '.join(left_out)}")
    text_table.caption = Text("\n".join(notes), style="yellow") if notes else None
    return text_table


def _fit_columns(columns: Sequence[Column], widths: Sequence[int], space: int) -> list[int]:
    """Return the indices of the columns that fit next to the status, in a space [characters].

    All levels are included; then, while space is left, total, time and measures.
    """
    order = ("level", "score", "time", "measure")
    indices: list[int] = []
    for i in sorted(range(len(columns)), key=lambda i: order.index(columns[i].kind)):
        if columns[i].kind == "level" or widths[i] + 2 <= space:
            indices.append(i)
            space -= widths[i] + 2
    return sorted(indices)


def unit_of(result: Result, column: Column) -> str:
    """Return the unit of a column; a sum of measures with the same unit has this unit."""
    if column.unit or column.kind != "score" or not column.expression:
        return column.unit or ""
    units = {measure.name: measure.unit for measure in result.columns_of_kind("measure")}
    term_units = {units.get(name.strip()) for name in column.expression.split("+")}
    return term_units.pop() or "" if len(term_units) == 1 else ""


def interval_text(interval: Interval, decimals: int) -> CellText:
    """Return ``1.83 [1.71, 1.99]``, ``1.83`` without limits, ``-`` without values."""
    if interval.mean is None:
        return CellText(GAP)
    text = number_text(interval.mean, decimals)
    if interval.low is None or interval.high is None:
        return CellText(text)
    low, high = number_text(interval.low, decimals), number_text(interval.high, decimals)
    return CellText(text, "" if low == high == text else f"{low}, {high}")


def rate_text(success: Rate) -> str:
    """Return ``44 to 97 %``, the limits of a rate."""
    return f"{100 * success.low:.0f} to {100 * success.high:.0f} %"


def number_text(value: float, decimals: int) -> str:
    """Return ``1.83``; or ``1e+38``, ``2.5e-09`` if fixed decimals are too long or show zero."""
    is_small = decimals >= MAX_DECIMALS and 0 < abs(value) < 0.5 * 10**-decimals
    return f"{value:.3g}" if abs(value) >= MAX_FIXED or is_small else f"{value:.{decimals}f}"


def exact_decimals(values: Sequence[float]) -> int:
    """Return the number of decimals that a sweep's values need: 2 for steps of 0.05, at most 6."""
    texts = [f"{value:.6f}".rstrip("0") for value in values]
    return max((len(text.partition(".")[2]) for text in texts), default=0)


def sensible_decimals(values: Sequence[float]) -> int:
    """Return the number of decimals for three digits of the median value, 0 to 4."""
    sizes = sorted(abs(value) for value in values if value != 0)
    if not sizes:
        return 2
    return min(MAX_DECIMALS, max(0, 2 - math.floor(math.log10(sizes[len(sizes) // 2]))))


def _head(result: Result, column: Column) -> tuple[str, str]:
    unit = unit_of(result, column)
    return column.name, f"[{unit}]" if unit else ""


def _notes(level_lines: Sequence[LevelLine], n_levels: int) -> list[str]:
    """Return a note for each sequence of lines with the same reason: ``1.20 to 1.30: lost ...``."""
    notes = []
    for reason, run in itertools.groupby(level_lines, key=lambda line: line.reason):
        levels = [" ".join(map(str, line.cells[:n_levels])) for line in run]
        if reason:
            level_range = f"{levels[0]} to {levels[-1]}" if len(levels) > 1 else levels[0]
            notes.append(f"{level_range}: {reason}")
    return notes


def _statuses(result: Result, rows: Sequence[int]) -> list[str]:
    status = result.columns_of_kind("status")
    index = result.index(status[0].name) if status else 0
    return [str(result.rows[row][index]) for row in rows] if status else []


def _status(result: Result, rows: Sequence[int]) -> str:
    statuses = _statuses(result, rows)
    if len(statuses) < 2:
        return "".join(statuses)
    return f"{statuses.count('ok')} of {len(statuses)} ok"


def _rate(result: Result, rows: Sequence[int]) -> str:
    statuses = _statuses(result, rows)
    limits = rate(statuses.count("ok"), len(statuses)) if len(statuses) > 1 else None
    return "" if limits is None else rate_text(limits)


def _reason_text(result: Result, rows: Sequence[int]) -> str:
    if len(rows) == 1:
        return "; ".join((*result.reasons(rows[0]), *result.remarks_of(rows[0])))
    counts = Counter(status for status in _statuses(result, rows) if status != "ok")
    parts = [", ".join(f"{n} {status}" for status, n in sorted(counts.items()))]
    remarks = Counter(text for row in rows for text in result.remarks_of(row))
    parts += [f"{n} of {len(rows)}: {text}" for text, n in sorted(remarks.items())]
    return "; ".join(filter(None, parts))
