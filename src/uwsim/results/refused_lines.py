"""Sentences about messages of programs that do not take part in a run."""

from __future__ import annotations

from collections import Counter

from .result import Result

MAX_LINES = 5
"""Topics and services that are named."""


def refused_lines(result: Result) -> list[str]:
    """Return a line for each topic or service on which something was refused, without a full stop.

    None of it has changed a row.
    """
    n, senders, rows = Counter[str](), dict[str, set[str]](), dict[str, set[int]]()
    for each in result.refused:
        n[each.what] += each.n
        senders.setdefault(each.what, set()).add(each.by)
        rows.setdefault(each.what, set()).add(each.row)
    lines = [
        f"{n[what]} messages or calls on {what} were refused, in {len(rows[what])} rows, from "
        f"{' and '.join(sorted(senders[what])[:2])}{' and others' * (len(senders[what]) > 2)}: "
        "they do not take part in the run"
        for what in sorted(n)
    ]
    more = len(lines) - MAX_LINES
    return [*lines[:MAX_LINES], *([f"{more} more topics and services"] if more > 0 else [])]
