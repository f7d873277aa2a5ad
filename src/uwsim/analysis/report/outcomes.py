"""Statistics of the status of levels: how often each, from which level on, and why."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from ...results.per_level import rows_by_level, seeds_of
from ...results.result import Result
from ..plots import level_text, repeats_of

MEANINGS = {
    "ok": "run to its end, with estimates to score",
    "lost": "the algorithm reported that it is lost",
    "timeout": "no estimate for more than 1 s, or an end of the level that never came",
    "collision": "a contact ended the level, as the benchmark requires",
    "algorithm error": "the algorithm raised an exception, or reported that it failed",
    "simulation error": "a body moved as none can, or the engine gave up: nothing of it is true",
    "not found": "the object was never found",
    "lost target": "the object was found and lost before anything closed on it",
    "missed": "the object was reached for and never lifted",
    "dropped": "the object was lifted and fell",
}
"""Status of a row -> its meaning (``docs/levels.md``)."""
SELDOM = ("simulation error", "not found", "lost target", "missed", "dropped")
"""Listed where one occurred: failed simulations, and what a measure that judges a task gives."""
MAX_REASONS = 5
"""Greatest number of reasons listed for a status."""
MAX_BREAKS = 100
"""Greatest number of repeats whose first failure is listed."""

_NUMBER = re.compile(r"\d+(\.\d+)?([eE][+-]?\d+)?")


@dataclass(frozen=True, kw_only=True)
class Ending:
    """One way in which levels ended, and how often."""

    status: str
    """``ok``, ``lost``, ``timeout``, ..."""
    meaning: str
    """Its meaning; empty for an unknown status."""
    n: int
    """Rows that ended so."""
    share: str
    """Share of all rows; no interval, for the levels of one repeat are no repeats."""
    first: str
    """First level of each repeat that ended so: one, or from the lowest to the last."""
    reasons: tuple[tuple[int, str], ...]
    """(rows, the first such reason): reasons that differ in numbers alone are listed once."""
    n_others: int
    """Further kinds of reasons that are left out."""


@dataclass(frozen=True, kw_only=True)
class Break:
    """The first level of a repeat that did not end ``ok``."""

    repeat: str
    """Its seed."""
    level: str
    """The level; empty when all ended ``ok``."""
    status: str
    """How it ended."""
    why: str
    """The reason."""


def endings(result: Result) -> list[Ending]:
    """Group the rows by status: ok, then by number, finally those that never occurred."""
    status = result.columns_of_kind("status")
    if not status:
        return []
    cells = [str(cell) for cell in result.values(status[0].name)]
    levels = {row: level for level, rows in rows_by_level(result).items() for row in rows}
    repeats = repeats_of(result)
    known = [name for name in MEANINGS if name in cells or name not in SELDOM]
    names = sorted(
        {*cells, *known},
        key=lambda s: (s != "ok", -cells.count(s), known.index(s) if s in known else 99, s),
    )
    found = []
    for name in names:
        rows = [row for row, cell in enumerate(cells) if cell == name]
        reasons = _alike(why for row in rows for why in result.reasons(row))
        found.append(
            Ending(
                status=name,
                meaning=MEANINGS.get(name, ""),
                n=len(rows),
                share=f"{100 * len(rows) / max(1, len(cells)):.0f} %",
                first=_first_at(result, [(repeats[row], levels[row]) for row in rows]),
                reasons=tuple(reasons[:MAX_REASONS]),
                n_others=max(0, len(reasons) - MAX_REASONS),
            )
        )
    return found


def breaks(result: Result) -> list[Break]:
    """Say for each of several repeats where it first did not end ``ok``.

    Nothing for nested sweeps, in which every outer level has its own.
    """
    status, repeats = result.columns_of_kind("status"), repeats_of(result)
    if not status or len(result.columns_of_kind("level")) != 1 or len(set(repeats)) < 2:
        return []
    cells, seeds = result.values(status[0].name), seeds_of(result)
    levels = {row: level for level, rows in rows_by_level(result).items() for row in rows}
    first: dict[tuple[object, ...], int] = {}
    for row, repeat in enumerate(repeats):
        if cells[row] != "ok":
            first.setdefault(repeat, row)
    found = []
    for repeat, seed in list(dict(zip(repeats, seeds, strict=True)).items())[:MAX_BREAKS]:
        at = first.get(repeat)
        found.append(
            Break(
                repeat="?" if seed is None else str(seed),
                level="" if at is None else named_level(result, levels[at]),
                status="ok" if at is None else str(cells[at]),
                why="" if at is None else "; ".join(result.reasons(at)),
            )
        )
    return found


def named_level(result: Result, level: tuple[float, ...]) -> str:
    """Return a level as text: ``noise 0.02, fog 0.5 m⁻¹``."""
    named = zip(result.columns_of_kind("level"), level, strict=True)
    parts = [level_text(column, value) for column, value in named if column.name != "none"]
    return ", ".join(parts) or "the only level"


def kind_of(why: str) -> str:
    """Return a reason without its numbers."""
    return _NUMBER.sub("#", why)


def _alike(reasons: Iterable[str]) -> list[tuple[int, str]]:
    """Count reasons that differ in numbers alone; the first stands for each kind."""
    first: dict[str, str] = {}
    counts: Counter[str] = Counter()
    for why in reasons:
        kind = kind_of(why)
        first.setdefault(kind, why)
        counts[kind] += 1
    return [(counts[kind], why) for kind, why in first.items()]


def _first_at(result: Result, rows: Iterable[tuple[tuple[object, ...], tuple[float, ...]]]) -> str:
    first: dict[tuple[object, ...], tuple[float, ...]] = {}
    for repeat, level in rows:
        first.setdefault(repeat, level)
    if not first:
        return ""
    low, high = min(first.values()), max(first.values())
    text = named_level(result, low)
    return text if low == high else f"{text} to {named_level(result, high)}"
