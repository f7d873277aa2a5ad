"""Pairing the rows of two results by seed and level."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import ResultError
from ...results.per_level import round_level, rows_by_level, seeds_of
from ...results.result import Result
from .inputs import Entry

Level = tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Pair:
    """One level of one repeat that both ran."""

    seed: int
    """Seed of both."""
    first: float | None
    """What the first measured; None where it had nothing to measure."""
    second: float | None
    """What the second measured."""
    first_ok: bool | None
    """Whether the first ended ``ok``; None where its result has no status."""
    second_ok: bool | None
    """Whether the second did."""


@dataclass(frozen=True, kw_only=True)
class Paired:
    """All pairs of rows of two results, and unpaired rows."""

    levels: dict[Level, tuple[Pair, ...]]
    """Level -> its pairs, in the order of the first result."""
    n_only_first: int
    """Rows of the first that the second does not have."""
    n_only_second: int
    """Rows of the second that the first does not have."""


def pair_up(first: Entry, second: Entry, column: str) -> Paired:
    """Pair the rows of two results by seed and level.

    Raises:
        ResultError: no rows can be paired, or a result does not record its seeds.
    """
    ours, theirs = _rows(first), _rows(second)
    levels: dict[Level, list[Pair]] = {}
    cells = [(entry.result.numbers(column), _endings(entry.result)) for entry in (first, second)]
    (values, ended), (other_values, other_ended) = cells
    for (seed, level, turn), row in ours.items():
        partner = theirs.get((seed, level, turn))
        if partner is not None:
            pair = Pair(
                seed=seed,
                first=values[row],
                second=other_values[partner],
                first_ok=ended[row],
                second_ok=other_ended[partner],
            )
            levels.setdefault(level, []).append(pair)
    n = sum(len(pairs) for pairs in levels.values())
    if n == 0:
        raise ResultError(
            f"{first.source} and {second.source} have no seed and level in common: "
            f"{_said(ours)}; {_said(theirs)}."
        )
    return Paired(
        levels={level: tuple(pairs) for level, pairs in levels.items()},
        n_only_first=len(ours) - n,
        n_only_second=len(theirs) - n,
    )


def _rows(entry: Entry) -> dict[tuple[int, Level, int], int]:
    """(seed, level, how often seen before) -> row."""
    seeds = seeds_of(entry.result)
    found: dict[tuple[int, Level, int], int] = {}
    for level, rows in rows_by_level(entry.result).items():
        turns: dict[int, int] = {}
        for row in rows:
            seed = seeds[row]
            if seed is None:
                raise ResultError(
                    f"{entry.source}: does not record its seeds; nothing can be paired."
                )
            turn = turns[seed] = turns.get(seed, -1) + 1
            found[seed, round_level(level), turn] = row
    return found


def _endings(result: Result) -> tuple[bool | None, ...]:
    status = result.columns_of_kind("status")
    if not status:
        return (None,) * len(result.rows)
    return tuple(cell == "ok" for cell in result.values(status[0].name))


def _said(rows: dict[tuple[int, Level, int], int]) -> str:
    seeds = sorted({seed for seed, _, _ in rows})
    levels = sorted({level for _, level, _ in rows})
    if not rows:
        return "no rows"
    span = f"{seeds[0]}" + (f" to {seeds[-1]}" if len(seeds) > 1 else "")
    at = [" ".join(f"{v:g}" for v in level) for level in (levels[0], levels[-1])]
    return f"seed {span} at " + (at[0] if len(levels) == 1 else f"{at[0]} to {at[1]}")
