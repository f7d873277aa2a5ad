"""Checks of the values of a row that follow from other values of the row.

The total follows from the values of the measures, and the value of a measure is one of its details.
Both are checked without a run, so that a single changed number in a result is detected.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..base.expression import Expression, parse
from ..benchmark.measures import OutcomeSpec
from ..benchmark.spec import BenchmarkSpec
from ..results.leaves import leaves
from ..results.result import Cell, Result
from ..runs.trial.triggered_measure import finite_value
from .differences import Difference


def contradictions(result: Result, benchmark: BenchmarkSpec) -> Iterator[Difference]:
    """Compute the totals and values of all rows again; yield a difference for each that differs.

    Args:
        result: the stored result.
        benchmark: the benchmark that was run.
    """
    columns = [column.name for column in result.columns]
    details = {spec.name: f"{spec.name}.{spec.value}" for spec in benchmark.measures}
    expression = parse(benchmark.function.text, list(details))
    has_outcome = any(isinstance(spec, OutcomeSpec) for spec in benchmark.measures)
    for index, cells in enumerate(result.rows):
        row = dict(zip(columns, cells, strict=True))
        if set(expression.names) <= set(row) and "total" in row:
            # a level that an outcome judges has a score, unless a failure ended it
            is_scored = row.get("status") == "ok" or (has_outcome and row["total"] is not None)
            computed_total = _total(expression, row) if is_scored else None
            if leaves(row["total"]) != leaves(computed_total):
                yield Difference(
                    location="result.json",
                    description=f"row {index}, column total: {row['total']!r} there, "
                    f"{computed_total!r} by {expression.text!r} of the row's values",
                )
        for name, detail in details.items():
            value, detail_value = row.get(name), row.get(detail)
            if value is not None and detail_value is not None and value != detail_value:
                yield Difference(
                    location="result.json",
                    description=f"row {index}, column {name}: {value!r} there, "
                    f"{detail_value!r} by {detail}, which it is",
                )


def _total(expression: Expression, row: dict[str, Cell]) -> float | None:
    values = {
        name: float(cell) if isinstance(cell := row[name], int | float) else None
        for name in expression.names
    }
    return finite_value(expression.score(values).value)[0]
