"""The comparison of the times to success of two results of a task, pair by pair."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ...statistics import TrialTime, paired_log_rank, success_curve
from ..task import restricted_time, time_limit
from .model import CONFIDENCE, LevelTimes, PairComparison, PairTimes
from .paired_difference import correct_family, paired_difference
from .pairs import Level, RowPair

TimePair = tuple[TrialTime, TrialTime]


def compare_times(levels: Mapping[Level, Sequence[RowPair]]) -> PairTimes | None:
    """Compare the times to success; None without times, or if no trial ever succeeded.

    The mean time up to the time limit is compared, because a mean over the successes alone would
    favour an algorithm that succeeds at easy seeds only.
    """
    trials = [trial for rows in levels.values() for row in rows for trial in row.times or ()]
    limit = time_limit(trials)
    if limit is None or not any(trial.has_succeeded for trial in trials):
        return None
    seeds = dict.fromkeys(row.seed for rows in levels.values() for row in rows)
    n_levels = sum(len(rows) > 0 for rows in levels.values())
    means = []
    for seed in seeds:
        pairs = [row.times for rows in levels.values() for row in rows if row.seed == seed]
        values = _restricted_pairs([pair for pair in pairs if pair is not None], limit)
        if len(values) == len(pairs) >= n_levels:
            means.append((_mean([a for a, _ in values]), _mean([b for _, b in values])))
    level_times = (_compare_at_level(level, rows, limit) for level, rows in levels.items())
    return PairTimes(
        limit=limit,
        levels=tuple(times for times in level_times if times is not None),
        sweep=paired_difference(means, higher_is_better=False),
    )


def correct_times(pairs: Sequence[PairComparison]) -> tuple[PairComparison, ...]:
    """Correct the p-values of two families, single levels and sweeps of all pairs of results."""
    all_times = [pair.times for pair in pairs if pair.times is not None]
    level_differences = [level.difference for times in all_times for level in times.levels]
    levels = iter(correct_family(level_differences, higher_is_better=False))
    sweeps = iter(correct_family([times.sweep for times in all_times], higher_is_better=False))
    return tuple(
        pair
        if pair.times is None
        else replace(
            pair,
            times=replace(
                pair.times,
                levels=tuple(replace(t, difference=next(levels)) for t in pair.times.levels),
                sweep=next(sweeps),
            ),
        )
        for pair in pairs
    )


def _compare_at_level(level: Level, rows: Sequence[RowPair], limit: float) -> LevelTimes | None:
    pairs = [row.times for row in rows if row.times is not None]
    first, second = [a for a, _ in pairs], [b for _, b in pairs]
    first_curve = success_curve(first, confidence=CONFIDENCE)
    second_curve = success_curve(second, confidence=CONFIDENCE)
    if first_curve is None or second_curve is None:
        return None
    return LevelTimes(
        level=level,
        first=first_curve,
        second=second_curve,
        difference=paired_difference(_restricted_pairs(pairs, limit), higher_is_better=False),
        p_log_rank=paired_log_rank(first, second) if len(pairs) > 1 else None,
    )


def _restricted_pairs(pairs: Sequence[TimePair], limit: float) -> list[tuple[float, float]]:
    """Return the times of the pairs of which both are known up to the limit [s]."""
    times = [(restricted_time(a, limit), restricted_time(b, limit)) for a, b in pairs]
    return [(a, b) for a, b in times if a is not None and b is not None]


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
