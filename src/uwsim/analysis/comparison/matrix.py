"""Matrix of pairwise verdicts: every result against every other, over the whole sweep.

.. code-block:: text

               ok          esm            ecc        frozen
    esm     100 %               not shown -0.12  better -44.6
    ecc      93 %  not shown +0.12               better -44.5
    frozen  100 %  worse +44.6    worse +44.5

A row against a column: which of the two is better after Holm's correction over all pairs of
results, and the mean difference, row less column. Those that beat most stand first. With a baseline
there is one column.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ...results.per_level import success_rates
from .inputs import Entry
from .model import Comparison, Outcome, PairedDifference, Versus

Standing = Literal[
    "better", "worse", "equal", "not shown", "too few", "one repeat", "no pair", "itself"
]

SYMBOLS: dict[Standing, str] = {
    "better": "+",
    "worse": "-",
    "equal": "=",
    "not shown": "?",
    "too few": "few",
    "one repeat": "one",
    "no pair": "none",
    "itself": "",
}
"""Symbols for narrow terminals."""
MEANINGS: dict[Standing, str] = {
    "better": "the row is better",
    "worse": "the column is better",
    "equal": "equal in every repeat",
    "not shown": "no difference is shown",
    "too few": "too few repeats to test",
    "one repeat": "one repeat, which shows nothing for others",
    "no pair": "at no level does every repeat of both have a value",
}


@dataclass(frozen=True, kw_only=True)
class Cell:
    """One result against another."""

    standing: Standing
    """Of the row against the column."""
    text: str
    """``better -44.6``, ``not shown +0.12``: with the mean difference, row less column."""

    @property
    def symbol(self) -> str:
        """``+``, ``-``, ``?``: for narrow terminals."""
        return SYMBOLS[self.standing]


@dataclass(frozen=True, kw_only=True)
class MatrixRow:
    """One result against all others."""

    name: str
    """Of the result."""
    ok: str
    """Share of its rows that ended ``ok``, ``93 %``; a dash where it is not recorded."""
    cells: tuple[Cell, ...]
    """In the order of the matrix's columns."""


@dataclass(frozen=True, kw_only=True)
class Matrix:
    """The matrix of pairwise verdicts."""

    columns: tuple[str, ...]
    """Names of the results that the rows are compared with."""
    rows: tuple[MatrixRow, ...]
    """One result each, those that beat most first."""

    def legend(self) -> str:
        """Explain the symbols that occur: ``+ the row is better; ? no difference ...``."""
        found = {cell.standing for row in self.rows for cell in row.cells}
        return "; ".join(f"{SYMBOLS[s]} {message}" for s, message in MEANINGS.items() if s in found)


def matrix(comparison: Comparison) -> Matrix:
    """Return the matrix of pairwise verdicts over the whole sweep."""
    found: dict[tuple[int, int], tuple[Versus, bool]] = {}
    places = {id(entry): i for i, entry in enumerate(comparison.entries)}
    for versus in comparison.versus:
        i, j = places[id(versus.first)], places[id(versus.second)]
        found[i, j], found[j, i] = (versus, True), (versus, False)
    order = _order(len(comparison.entries), found)
    columns = order
    if comparison.baseline is not None:
        columns = [places[id(comparison.baseline)]]
        order = [*columns, *(i for i in order if i not in columns)]
    return Matrix(
        columns=tuple(comparison.entries[j].name for j in columns),
        rows=tuple(
            MatrixRow(
                name=comparison.entries[i].name,
                ok=_ok(comparison.entries[i]),
                cells=tuple(_cell(found, i, j) for j in columns),
            )
            for i in order
        ),
    )


def title(comparison: Comparison) -> str:
    """Return ``Who beats whom: total [px] over the sweep as a whole, lower is better``."""
    better = "higher" if comparison.higher_is_better else "lower"
    return (
        f"Who beats whom: {comparison.column.label} over the sweep as a whole, {better} is better"
    )


def note(comparison: Comparison) -> str:
    """Return the note of the matrix, with whether the repeats were enough."""
    n = len(comparison.versus)
    over = f", Holm over {n} pairs of results" if n > 1 else ""
    text = (
        "Row against column, with the difference row less column, over the levels at which every "
        f"repeat of both has a value (sign-flip test at 5 %{over}); ok: share of the rows that "
        "ended ok."
    )
    few = [v.overall.value for v in comparison.versus if v.overall.value.verdict == "too few"]
    return f"{too_few(few[0])}. {text}" if few else text


def too_few(d: PairedDifference) -> str:
    """Return ``Too few repeats to test (6 of 7 needed)``."""
    return f"Too few repeats to test ({d.difference.n} of {d.fewest} needed)"


def _order(n: int, found: Mapping[tuple[int, int], tuple[Versus, bool]]) -> list[int]:
    """Order by wins minus losses; else as given."""
    score = [0] * n
    for i, j in found:
        standing = _cell(found, i, j).standing
        score[i] += (standing == "better") - (standing == "worse")
    return sorted(range(n), key=lambda i: -score[i])


def _cell(found: Mapping[tuple[int, int], tuple[Versus, bool]], i: int, j: int) -> Cell:
    if (i, j) not in found:
        return Cell(standing="itself", text="")
    versus, is_first = found[i, j]
    d = versus.overall.value
    standing, mean = _standing(d.verdict, is_first), d.difference.mean
    if mean is None or standing == "equal":
        return Cell(standing=standing, text=standing)
    return Cell(standing=standing, text=f"{standing} {-mean if is_first else mean:+.3g}")


def _standing(verdict: Outcome, is_first: bool) -> Standing:
    if verdict == "first" or verdict == "second":
        return "better" if is_first == (verdict == "first") else "worse"
    return verdict


def _ok(entry: Entry) -> str:
    found = [at.success for at in success_rates(entry.result) if at.success is not None]
    n = sum(rate.n for rate in found)
    return f"{100 * sum(rate.successes for rate in found) / n:.3g} %" if n else "-"
