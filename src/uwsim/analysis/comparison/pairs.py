"""The pairing of the rows of two results by seed and level."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import ResultError
from ...results.per_level import round_level, rows_by_level, seeds_of
from ...results.result import Result
from ...statistics import TrialTime
from ..task import success_times, task_measure
from .inputs import Entry

Level = tuple[float, ...]
"""The values of the swept parameters, outermost first."""


@dataclass(frozen=True, kw_only=True)
class RowPair:
    """The rows of two results at one level of one repeat."""

    seed: int
    """The seed of both rows."""
    first_value: float | None
    """The value in the first result; None if it is missing."""
    second_value: float | None
    """The value in the second result; None if it is missing."""
    first_ok: bool | None
    """True if the first row ended ``ok``; None if the first result has no status."""
    second_ok: bool | None
    """True if the second row ended ``ok``; None if the second result has no status."""
    times: tuple[TrialTime, TrialTime] | None = None
    """The times to success of both rows [s]; None if a result is not of a task."""


@dataclass(frozen=True, kw_only=True)
class PairedRows:
    """The pairs of rows of two results, and the numbers of unpaired rows."""

    levels: dict[Level, tuple[RowPair, ...]]
    """The pairs of each level, in the order of the first result."""
    n_only_first: int
    """The number of rows of the first result without a partner in the second."""
    n_only_second: int
    """The number of rows of the second result without a partner in the first."""


def pair_rows(first_entry: Entry, second_entry: Entry, column: str) -> PairedRows:
    """Pair the rows of two results by seed and level.

    Raises:
        ResultError: no rows can be paired, or a result does not record its seeds.
    """
    first_rows, second_rows = _rows(first_entry), _rows(second_entry)
    levels: dict[Level, list[RowPair]] = {}
    first_ok, second_ok = _ok_flags(first_entry.result), _ok_flags(second_entry.result)
    first_times, second_times = _times(first_entry.result), _times(second_entry.result)
    first_values = first_entry.result.numbers(column)
    second_values = second_entry.result.numbers(column)
    for (seed, level, n_earlier), first_row in first_rows.items():
        second_row = second_rows.get((seed, level, n_earlier))
        if second_row is not None:
            pair = RowPair(
                seed=seed,
                first_value=first_values[first_row],
                second_value=second_values[second_row],
                first_ok=first_ok[first_row],
                second_ok=second_ok[second_row],
                times=(first_times[first_row], second_times[second_row])
                if first_times and second_times
                else None,
            )
            levels.setdefault(level, []).append(pair)
    n = sum(len(pairs) for pairs in levels.values())
    if n == 0:
        raise ResultError(
            f"{first_entry.source} and {second_entry.source} have no seed and level in common: "
            f"{_seeds_and_levels(first_rows)}; {_seeds_and_levels(second_rows)}."
        )
    return PairedRows(
        levels={level: tuple(pairs) for level, pairs in levels.items()},
        n_only_first=len(first_rows) - n,
        n_only_second=len(second_rows) - n,
    )


def _rows(entry: Entry) -> dict[tuple[int, Level, int], int]:
    """Return the row index for each key: seed, level, number of earlier rows with these two."""
    seeds = seeds_of(entry.result)
    row_numbers: dict[tuple[int, Level, int], int] = {}
    for level, rows in rows_by_level(entry.result).items():
        counts: dict[int, int] = {}
        for row in rows:
            seed = seeds[row]
            if seed is None:
                raise ResultError(
                    f"{entry.source}: does not record its seeds, so no rows can be paired."
                )
            n_earlier = counts[seed] = counts.get(seed, -1) + 1
            row_numbers[seed, round_level(level), n_earlier] = row
    return row_numbers


def _ok_flags(result: Result) -> tuple[bool | None, ...]:
    status = result.columns_of_kind("status")
    if not status:
        return (None,) * len(result.rows)
    return tuple(cell == "ok" for cell in result.values(status[0].name))


def _times(result: Result) -> tuple[TrialTime, ...] | None:
    return success_times(result) if task_measure(result) is not None else None


def _seeds_and_levels(rows: dict[tuple[int, Level, int], int]) -> str:
    seeds = sorted({seed for seed, _, _ in rows})
    levels = sorted({level for _, level, _ in rows})
    if not rows:
        return "no rows"
    seed_range = f"{seeds[0]}" + (f" to {seeds[-1]}" if len(seeds) > 1 else "")
    level_texts = [" ".join(f"{v:g}" for v in level) for level in (levels[0], levels[-1])]
    return f"seed {seed_range} at " + (
        level_texts[0] if len(levels) == 1 else f"{level_texts[0]} to {level_texts[1]}"
    )
