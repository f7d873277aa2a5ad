"""The median and the worst trial of a result, whose replays the page shows; why trials fail."""

from __future__ import annotations

import math
import re
from collections import Counter

from ...analysis.report.outcomes import reason_kind
from ...results.result import Result

MAX_REASONS = 2
"""The number of reasons that the page has for each status."""
MAX_LENGTH = 200
"""The number of characters after which a reason is cut."""
_OUTCOME_REMARK = re.compile(r"^\w+: [a-z ]+, as (?=\S)")
"""The pattern of the beginning of an outcome's remark, which repeats the status."""


def notable_trials(result: Result) -> dict[str, int]:
    """Return the rows of the median and the worst trial, by the words ``median`` and ``worst``.

    Trials are ordered by success, then by the score, of which a lower value is better. A trial
    without a score comes last. If both are one trial, it is the median.
    """
    statuses = result.values(result.columns_of_kind("status")[0].name)
    scores = result.columns_of_kind("score")
    values = result.numbers(scores[0].name) if scores else [None] * len(statuses)
    keys = [
        (status != "ok", math.inf if value is None else value, row)
        for row, (status, value) in enumerate(zip(statuses, values, strict=True))
    ]
    order = sorted(keys)
    median_row, worst_row = order[(len(order) - 1) // 2][2], order[-1][2]
    return (
        {"median": median_row}
        if median_row == worst_row
        else {"median": median_row, "worst": worst_row}
    )


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


def reason_of(result: Result, row: int) -> str:
    """Return why a row failed, in words; empty without a reason.

    It is the reason of the missing score, or the first remark: an outcome judges complete levels,
    which have a score.
    """
    scores = result.columns_of_kind("score")
    reason = result.reason(row, scores[0].name) if scores else None
    texts = [reason, *result.remarks_of(row), *result.reasons(row)]
    text = next((text for text in texts if text), "")
    return _OUTCOME_REMARK.sub("", text)


def frequent_reasons(result: Result) -> list[tuple[str, list[tuple[int, str]]]]:
    """Return the most frequent reasons of each status but ``ok``, with their numbers of rows.

    Reasons that differ in numbers alone are of one kind; the text is that of the first row.
    """
    kinds: dict[str, Counter[str]] = {}
    texts: dict[str, str] = {}
    for row, status in enumerate(result.values(result.columns_of_kind("status")[0].name)):
        if status != "ok" and (reason := reason_of(result, row)):
            kind = reason_kind(reason)
            kinds.setdefault(str(status), Counter())[kind] += 1
            short_text = reason if len(reason) <= MAX_LENGTH else f"{reason[:MAX_LENGTH]}…"
            texts.setdefault(kind, short_text)
    return [
        (status, [(n, texts[kind]) for kind, n in counts.most_common(MAX_REASONS)])
        for status, counts in sorted(kinds.items(), key=lambda item: (-item[1].total(), item[0]))
    ]
