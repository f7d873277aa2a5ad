"""A comparison on the terminal: a table for each pair of results, and the conclusions."""

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
from .matrix import CellVerdict, matrix, matrix_note, matrix_title
from .model import Comparison, LevelStatistics, PairComparison
from .sentences import needed_text, p_text, sentences, short_verdict
from .time_table import time_heading, time_lines, time_sentence

STYLES: dict[CellVerdict, str] = {"better": "green", "worse": "red", "too few": "yellow"}
LEGEND = (
    "Each line gives n, the number of repeats with a value in both results. "
    "It gives the difference with its 95 % interval, and its effect size g (Hedges). "
    "A is the probability that a repeat of the second result is better. "
    "p is the p-value of the sign-flip test after Holm's correction. "
    "The column ok gives the numbers of repeats that ended ok, first : second. "
    "The column needs gives the number of repeats with which the observed difference would be "
    "detected in 4 of 5 experiments. See docs/statistics.md."
)
TIME_LEGEND = (
    "Times to success: the number of successes, and the median time with its 95 % interval "
    "(Kaplan and Meier). A trial that fails counts as without success for ever. A dash is beyond "
    "the time limit. The difference is that of the mean times, at most the time limit. log-rank "
    "is the p-value of the paired log-rank test, not corrected."
)
OMITTED_COLUMNS = ("a", "g", "ok", "n")
"""The columns that a narrow terminal omits, in this order, by their field of `ComparisonLine`. They
are not named by their headings, because a heading may be the name of an algorithm."""


@dataclass(frozen=True, kw_only=True)
class TableColumn:
    """One column of a table, as text."""

    kind: str
    """The field of `ComparisonLine` that the column shows."""
    heading: str
    """The heading; two columns may have the same heading."""
    cells: tuple[str, ...]
    """The text in each line."""

    @property
    def width(self) -> int:
        """The width of the longest text [characters]."""
        return max(len(self.heading), *map(len, self.cells))


@dataclass(frozen=True, kw_only=True)
class ComparisonLine:
    """One level of one pair of results, as text."""

    level: tuple[str, ...]
    """The values of the swept parameters, outermost first."""
    n: str
    """The number of repeats with a value in both results (paired repeats)."""
    first_mean: str
    """The mean of the first result."""
    second_mean: str
    """The mean of the second result."""
    difference: str
    """The mean difference, second minus first, with its confidence interval."""
    g: str
    """Hedges' g."""
    a: str
    """Vargha and Delaney's A."""
    p: str
    """The p-value after Holm's correction."""
    ok: str
    """The number of repeats that ended ok, in the first and the second: ``10 : 8 of 10``."""
    verdict: str
    """The verdict in a few words (`short_verdict`)."""
    repeats_needed: str
    """The number of repeats with which the observed difference would be detected."""
    is_conclusive: bool
    """True if the comparison shows that one result is better; the line is then bold."""


def lines(comparison: Comparison, pair: PairComparison) -> tuple[ComparisonLine, ...]:
    """Return the table of one pair of results, with a line for each level."""
    columns = pair.first.result.columns_of_kind("level")
    level_decimals = [
        exact_decimals([stats.level[i] for stats in pair.levels]) for i in range(len(columns))
    ]
    values = [stats.value for stats in pair.levels]
    mean_decimals = sensible_decimals(
        [v for d in values for v in (d.first.mean, d.second.mean) if v]
    )
    decimals = sensible_decimals([d.difference.mean for d in values if d.difference.mean])
    difference_decimals = max(mean_decimals, min(mean_decimals + 1, decimals))
    return tuple(
        _line(comparison, pair, stats, level_decimals, mean_decimals, difference_decimals)
        for stats in pair.levels
    )


def heading(comparison: Comparison, pair: PairComparison) -> str:
    """Return ``total [px]: ic minus esm; lower is better``."""
    direction = "higher" if comparison.higher_is_better else "lower"
    return (
        f"{comparison.column.label}: {pair.second.name} minus {pair.first.name}; "
        f"{direction} is better"
    )


def renderables(comparison: Comparison, *, width: int) -> Iterator[RenderableType]:
    """Yield all parts of the output for a terminal of ``width`` columns."""
    yield from _matrix_parts(comparison, width)
    for pair in comparison.pairs:
        yield Text(heading(comparison, pair), style="bold")
        yield _table(comparison, pair, width)
        for sentence in sentences(comparison, pair):
            yield Padding(Text(sentence), (0, 0, 0, 2), expand=False)
        yield Text("")
        if pair.times is not None:
            yield Text(time_heading(pair), style="bold")
            yield _time_table(pair)
            yield Padding(Text(time_sentence(comparison, pair)), (0, 0, 0, 2), expand=False)
            yield Text("")
    yield Text(LEGEND)
    if any(pair.times is not None for pair in comparison.pairs):
        yield Text(TIME_LEGEND)


