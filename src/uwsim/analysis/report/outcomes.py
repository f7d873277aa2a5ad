"""Statistics of the statuses of rows: their numbers, first levels and reasons."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from ...results.per_level import rows_by_level, seeds_of
from ...results.result import Result
from ..plots import levels_text, repeats_of

MEANINGS = {
    "ok": "the level ran to its end, with estimates to score",
    "lost": "the algorithm reported that it is lost",
    "timeout": "no estimate for more than 1 s, or the level did not end in time",
    "collision": "a contact ended the level, as the benchmark requires",
    "algorithm error": "the algorithm raised an exception, or reported that it failed",
    "simulation error": "the motion of a body is impossible, or the engine stopped: not valid",
    "not found": "the object was never found",
    "lost target": "the object was found, and lost before it was touched",
    "missed": "the task was not done; in a grasp: the object was touched, but never lifted",
    "dropped": "the object was lifted and fell",
}
"""The meaning of each status of a row (``docs/levels.md``)."""
RARE_STATUSES = ("simulation error", "not found", "lost target", "missed", "dropped")
"""The statuses that are listed only if they occur."""
MAX_REASONS = 5
"""The greatest number of reasons that are listed for a status."""
MAX_FIRST_FAILURES = 100
"""The greatest number of repeats whose first failure is listed."""

_NUMBER = re.compile(r"\d+(\.\d+)?([eE][+-]?\d+)?")


@dataclass(frozen=True, kw_only=True)
class Ending:
    """The rows that ended with the same status."""

    status: str
    """The status: ``ok``, ``lost``, ``timeout``, ..."""
    meaning: str
    """The meaning of the status; empty for an unknown status."""
    n: int
    """The number of rows."""
    share: str
    """The fraction of all rows; without an interval, because the levels of a repeat are not
    independent samples."""
    first_levels: str
    """The first level of each repeat with the status: one level, or the lowest to the highest."""
    reasons: tuple[tuple[int, str], ...]
    """The number of rows and an example for each kind of reason; reasons that differ only in
    numbers are of one kind."""
    n_others: int
    """The number of kinds of reasons that are omitted."""


@dataclass(frozen=True, kw_only=True)
class FirstFailure:
    """The first level of a repeat that did not end ``ok``."""

    repeat: str
    """The seed of the repeat."""
    level: str
    """The level; empty if all levels ended ``ok``."""
    status: str
    """The status of the level."""
    reason: str
    """The reason for the status; empty without a failure."""


def endings(result: Result) -> list[Ending]:
    """Return the rows by status: ok first, then by number of rows, which may be 0."""
    status = result.columns_of_kind("status")
    if not status:
        return []
    cells = [str(cell) for cell in result.values(status[0].name)]
    levels = {row: level for level, rows in rows_by_level(result).items() for row in rows}
    repeats = repeats_of(result)
    statuses = [name for name in MEANINGS if name in cells or name not in RARE_STATUSES]
    names = sorted(
        {*cells, *statuses},
        key=lambda s: (s != "ok", -cells.count(s), statuses.index(s) if s in statuses else 99, s),
    )
    groups = []
    for name in names:
        rows = [row for row, cell in enumerate(cells) if cell == name]
        reasons = _count_reasons(reason for row in rows for reason in result.reasons(row))
        groups.append(
            Ending(
                status=name,
                meaning=MEANINGS.get(name, ""),
                n=len(rows),
                share=f"{100 * len(rows) / max(1, len(cells)):.0f} %",
                first_levels=_first_levels_text(result, [(repeats[r], levels[r]) for r in rows]),
                reasons=tuple(reasons[:MAX_REASONS]),
                n_others=max(0, len(reasons) - MAX_REASONS),
            )
        )
    return groups


def first_failures(result: Result) -> list[FirstFailure]:
    """Return, for each of several repeats, the first level that did not end ``ok``.

    The list is empty for nested sweeps, which have a first failure for every outer level.
    """
    status, repeats = result.columns_of_kind("status"), repeats_of(result)
    if not status or len(result.columns_of_kind("level")) != 1 or len(set(repeats)) < 2:
        return []
    cells, seeds = result.values(status[0].name), seeds_of(result)
    levels = {row: level for level, rows in rows_by_level(result).items() for row in rows}
    first_rows: dict[tuple[object, ...], int] = {}
    for row, repeat in enumerate(repeats):
        if cells[row] != "ok":
            first_rows.setdefault(repeat, row)
    failures = []
    for repeat, seed in list(dict(zip(repeats, seeds, strict=True)).items())[:MAX_FIRST_FAILURES]:
        failed_row = first_rows.get(repeat)
        failures.append(
            FirstFailure(
                repeat="?" if seed is None else str(seed),
                level="" if failed_row is None else result_level_text(result, levels[failed_row]),
                status="ok" if failed_row is None else str(cells[failed_row]),
                reason="" if failed_row is None else "; ".join(result.reasons(failed_row)),
            )
        )
    return failures


def result_level_text(result: Result, level: tuple[float, ...]) -> str:
    """Return a level of a result as text: ``noise 0.02, fog 0.5 m⁻¹``."""
    return levels_text(result.columns_of_kind("level"), level)


def reason_kind(reason: str) -> str:
    """Return a reason without its numbers."""
    return _NUMBER.sub("#", reason)


def _count_reasons(reasons: Iterable[str]) -> list[tuple[int, str]]:
    first_reasons: dict[str, str] = {}
    counts: Counter[str] = Counter()
    for reason in reasons:
        kind = reason_kind(reason)
        first_reasons.setdefault(kind, reason)
        counts[kind] += 1
    return [(counts[kind], reason) for kind, reason in first_reasons.items()]


def _first_levels_text(
    result: Result, rows: Iterable[tuple[tuple[object, ...], tuple[float, ...]]]
) -> str:
    first_levels: dict[tuple[object, ...], tuple[float, ...]] = {}
    for repeat, level in rows:
        first_levels.setdefault(repeat, level)
    if not first_levels:
        return ""
    low, high = min(first_levels.values()), max(first_levels.values())
    text = result_level_text(result, low)
    return text if low == high else f"{text} to {result_level_text(result, high)}"
