"""The median and the worst trial of a result, whose replays the page shows."""

from __future__ import annotations

import math

from ...results.result import Result


def notable_trials(result: Result) -> dict[str, int]:
    """Return the rows of the median and the worst trial, by the words ``median`` and ``worst``.

    Trials are ordered by success, then by the score, of which a lower value is better. A trial
    without a score comes last.
    """
    statuses = result.values(result.columns_of_kind("status")[0].name)
    scores = result.columns_of_kind("score")
    values = result.numbers(scores[0].name) if scores else [None] * len(statuses)
    keys = [
        (status != "ok", math.inf if value is None else value, row)
        for row, (status, value) in enumerate(zip(statuses, values, strict=True))
    ]
    order = sorted(keys)
    return {"median": order[(len(order) - 1) // 2][2], "worst": order[-1][2]}


def describe_row(result: Result, row: int) -> str:
    """Return the seed and the level of a row, and how it ended, in words."""
    names = [
        column
        for column in result.columns
        if column.kind == "level" or (column.kind == "run" and column.name == "seed")
    ]
    texts = [f"{column.name} {result.values(column.name)[row]:g}" for column in names]
    status = result.values(result.columns_of_kind("status")[0].name)[row]
    return ", ".join([*texts, str(status)])
