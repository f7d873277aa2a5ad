"""A comparison on the terminal: a table for each pair of results, and what follows in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from ...results.result import Column
from ...results.table import exact_decimals, interval_text, number_text, sensible_decimals
from ...statistics import Interval
from .matrix import Standing, matrix, note, title
from .model import AtLevel, Comparison, Versus
from .sentences import needed_text, p_text, sentences, short_verdict

STYLES: dict[Standing, str] = {"better": "green", "worse": "red", "too few": "yellow"}
LEGEND = (
    "n: pairs with a value from both; difference: with its 95 % interval; g: Hedges' g; A: chance "
    "that a repeat of the second is better; p: sign-flip test after Holm; ok: repeats that ended "
    "ok, first : second; needs: repeats that would show the observed difference in 4 of 5 "
    "experiments. See docs/statistics.md."
)
GIVES_WAY = ("a", "g", "ok", "n")
"""Columns that give way on a narrow terminal, in this order, named by the field of
`ComparisonLine` that they hold. Headings do not decide: an algorithm may have any name."""


@dataclass(frozen=True, kw_only=True)
class Shown:
    """One column of a table."""

    kind: str
    """What it holds: a field of `ComparisonLine`."""
    heading: str
    """Its heading; two columns may have the same."""
    cells: tuple[str, ...]
    """A text a line."""

    @property
    def width(self) -> int:
        """Letters of the longest text in it."""
        return max(len(self.heading), *map(len, self.cells))


@dataclass(frozen=True, kw_only=True)
class ComparisonLine:
    """One level of one pair of results, as text."""

    level: tuple[str, ...]
    """The swept parameters."""
    n: str
    """Pairs with a value from both."""
    first: str
    """Mean of the first."""
    second: str
    """Mean of the second."""
    difference: str
    """Second less first with its interval."""
    g: str
    """Hedges' g."""
    a: str
    """Vargha and Delaney's A."""
    p: str
    """After Holm's correction."""
    ok: str
    """Repeats that ended ok, first and second: ``10 : 8 of 10``."""
    verdict: str
    """Which is better, in a few words."""
    needed: str
    """Repeats that would show what was not shown."""
    is_shown: bool
    """Whether one is better."""


def lines(comparison: Comparison, versus: Versus) -> tuple[ComparisonLine, ...]:
    """Return the table of one pair of results, a line a level."""
    columns = versus.first.result.columns_of_kind("level")
    decimals = [exact_decimals([at.level[i] for at in versus.levels]) for i in range(len(columns))]
    means = [v for at in versus.levels for v in (at.value.first.mean, at.value.second.mean) if v]
    places = sensible_decimals(means)
    steps = [at.value.difference.mean for at in versus.levels if at.value.difference.mean]
    fine = max(places, min(places + 1, sensible_decimals(steps)))
    return tuple(_line(comparison, versus, at, decimals, places, fine) for at in versus.levels)


def heading(comparison: Comparison, versus: Versus) -> str:
    """Return ``total [px]: ic less esm; lower is better``."""
    better = "higher" if comparison.higher_is_better else "lower"
    return (
        f"{comparison.column.label}: {versus.second.name} less {versus.first.name}; "
        f"{better} is better"
    )


def drawn(comparison: Comparison, *, width: int) -> Iterator[RenderableType]:
    """Give everything that is printed, for a terminal of ``width`` columns."""
    yield from _matrix(comparison, width)
    for versus in comparison.versus:
        yield Text(heading(comparison, versus), style="bold")
        yield _table(comparison, versus, width)
        for sentence in sentences(comparison, versus):
            yield Padding(Text(sentence), (0, 0, 0, 2), expand=False)
        yield Text("")
    yield Text(LEGEND)


def _matrix(comparison: Comparison, width: int) -> Iterator[RenderableType]:
    """The matrix: in words where the terminal is wide enough, else in symbols."""
    found = matrix(comparison)
    yield Text(title(comparison), style="bold")
    named = max(len(row.name) for row in found.rows) + len("  100 %")
    cells = [
        (name, [row.cells[j].text for row in found.rows]) for j, name in enumerate(found.columns)
    ]
    is_wide = named + sum(2 + max(len(name), *map(len, c)) for name, c in cells) <= width
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("", no_wrap=is_wide, overflow="fold")
    table.add_column("ok", justify="right", no_wrap=True)
    for number, name in enumerate(found.columns, 1):  # rows stand in the order of the columns
        heading = Text(name if is_wide else str(number), justify="right")
        table.add_column(heading, justify="right", no_wrap=True)
    for number, row in enumerate(found.rows, 1):
        name = row.name if is_wide else f"{number} {row.name}"
        texts = (
            Text(cell.text if is_wide else cell.symbol, style=STYLES.get(cell.standing, ""))
            for cell in row.cells
        )
        table.add_row(Text(name, style="bold"), Text(row.ok), *texts)
    yield table
    yield Text(note(comparison) if is_wide else f"{found.legend()}. {note(comparison)}")
    yield Text("")


def _table(comparison: Comparison, versus: Versus, width: int) -> Table:
    found = lines(comparison, versus)
    columns = _columns(versus.first.result.columns_of_kind("level"), versus, found)
    for kind in GIVES_WAY:
        if sum(column.width + 2 for column in columns) > width:
            columns = [column for column in columns if column.kind != kind]
    table = Table(box=None, pad_edge=False, header_style="bold")
    for column in columns:
        is_verdict = column.kind == "verdict"
        table.add_column(
            Text(column.heading, justify="left" if is_verdict else "right"),
            justify="left" if is_verdict else "right",
            no_wrap=not is_verdict,
            overflow="fold",
        )
    for i, line in enumerate(found):
        row = [Text(column.cells[i]) for column in columns]
        table.add_row(*row, style="bold" if line.is_shown else "")
    return table


def _columns(
    levels: Sequence[Column], versus: Versus, found: Sequence[ComparisonLine]
) -> list[Shown]:
    """The columns of a table, from left to right."""
    headings = {
        "n": "n",
        "first": versus.first.name,
        "second": versus.second.name,
        "difference": "difference",
        "g": "g",
        "a": "A",
        "p": "p",
        "ok": "ok",
        "verdict": "verdict",
        "needed": "needs",
    }
    return [
        *(
            Shown(kind="level", heading=column.label, cells=tuple(line.level[i] for line in found))
            for i, column in enumerate(levels)
        ),
        *(
            Shown(kind=kind, heading=heading, cells=tuple(getattr(line, kind) for line in found))
            for kind, heading in headings.items()
        ),
    ]


def _line(
    comparison: Comparison,
    versus: Versus,
    at: AtLevel,
    decimals: Sequence[int],
    places: int,
    fine: int,
) -> ComparisonLine:
    d, success = at.value, at.success
    return ComparisonLine(
        level=tuple(number_text(v, k) for v, k in zip(at.level, decimals, strict=True)),
        n=str(d.difference.n),
        first=_mean(d.first, places),
        second=_mean(d.second, places),
        difference=str(interval_text(d.difference, fine)),
        g="-" if d.hedges_g is None else f"{d.hedges_g:.2f}",
        a="-" if d.superiority is None else f"{d.superiority:.2f}",
        p=p_text(d.p_holm),
        ok="-"
        if success is None
        else f"{success.first.successes} : {success.second.successes} of {success.first.n}",
        verdict=short_verdict(versus, d),
        needed=needed_text(comparison, d),
        is_shown=d.verdict in ("first", "second"),
    )


def _mean(interval: Interval, decimals: int) -> str:
    return "-" if interval.mean is None else number_text(interval.mean, decimals)