def _matrix_parts(comparison: Comparison, width: int) -> Iterator[RenderableType]:
    """Yield the matrix in words if the terminal is wide enough, or else in symbols."""
    verdicts = matrix(comparison)
    yield Text(matrix_title(comparison), style="bold")
    table_width = max(len(row.name) for row in verdicts.rows) + len("  100 %")
    for j, name in enumerate(verdicts.columns):
        table_width += 2 + max(len(name), *(len(row.cells[j].text) for row in verdicts.rows))
    is_wide = table_width <= width
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("", no_wrap=is_wide, overflow="fold")
    table.add_column("ok", justify="right", no_wrap=True)
    for number, name in enumerate(verdicts.columns, 1):  # as the rows
        heading = Text(name if is_wide else str(number), justify="right")
        table.add_column(heading, justify="right", no_wrap=True)
    for number, row in enumerate(verdicts.rows, 1):
        name = row.name if is_wide else f"{number} {row.name}"
        texts = (
            Text(cell.text if is_wide else cell.symbol, style=STYLES.get(cell.verdict, ""))
            for cell in row.cells
        )
        table.add_row(Text(name, style="bold"), Text(row.ok), *texts)
    yield table
    yield Text(("" if is_wide else f"{verdicts.legend()}. ") + matrix_note(comparison))
    yield Text("")


def _table(comparison: Comparison, pair: PairComparison, width: int) -> Table:
    rows = lines(comparison, pair)
    columns = _columns(pair.first.result.columns_of_kind("level"), pair, rows)
    for kind in OMITTED_COLUMNS:
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
    for i, row in enumerate(rows):
        cells = [Text(column.cells[i]) for column in columns]
        table.add_row(*cells, style="bold" if row.is_conclusive else "")
    return table


def _time_table(pair: PairComparison) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold")
    levels = [column.label for column in pair.first.result.columns_of_kind("level")]
    names = [pair.first.name, pair.second.name]
    for heading in (*levels, *names, "difference", "p", "log-rank"):
        table.add_column(Text(heading, justify="right"), justify="right", overflow="fold")
    table.add_column(Text("verdict"))
    for row in time_lines(pair):
        cells = (*row.level, row.first, row.second, row.difference, row.p, row.p_log_rank)
        table.add_row(*map(Text, (*cells, row.verdict)), style="bold" if row.is_conclusive else "")
    return table


def _columns(
    levels: Sequence[Column], pair: PairComparison, rows: Sequence[ComparisonLine]
) -> list[TableColumn]:
    headings = {
        "n": "n",
        "first_mean": pair.first.name,
        "second_mean": pair.second.name,
        "difference": "difference",
        "g": "g",
        "a": "A",
        "p": "p",
        "ok": "ok",
        "verdict": "verdict",
        "repeats_needed": "needs",
    }
    return [
        *(
            TableColumn(
                kind="level", heading=column.label, cells=tuple(row.level[i] for row in rows)
            )
            for i, column in enumerate(levels)
        ),
        *(
            TableColumn(kind=kind, heading=heading, cells=tuple(getattr(row, kind) for row in rows))
            for kind, heading in headings.items()
        ),
    ]


def _line(
    comparison: Comparison,
    pair: PairComparison,
    stats: LevelStatistics,
    level_decimals: Sequence[int],
    mean_decimals: int,
    difference_decimals: int,
) -> ComparisonLine:
    d, success = stats.value, stats.success
    return ComparisonLine(
        level=tuple(number_text(v, k) for v, k in zip(stats.level, level_decimals, strict=True)),
        n=str(d.difference.n),
        first_mean=_mean(d.first, mean_decimals),
        second_mean=_mean(d.second, mean_decimals),
        difference=str(interval_text(d.difference, difference_decimals)),
        g="-" if d.hedges_g is None else f"{d.hedges_g:.2f}",
        a="-" if d.superiority is None else f"{d.superiority:.2f}",
        p=p_text(d.p_holm),
        ok="-"
        if success is None
        else f"{success.first.successes} : {success.second.successes} of {success.first.n}",
        verdict=short_verdict(pair, d),
        repeats_needed=needed_text(comparison, d),
        is_conclusive=d.verdict in ("first", "second"),
    )


def _mean(interval: Interval, decimals: int) -> str:
    return "-" if interval.mean is None else number_text(interval.mean, decimals)
