"""A comparison on the terminal: a table for each pair of results, and what follows in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from ...statistics import Interval
from ..result import Column
from ..table import exact_decimals, interval_text, number_text, sensible_decimals
from .findings import AtLevel, Comparison, Versus
from .words import needed_text, p_text, sentences, short

LEGEND = (
    "n: pairs with a value from both; difference: with its 95 % interval; g: Hedges' g; A: chance "
    "that a repeat of the second is better; p: sign-flip test after Holm; ok: repeats that ended "
    "ok, first : second; needs: repeats that would show the observed difference in 4 of 5 "
    "experiments. docs/statistics.md says more."
)
DROPPED = ("A", "g", "ok", "n")
"""Columns that give way on a narrow terminal, in this order."""


@dataclass(frozen=True, kw_only=True)
class Line:
    """One level of one pair of results, as text."""

    level: tuple[str, ...]
    """The updaters' references."""
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


def lines(comparison: Comparison, versus: Versus) -> tuple[Line, ...]:
    """Return the table of one pair of results, a line a level."""
    columns = versus.first.result.of_kind("level")
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
    for versus in comparison.versus:
        yield Text(heading(comparison, versus), style="bold")
        yield _table(comparison, versus, width)
        for sentence in sentences(comparison, versus):
            yield Padding(Text(sentence), (0, 0, 0, 2), expand=False)
        yield Text("")
    yield Text(LEGEND)


def _table(comparison: Comparison, versus: Versus, width: int) -> Table:
    shown = lines(comparison, versus)
    columns = versus.first.result.of_kind("level")
    cells = _columns(columns, versus, shown)
    wide = {name: max(len(name), *map(len, texts)) for name, texts in cells.items()}
    names = list(cells)
    for name in DROPPED:
        if sum(wide[n] + 2 for n in names) > width and name in names:
            names.remove(name)
    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in names:
        is_verdict = name == "verdict"
        table.add_column(
            Text(name, justify="left" if is_verdict else "right"),
            justify="left" if is_verdict else "right",
            no_wrap=not is_verdict,
            overflow="fold",
        )
    for i, line in enumerate(shown):
        row = [Text(cells[name][i]) for name in names]
        table.add_row(*row, style="bold" if line.is_shown else "")
    return table


def _columns(
    levels: Sequence[Column], versus: Versus, shown: Sequence[Line]
) -> dict[str, list[str]]:
    """Heading -> its cells."""
    found = {column.label: [line.level[i] for line in shown] for i, column in enumerate(levels)}
    return {
        **found,
        "n": [line.n for line in shown],
        versus.first.name: [line.first for line in shown],
        versus.second.name: [line.second for line in shown],
        "difference": [line.difference for line in shown],
        "g": [line.g for line in shown],
        "A": [line.a for line in shown],
        "p": [line.p for line in shown],
        "ok": [line.ok for line in shown],
        "verdict": [line.verdict for line in shown],
        "needs": [line.needed for line in shown],
    }


def _line(
    comparison: Comparison,
    versus: Versus,
    at: AtLevel,
    decimals: Sequence[int],
    places: int,
    fine: int,
) -> Line:
    d, success = at.value, at.success
    return Line(
        level=tuple(number_text(v, k) for v, k in zip(at.level, decimals, strict=True)),
        n=str(d.difference.n),
        first=_mean(d.first, places),
        second=_mean(d.second, places),
        difference=interval_text(d.difference, fine),
        g="-" if d.hedges_g is None else f"{d.hedges_g:.2f}",
        a="-" if d.superiority is None else f"{d.superiority:.2f}",
        p=p_text(d.p_holm),
        ok="-"
        if success is None
        else f"{success.first.successes} : {success.second.successes} of {success.first.n}",
        verdict=short(versus, d),
        needed=needed_text(comparison, d),
        is_shown=d.verdict in ("first", "second"),
    )


def _mean(interval: Interval, decimals: int) -> str:
    return "-" if interval.mean is None else number_text(interval.mean, decimals)
