"""The table printed after a run: a line for each level, with units and reasons for gaps.

.. code-block:: text

      fog  corners  total  ended_at
    [1/m]     [px]   [px]       [s]  status
     0.00     1.83   4.24       2.0  ok
     1.20        -      -      50.0  lost    tracker lost at 48.6 s: ZNCC 0.43 on 5 frames

``ended_at`` is the benchmark's running time, summed over the levels so far; where levels are
independent, it counts from the start of the level.

With several repeats a measure is its mean with the 95 % interval, ``1.83 [1.71, 1.99]``, and the
status says how many ended ``ok``, with the interval of that rate: ``8 of 10 ok, 44 to 97 %``.
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
from .per_level import per_level, rows_by_level
from .result import Column, Result

GAP = "-"
ROOM_FOR_REASONS = 30
"""Width of a terminal below which reasons are printed under the table."""
MAX_DECIMALS = 4
"""Of a measure."""
BIG = 1e7
"""Numbers from here on are written with an exponent."""


@dataclass(frozen=True)
class CellText:
    """A value as text, and its limits: ``1.83 [1.71, 1.99]``."""

    value: str
    """``1.83``; ``-`` where there is nothing."""
    limits: str = ""
    """``1.71, 1.99``; empty where there are none."""

    def __str__(self) -> str:
        return f"{self.value} [{self.limits}]" if self.limits else self.value


@dataclass(frozen=True, kw_only=True)
class LevelLine:
    """One level, as text."""

    level: tuple[float, ...]
    """The swept parameters."""
    cells: tuple[CellText, ...]
    """Level, measures, total, ended_at."""
    status: str
    """``ok``, ``lost``, ... or, over repeats, ``8 of 10 ok``."""
    rate: str
    """Limits of that rate: ``44 to 97 %``; empty without repeats."""
    ok: bool
    """Whether every repeat ended ``ok``."""
    why: str
    """The reasons and remarks, each once; over repeats: how many ended how."""
    rows: tuple[int, ...] = ()
    """Numbers of its rows, one a repeat."""

    @property
    def status_text(self) -> str:
        """Status and rate: ``8 of 10 ok, 44 to 97 %``."""
        return f"{self.status}, {self.rate}" if self.rate else self.status


def shown_columns(result: Result) -> tuple[Column, ...]:
    """Return the columns of the table: levels, measures, total, time (not the details)."""
    return result.of_kind("level") + result.of_kind("measure", "score") + result.of_kind("time")


def lines(result: Result) -> tuple[LevelLine, ...]:
    """Return the table's lines, a line a level; repeats are gathered."""
    levels = rows_by_level(result)
    texts: list[list[CellText]] = []
    for i, column in enumerate(shown_columns(result)):
        if column.kind == "level":
            numbers = [level[i] for level in levels]
            decimals = exact_decimals(numbers)
            texts.append([CellText(number_text(value, decimals)) for value in numbers])
        else:
            intervals = [entry.interval for entry in per_level(result, column.name)]
            decimals = sensible_decimals([i.mean for i in intervals if i.mean is not None])
            texts.append([interval_text(interval, decimals) for interval in intervals])
    return tuple(
        LevelLine(
            level=level,
            cells=tuple(text[n] for text in texts),
            status=_status(result, rows),
            rate=_rate(result, rows),
            ok=all(status == "ok" for status in _statuses(result, rows)),
            why=_why(result, rows),
            rows=tuple(rows),
        )
        for n, (level, rows) in enumerate(levels.items())
    )


def table(result: Result, *, width: int = 80) -> Table:
    """Return the table for a terminal of ``width`` columns.

    Measures that do not fit are left out and named below, levels and status never. Reasons follow
    their line where there is room, else the table.
    """
    shown = lines(result)
    columns = shown_columns(result)
    heads = [_head(result, column) for column in columns]
    wide = [
        max([len(name), len(unit), *(len(str(line.cells[i])) for line in shown)])
        for i, (name, unit) in enumerate(heads)
    ]
    last = max([len("status"), *(len(line.status_text) for line in shown)])
    fitting = _fitting(columns, wide, width - last)
    drawn = Table(box=None, pad_edge=False, header_style="bold", caption_justify="left")
    for i in fitting:
        head = Text("\n".join(heads[i]), justify="right")
        drawn.add_column(head, justify="right", no_wrap=True, min_width=wide[i])
    drawn.add_column(Text("status"), overflow="fold", min_width=min(last, width))
    taken = sum(wide[i] + 2 for i in fitting) + last
    is_roomy = width - taken - 2 >= ROOM_FOR_REASONS
    if is_roomy and any(line.why for line in shown):
        drawn.add_column(Text(""), overflow="fold")
    above = ""
    for line in shown:
        cells = [*(str(line.cells[i]) for i in fitting), line.status_text]
        if len(drawn.columns) > len(cells):
            cells.append("as above" if line.why and line.why == above else line.why)
            above = line.why
        drawn.add_row(*map(Text, cells), style="" if line.ok else "yellow")
    notes = [] if is_roomy else _notes(shown, len(result.of_kind("level")))
    if left_out := [name for i, (name, _) in enumerate(heads) if i not in fitting]:
        notes.append(f"not shown, too narrow: {', '.join(left_out)}")
    drawn.caption = Text("\n".join(notes), style="yellow") if notes else None
    return drawn


