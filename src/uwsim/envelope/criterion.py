"""The criterion by which a run counts as broken: an expression of its measures and its status.

.. code-block:: text

    corners > 5         corners > 5 || centroid > 3         status == lost         total > 2*corners

The expression has the syntax of scores; a run is broken if its value is not 0. A run whose status
is not ``ok`` is also broken, as a lost track has no error to compare. An expression that contains
``status`` decides this itself: the status is a number, compared with the names ``ok`` (0),
``lost``, ``timeout``, ``collision`` and ``error``; one that an outcome names is `OTHER_STATUS`. A
run without a value for a measure of the expression is broken with the reason ``no value``.
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
"""The number that stands in an expression for each status of a row."""
OTHER_STATUS = 10.0
"""The number that stands for any other status, which a ``<u:outcome>`` names."""
NAMES = {"ok": 0.0, "lost": 1.0, "timeout": 2.0, "collision": 3.0, "error": 4.0}
"""The names of statuses that an expression may contain, with their numbers."""
STATUS, TOTAL = "status", "total"


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """The result of a criterion for a run."""

    is_broken: bool
    """True if the run is broken."""
    reason: str
    """The reason of a broken run: the criterion, a status or ``no value``; empty if it holds."""


@dataclass(frozen=True)
class Criterion:
    """A parsed criterion."""

    expression: expressions.Expression
    """The parsed expression."""
    measures: tuple[str, ...]
    """The names of the measures in the expression, in the order of appearance."""
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
        values |= {STATUS: STATUSES.get(status, OTHER_STATUS), TOTAL: row.total}
        values |= {name: value for name, (value, _) in row.measures.items()}
        score = self.expression.score(values)
        if score.value is None:
            return Judgement(is_broken=True, reason="no value")
        is_broken = score.value != 0.0
        return Judgement(is_broken=is_broken, reason=self.text if is_broken else "")


def parse_criterion(text: str, measures: Collection[str]) -> Criterion:
    """Parse a criterion over measures of these names.

    A name of a measure takes precedence over a name of a status: ``lost`` is the measure if there
    is one of that name.

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
