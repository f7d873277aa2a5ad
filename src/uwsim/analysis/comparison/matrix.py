"""The matrix of pairwise verdicts: every result against every other, over the whole sweep.

.. code-block:: text

               ok          esm            ecc        frozen
    esm     100 %               not shown -0.12  better -44.6
    ecc      93 %  not shown +0.12               better -44.5
    frozen  100 %  worse +44.6    worse +44.5

A cell states whether the result of its row is better than the result of its column, after Holm's
correction over all pairs of results, and the mean difference, row minus column. Rows are sorted by
wins minus losses. With a baseline, the baseline is the only column.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ...results.per_level import success_rates
from .inputs import Entry
from .model import Comparison, PairComparison, PairedDifference, Verdict

CellVerdict = Literal[
    "better", "worse", "equal", "not shown", "too few", "one repeat", "no pair", "itself"
]

SYMBOLS: dict[CellVerdict, str] = {
    "better": "+",
    "worse": "-",
    "equal": "=",
    "not shown": "?",
    "too few": "few",
    "one repeat": "one",
    "no pair": "none",
    "itself": "",
}
"""The symbols for narrow terminals."""
MEANINGS: dict[CellVerdict, str] = {
    "better": "the row is better",
    "worse": "the column is better",
    "equal": "equal in every repeat",
    "not shown": "no difference is shown",
    "too few": "too few repeats to test",
    "one repeat": "one repeat, which allows no inference",
    "no pair": "no level has a value from both in every repeat",
}


@dataclass(frozen=True, kw_only=True)
class Cell:
    """The comparison of one result with another."""

    verdict: CellVerdict
    """The verdict on the result of the row against the result of the column."""
    text: str
    """The verdict with the mean difference, row minus column: ``better -44.6``."""

    @property
    def symbol(self) -> str:
        """The symbol of the verdict for narrow terminals: ``+``, ``-``, ``?``."""
        return SYMBOLS[self.verdict]


@dataclass(frozen=True, kw_only=True)
class MatrixRow:
    """The comparison of one result with all others."""

    name: str
    """The name of the result."""
    ok: str
    """The rate of rows of the result that ended ``ok``, ``93 %``; a dash if it is not recorded."""
    cells: tuple[Cell, ...]
    """The cells, in the order of the matrix's columns."""


@dataclass(frozen=True, kw_only=True)
class Matrix:
    """The matrix of pairwise verdicts."""

    columns: tuple[str, ...]
    """The names of the results that the rows are compared with."""
    rows: tuple[MatrixRow, ...]
    """The rows, one for each result, sorted by wins minus losses."""

    def legend(self) -> str:
        """Explain the symbols that occur: ``+ the row is better; ? no difference ...``."""
        verdicts = {cell.verdict for row in self.rows for cell in row.cells}
        return "; ".join(f"{SYMBOLS[v]} {text}" for v, text in MEANINGS.items() if v in verdicts)


def matrix(comparison: Comparison) -> Matrix:
    """Return the matrix of pairwise verdicts over the whole sweep."""
    pairs: dict[tuple[int, int], tuple[PairComparison, bool]] = {}
    indices = {id(entry): i for i, entry in enumerate(comparison.entries)}
    for pair in comparison.pairs:
        i, j = indices[id(pair.first)], indices[id(pair.second)]
        pairs[i, j], pairs[j, i] = (pair, True), (pair, False)
    row_indices = _sorted_indices(len(comparison.entries), pairs)
    column_indices = row_indices
    if comparison.baseline is not None:
        column_indices = [indices[id(comparison.baseline)]]
        row_indices = [*column_indices, *(i for i in row_indices if i not in column_indices)]
    return Matrix(
        columns=tuple(comparison.entries[j].name for j in column_indices),
        rows=tuple(
            MatrixRow(
                name=comparison.entries[i].name,
                ok=_ok_share(comparison.entries[i]),
                cells=tuple(_cell(pairs, i, j) for j in column_indices),
            )
            for i in row_indices
        ),
    )


def matrix_title(comparison: Comparison) -> str:
    """Return ``Each result against each: total [px] over the whole sweep, lower is better``."""
    direction = "higher" if comparison.higher_is_better else "lower"
    label = comparison.column.label
    return f"Each result against each: {label} over the whole sweep, {direction} is better"


def matrix_note(comparison: Comparison) -> str:
    """Return the note under the matrix, which states if there are too few repeats."""
    n = len(comparison.pairs)
    correction = f", Holm over {n} pairs of results" if n > 1 else ""
    text = (
        "A cell has the verdict on its row against its column, and the mean difference, row minus "
        "column. It is over the levels at which every repeat of both has a value (sign-flip test "
        f"at 5 %{correction}). The column ok has the share of the rows that ended ok."
    )
    pairs = [pair for pair in comparison.pairs if pair.sweep.value.verdict == "too few"]
    return f"{few_repeats_text(pairs[0].sweep.value)}. {text}" if pairs else text


def few_repeats_text(d: PairedDifference) -> str:
    """Return ``Too few repeats to test (6 of 7 needed)``."""
    return f"Too few repeats to test ({d.difference.n} of {d.repeats_to_test} needed)"


def _sorted_indices(
    n: int, pairs: Mapping[tuple[int, int], tuple[PairComparison, bool]]
) -> list[int]:
    """Return the indices of the results, sorted by wins minus losses (a stable sort)."""
    scores = [0] * n
    for i, j in pairs:
        verdict = _cell(pairs, i, j).verdict
        scores[i] += (verdict == "better") - (verdict == "worse")
    return sorted(range(n), key=lambda i: -scores[i])


def _cell(pairs: Mapping[tuple[int, int], tuple[PairComparison, bool]], i: int, j: int) -> Cell:
    if (i, j) not in pairs:
        return Cell(verdict="itself", text="")
    pair, is_first = pairs[i, j]
    d = pair.sweep.value
    verdict, mean = _cell_verdict(d.verdict, is_first), d.difference.mean
    if mean is None or verdict == "equal":
        return Cell(verdict=verdict, text=verdict)
    return Cell(verdict=verdict, text=f"{verdict} {-mean if is_first else mean:+.3g}")


def _cell_verdict(verdict: Verdict, is_first: bool) -> CellVerdict:
    if verdict == "first" or verdict == "second":
        return "better" if is_first == (verdict == "first") else "worse"
    return verdict


def _ok_share(entry: Entry) -> str:
    rates = [r.success for r in success_rates(entry.result) if r.success is not None]
    n = sum(rate.n for rate in rates)
    return f"{100 * sum(rate.successes for rate in rates) / n:.3g} %" if n else "-"