def _fitting(columns: Sequence[Column], wide: Sequence[int], room: int) -> list[int]:
    """Which columns fit next to the status: all levels, then total, time and measures."""
    order = ("level", "score", "time", "measure")
    fitting: list[int] = []
    for i in sorted(range(len(columns)), key=lambda i: order.index(columns[i].kind)):
        if columns[i].kind == "level" or wide[i] + 2 <= room:
            fitting.append(i)
            room -= wide[i] + 2
    return sorted(fitting)


def unit_of(result: Result, column: Column) -> str:
    """Return the unit of a column; a total that only adds measures of one unit has that unit."""
    if column.unit or column.kind != "score" or not column.expression:
        return column.unit or ""
    units = {measure.name: measure.unit for measure in result.of_kind("measure")}
    added = {units.get(name.strip()) for name in column.expression.split("+")}
    return added.pop() or "" if len(added) == 1 else ""


def interval_text(interval: Interval, decimals: int) -> CellText:
    """Return ``1.83 [1.71, 1.99]``, ``1.83`` without limits, ``-`` without values."""
    if interval.mean is None:
        return CellText(GAP)
    text = number_text(interval.mean, decimals)
    if interval.low is None or interval.high is None:
        return CellText(text)
    low, high = number_text(interval.low, decimals), number_text(interval.high, decimals)
    return CellText(text, "" if low == high == text else f"{low}, {high}")


def rate_text(found: Rate) -> str:
    """Return ``44 to 97 %``, the limits of a rate."""
    return f"{100 * found.low:.0f} to {100 * found.high:.0f} %"


def number_text(value: float, decimals: int) -> str:
    """Return ``1.83``; ``1e+38`` and ``2.5e-09`` where decimals would drown or hide the number."""
    is_small = decimals >= MAX_DECIMALS and 0 < abs(value) < 0.5 * 10**-decimals
    return f"{value:.3g}" if abs(value) >= BIG or is_small else f"{value:.{decimals}f}"


def exact_decimals(values: Sequence[float]) -> int:
    """Return how many decimals show a sweep's levels apart: 2 for steps of 0.05, at most 6."""
    texts = [f"{value:.6f}".rstrip("0") for value in values]
    return max((len(text.partition(".")[2]) for text in texts), default=0)


def sensible_decimals(values: Sequence[float]) -> int:
    """Return decimals for three digits of the middle value, 0 to 4."""
    sizes = sorted(abs(value) for value in values if value != 0)
    if not sizes:
        return 2
    return min(MAX_DECIMALS, max(0, 2 - math.floor(math.log10(sizes[len(sizes) // 2]))))


def _head(result: Result, column: Column) -> tuple[str, str]:
    unit = unit_of(result, column)
    return column.name, f"[{unit}]" if unit else ""


def _notes(shown: Sequence[LevelLine], n_levels: int) -> list[str]:
    """One note for each run of lines with the same reason: ``1.20 to 1.30: tracker lost ...``."""
    notes = []
    for why, run in itertools.groupby(shown, key=lambda line: line.why):
        at = [" ".join(map(str, line.cells[:n_levels])) for line in run]
        if why:
            notes.append(f"{at[0]} to {at[-1]}: {why}" if len(at) > 1 else f"{at[0]}: {why}")
    return notes


def _statuses(result: Result, rows: Sequence[int]) -> list[str]:
    status = result.of_kind("status")
    index = result.index(status[0].name) if status else 0
    return [str(result.rows[row][index]) for row in rows] if status else []


def _status(result: Result, rows: Sequence[int]) -> str:
    found = _statuses(result, rows)
    if len(found) < 2:
        return "".join(found)
    return f"{found.count('ok')} of {len(found)} ok"


def _rate(result: Result, rows: Sequence[int]) -> str:
    found = _statuses(result, rows)
    limits = rate(found.count("ok"), len(found)) if len(found) > 1 else None
    return "" if limits is None else rate_text(limits)


def _why(result: Result, rows: Sequence[int]) -> str:
    if len(rows) == 1:
        return "; ".join((*result.reasons(rows[0]), *result.remarks_of(rows[0])))
    counts = Counter(status for status in _statuses(result, rows) if status != "ok")
    found = [", ".join(f"{n} {status}" for status, n in sorted(counts.items()))]
    remarks = Counter(text for row in rows for text in result.remarks_of(row))
    found += [f"{n} of {len(rows)}: {text}" for text, n in sorted(remarks.items())]
    return "; ".join(filter(None, found))
