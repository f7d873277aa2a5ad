"""Redundant values of a row: its total from the values, and a value from its detail.

Both can be computed without running anything, so whoever changes one has to change the other.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..base.expression import Expression, parse
from ..benchmark.spec import BenchmarkSpec
from ..results.leaves import leaves
from ..results.result import Cell, Result
from ..runs.trial.triggered_measure import finite
from .differences import Difference


def contradictions(result: Result, benchmark: BenchmarkSpec) -> Iterator[Difference]:
    """Recompute totals and derived values; yields those that differ.

    Args:
        result: as it was read.
        benchmark: what was run.
    """
    columns = [column.name for column in result.columns]
    chosen = {spec.name: f"{spec.name}.{spec.value}" for spec in benchmark.measures}
    expression = parse(benchmark.function.text, list(chosen))
    for number, cells in enumerate(result.rows):
        row = dict(zip(columns, cells, strict=True))
        if set(expression.names) <= set(row) and "total" in row:
            worked_out = _total(expression, row)
            if leaves(row["total"]) != leaves(worked_out):
                yield Difference(
                    where="result.json",
                    what=f"row {number}, column total: {row['total']!r} there, {worked_out!r} "
                    f"by {expression.text!r} of the row's values",
                )
        for name, detail in chosen.items():
            value, same = row.get(name), row.get(detail)
            if value is not None and same is not None and value != same:
                yield Difference(
                    where="result.json",
                    what=f"row {number}, column {name}: {value!r} there, {same!r} by {detail}, "
                    "which it is",
                )


def _total(expression: Expression, row: dict[str, Cell]) -> float | None:
    """The total of a row; None unless its status is ok."""
    if row.get("status") != "ok":
        return None
    values = {
        name: float(cell) if isinstance(cell := row[name], int | float) else None
        for name in expression.names
    }
    return finite(expression.score(values).value)[0]
