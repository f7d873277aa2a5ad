"""The computation of a comparison: differences, intervals, tests, and the repeats needed.

A repeat is a seed. The levels of one seed share its noise, its template or its history, so they are
not repeats. Each level is therefore tested over the seeds. The sweep as a whole is tested over one
value for each seed: the mean over the levels at which every seed has a value in both results.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from ...errors import ResultError
from ...results.result import Column
from ...statistics import holm, mcnemar, rate
from .inputs import Entry, count_same_images, differences, read_entries, remarks, shared_column
from .model import (
    CONFIDENCE,
    Comparison,
    LevelStatistics,
    PairComparison,
    Success,
    SweepStatistics,
)
from .paired_difference import correct_family, paired_difference
from .pairs import Level, RowPair, pair_rows
from .times import compare_times, correct_times


def compare_files(
    paths: Sequence[Path],
    *,
    column: str | None = None,
    baseline: int | None = None,
    higher_is_better: bool = False,
    force: bool = False,
) -> Comparison:
    """Read results and compare them.

    Args:
        paths: result directories, or their ``result.json``.
        column: the name of the column to compare; None for the score.
        baseline: the index in ``paths`` of the result that all others are compared with; None to
            compare each result with each.
        higher_is_better: True if a higher value is better; False for errors.
        force: True to compare results of different experiments, too.

    Raises:
        ResultError: a result cannot be read, or the results are of different experiments.
    """
    entries = read_entries(paths)
    compared_column = shared_column(entries, column)
    experiment_differences = differences(entries)
    if experiment_differences and not force:
        raise ResultError(
            f"These results are not of one experiment: {'; '.join(experiment_differences)}. "
            "Use --force to compare them anyway."
        )
    return compare(
        entries,
        compared_column,
        baseline=None if baseline is None else entries[baseline],
        higher_is_better=higher_is_better,
        experiment_differences=experiment_differences,
        remarks=remarks(entries),
    )


def compare(
    entries: Sequence[Entry],
    column: Column,
    *,
    baseline: Entry | None = None,
    higher_is_better: bool = False,
    experiment_differences: tuple[str, ...] = (),
    remarks: tuple[str, ...] = (),
) -> Comparison:
    """Compare all results with the ``baseline``, or each with each.

    Args:
        entries: the results.
        column: the column to compare.
        baseline: the result that all others are compared with; None to compare each with each.
        higher_is_better: True if a higher value is better.
        experiment_differences: the differences between the experiments, from `differences`.
        remarks: the remarks on the results, from `remarks`.

    Raises:
        ResultError: two results have no seed and level in common.
    """
    other_entries = [entry for entry in entries if entry is not baseline]
    if baseline is None:
        entry_pairs = [(a, b) for i, a in enumerate(entries) for b in entries[i + 1 :]]
    else:
        entry_pairs = [(baseline, other) for other in other_entries]
    if not entry_pairs:
        raise ResultError("A comparison needs at least two results.")
    pairs = [_compare_pair(a, b, column, higher_is_better) for a, b in entry_pairs]
    return Comparison(
        entries=(*([baseline] if baseline else []), *other_entries),
        baseline=baseline,
        column=column,
        higher_is_better=higher_is_better,
        experiment_differences=experiment_differences,
        remarks=remarks,
        pairs=correct_times(_correct_pairs(pairs, higher_is_better)),
    )


def _compare_pair(
    first_entry: Entry, second_entry: Entry, column: Column, higher_is_better: bool
) -> PairComparison:
    paired_rows = pair_rows(first_entry, second_entry, column.name)
    levels = tuple(
        _compare_at_level(level, rows, higher_is_better)
        for level, rows in paired_rows.levels.items()
    )
    return PairComparison(
        first=first_entry,
        second=second_entry,
        levels=levels,
        sweep=_compare_over_sweep(paired_rows.levels, levels, higher_is_better),
        n_only_first=paired_rows.n_only_first,
        n_only_second=paired_rows.n_only_second,
        same_images=count_same_images(first_entry.result, second_entry.result),
        times=compare_times(paired_rows.levels),
    )


def _compare_at_level(
    level: Level, rows: Sequence[RowPair], higher_is_better: bool
) -> LevelStatistics:
    has_values = [(row.first_value is not None, row.second_value is not None) for row in rows]
    return LevelStatistics(
        level=level,
        seeds=tuple(row.seed for row in rows),
        n_only_first=has_values.count((True, False)),
        n_only_second=has_values.count((False, True)),
        n_neither=has_values.count((False, False)),
        value=paired_difference(_value_pairs(rows), higher_is_better),
        success=_success(rows),
    )


def _value_pairs(rows: Iterable[RowPair]) -> list[tuple[float, float]]:
    return [
        (row.first_value, row.second_value)
        for row in rows
        if row.first_value is not None and row.second_value is not None
    ]


def _success(rows: Sequence[RowPair]) -> Success | None:
    ok_flags = [(row.first_ok, row.second_ok) for row in rows]
    first_rate = rate(sum(a is True for a, _ in ok_flags), len(ok_flags), confidence=CONFIDENCE)
    second_rate = rate(sum(b is True for _, b in ok_flags), len(ok_flags), confidence=CONFIDENCE)
    if first_rate is None or second_rate is None or any(None in flags for flags in ok_flags):
        return None
    first_only, second_only = ok_flags.count((True, False)), ok_flags.count((False, True))
    return Success(
        first=first_rate,
        second=second_rate,
        first_only=first_only,
        second_only=second_only,
        p=mcnemar(first_only, second_only) if len(ok_flags) > 1 else None,
    )


def _compare_over_sweep(
    levels: dict[Level, tuple[RowPair, ...]],
    level_statistics: Sequence[LevelStatistics],
    higher_is_better: bool,
) -> SweepStatistics:
    by_seed: dict[int, list[RowPair]] = {}
    for rows in levels.values():
        for row in rows:
            by_seed.setdefault(row.seed, []).append(row)
    max_pairs = max(len(rows) for rows in by_seed.values())
    seeds = sorted(seed for seed, rows in by_seed.items() if len(rows) == max_pairs)
    rows_of_seeds = {
        level: [row for row in rows if row.seed in set(seeds)] for level, rows in levels.items()
    }
    complete_levels = {
        level: rows
        for level, rows in rows_of_seeds.items()
        if all(row.first_value is not None and row.second_value is not None for row in rows)
    }
    values = [
        _value_pairs(row for rows in complete_levels.values() for row in rows if row.seed == seed)
        for seed in seeds
    ]
    ok_flags = [[(row.first_ok, row.second_ok) for row in by_seed[seed]] for seed in seeds]
    has_status = not any(None in flags for seed_flags in ok_flags for flags in seed_flags)
    means = [stats.value.difference.mean for stats in level_statistics]
    return SweepStatistics(
        seeds=tuple(seeds),
        n_levels=len(levels),
        levels=tuple(complete_levels),
        value=paired_difference([_mean(pairs) for pairs in values if pairs], higher_is_better),
        success=paired_difference(
            [_mean([(float(a is True), float(b is True)) for a, b in flags]) for flags in ok_flags],
            higher_is_better=True,
        )
        if has_status
        else None,
        n_first_smaller=sum(mean is not None and mean > 0 for mean in means),
        n_second_smaller=sum(mean is not None and mean < 0 for mean in means),
    )


def _mean(values: Sequence[tuple[float, float]]) -> tuple[float, float]:
    n = len(values)
    return sum(a for a, _ in values) / n, sum(b for _, b in values) / n


# ---------------------------------------------------------------------------- many tests at once


def _correct_pairs(
    pairs: Sequence[PairComparison], higher_is_better: bool
) -> tuple[PairComparison, ...]:
    """Correct the p-values of four families of tests, and add the verdicts.

    A family has all pairs of results: values at single levels, success at single levels, values
    over the sweep, and success over the sweep.
    """
    levels = [stats for pair in pairs for stats in pair.levels]
    values = correct_family([stats.value for stats in levels], higher_is_better)
    successes = holm(
        [stats.success.p if stats.success and stats.success.is_tested else None for stats in levels]
    )
    sweep_differences = correct_family([pair.sweep.value for pair in pairs], higher_is_better)
    success_differences = iter(
        correct_family([pair.sweep.success for pair in pairs if pair.sweep.success], True)
    )
    corrected_levels = iter(
        replace(
            stats,
            value=value,
            success=None if stats.success is None else replace(stats.success, p_holm=p),
        )
        for stats, value, p in zip(levels, values, successes, strict=True)
    )
    return tuple(
        replace(
            pair,
            levels=tuple(next(corrected_levels) for _ in pair.levels),
            sweep=replace(
                pair.sweep,
                value=value,
                success=next(success_differences) if pair.sweep.success else None,
            ),
        )
        for pair, value in zip(pairs, sweep_differences, strict=True)
    )
