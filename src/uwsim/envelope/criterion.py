"""The criterion of a broken run: an expression over its measures and its status.

.. code-block:: text

    corners > 5         corners > 5 || centroid > 3         status == lost         total > 2*corners

The language is that of scores; any value but 0 is broken. A run whose status is not ``ok`` counts
as broken, too, as a lost track has no error. The exception is an expression with the status
itself, a number with the names ``ok`` (0), ``lost``, ``timeout``, ``collision`` and ``error``. A
run without a value for a measure of the expression is broken, with that reason.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from ..base import expression as expressions
from ..results.stored.stored_row import StoredRow

STATUSES = {
    "ok": 0.0,
    "lost": 1.0,
    "timeout": 2.0,
    "collision": 3.0,
    "algorithm error": 4.0,
    "not found": 5.0,
    "lost target": 6.0,
    "missed": 7.0,
    "dropped": 8.0,
    "simulation error": 9.0,
}
"""The number of each status of a row."""
NAMES = {"ok": 0.0, "lost": 1.0, "timeout": 2.0, "collision": 3.0, "error": 4.0}
"""The numbers of statuses by their names in an expression."""
STATUS, TOTAL = "status", "total"


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """The evaluation of a run by a criterion."""

    is_broken: bool
    """The judgement itself: true for a broken run."""
    reason: str
    """The reason: the criterion, a status, ``no value``; empty for a run that holds."""


@dataclass(frozen=True)
class Criterion:
    """A parsed criterion."""

    expression: expressions.Expression
    """The expression in the language of scores."""
    measures: tuple[str, ...]
    """The measures in it, in the order of appearance."""
    uses_status: bool
    """True if the expression uses the status."""

    @property
    def text(self) -> str:
        """The text of the criterion as written."""
        return self.expression.text

    def judge(self, row: StoredRow) -> Judgement:
        """Evaluate a run from its stored row."""
        status = row.status
        if status != "ok" and not self.uses_status:
            return Judgement(is_broken=True, reason=status)
        values: dict[str, float | None] = dict(NAMES)
        values |= {STATUS: STATUSES[status], TOTAL: row.total}
        values |= {name: value for name, (value, _) in row.measures.items()}
        score = self.expression.score(values)
        if score.value is None:
            return Judgement(is_broken=True, reason="no value")
        is_broken = score.value != 0.0
        return Judgement(is_broken=is_broken, reason=self.text if is_broken else "")


def parse_criterion(text: str, measures: Collection[str]) -> Criterion:
    """Parse a criterion over measures of these names; a measure called ``lost`` is that measure.

    Raises:
        ScoreError: the text cannot be parsed, or uses no measure or status.
    """
    expression = expressions.parse(text, [*measures, TOTAL, STATUS, *NAMES])
    used_measures = tuple(name for name in expression.names if name in measures)
    uses_status = STATUS in expression.names and STATUS not in measures
    if not used_measures and not uses_status and TOTAL not in expression.names:
        names = ", ".join([*measures, TOTAL, STATUS])
        raise expressions.ScoreError(
            text.strip(), 0, f"the criterion uses no measure; expected one of {names}"
        )
    return Criterion(expression, used_measures, uses_status)


def reasons(judgements: Iterable[Judgement]) -> Mapping[str, int]:
    """Count the reasons of broken runs, the most frequent one first."""
    counts = Counter(judgement.reason for judgement in judgements if judgement.is_broken)
    return dict(sorted(counts.items(), key=lambda item: (-item[1], item[0])))
