"""The description of messages of programs that do not take part in a run, and are refused."""

from __future__ import annotations

from collections import Counter

from .result import Result

MAX_LINES = 5
"""The greatest number of topics and services that are named."""


def refused_lines(result: Result) -> list[str]:
    """Return a line for each topic or service with refused messages, without a full stop.

    Refused messages have not changed a row.
    """
    n, senders, rows = Counter[str](), dict[str, set[str]](), dict[str, set[int]]()
    for messages in result.refused_messages:
        n[messages.topic_or_service] += messages.n
        senders.setdefault(messages.topic_or_service, set()).add(messages.sender)
        rows.setdefault(messages.topic_or_service, set()).add(messages.row)
    lines = [
        f"{n[name]} messages or calls on {name} were refused, in {len(rows[name])} rows, from "
        f"{' and '.join(sorted(senders[name])[:2])}{' and others' * (len(senders[name]) > 2)}: "
        "they do not take part in the run"
        for name in sorted(n)
    ]
    n_more = len(lines) - MAX_LINES
    return [*lines[:MAX_LINES], *([f"{n_more} more topics and services"] if n_more > 0 else [])]
