"""The criterion of a broken run: an expression over its measures and its status.

.. code-block:: text

    corners > 5         corners > 5 || centroid > 3         status == lost         total > 2*corners

The language is that of scores; anything but 0 is broken. A run whose status is not ``ok`` counts as
broken too, for what was lost has no error: unless the expression asks for the status itself, as a
number with the names ``ok`` (0), ``lost``, ``timeout``, ``collision`` and ``error``. A run in which
a measure of the expression has no value is broken, with that reason.
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
"""Status of a row -> its number."""
NAMES = {"ok": 0.0, "lost": 1.0, "timeout": 2.0, "collision": 3.0, "error": 4.0}
"""What they are called in an expression."""
STATUS, TOTAL = "status", "total"


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """The evaluation of a run by a criterion."""

    is_broken: bool
    """Whether it counts as broken."""
    why: str
    """Why: the criterion, a status, ``no value``; empty for a run that holds."""


@dataclass(frozen=True)
class Criterion:
    """A parsed criterion."""

    expression: expressions.Expression
    """In the language of scores."""
    measures: tuple[str, ...]
    """The measures in it, in the order of appearance."""
    asks_status: bool
    """Whether it decides by itself what a status means."""

    @property
    def text(self) -> str:
        """As it was written."""
        return self.expression.text

    def judge(self, row: StoredRow) -> Judgement:
        """Evaluate a run from its stored row."""
        status = row.status
        if status != "ok" and not self.asks_status:
            return Judgement(is_broken=True, why=status)
        values: dict[str, float | None] = dict(NAMES)
        values |= {STATUS: STATUSES[status], TOTAL: row.total}
        values |= {name: value for name, (value, _) in row.measures.items()}
        found = self.expression.score(values)
        if found.value is None:
            return Judgement(is_broken=True, why="no value")
        is_broken = found.value != 0.0
        return Judgement(is_broken=is_broken, why=self.text if is_broken else "")


def parse_criterion(text: str, measures: Collection[str]) -> Criterion:
    """Parse a criterion over measures of these names; a measure called ``lost`` is that measure.

    Raises:
        ScoreError: it cannot be parsed, or uses no measure or status.
    """
    expression = expressions.parse(text, [*measures, TOTAL, STATUS, *NAMES])
    own = tuple(name for name in expression.names if name in measures)
    asks_status = STATUS in expression.names and STATUS not in measures
    if not own and not asks_status and TOTAL not in expression.names:
        known = ", ".join([*measures, TOTAL, STATUS])
        raise expressions.ScoreError(
            text.strip(), 0, f"the criterion uses nothing that is measured: {known}"
        )
    return Criterion(expression, own, asks_status)


def reasons(judgements: Iterable[Judgement]) -> Mapping[str, int]:
    """Count why runs are broken, the most frequent reason first."""
    counted = Counter(judged.why for judged in judgements if judged.is_broken)
    return dict(sorted(counted.items(), key=lambda item: (-item[1], item[0])))
