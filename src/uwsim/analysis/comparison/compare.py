"""Computing a comparison: differences, intervals, tests, and the repeats needed.

A repeat is a seed; the levels of one seed share its noise, its template or its history, and are
never counted as repeats. So each level is tested over the seeds, and the sweep as a whole over one
number a seed: its mean over the levels at which every seed has a value from both.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from ...errors import ResultError
from ...results.result import Column
from ...statistics import (
    cohens_d,
    hedges_g,
    holm,
    mcnemar,
    mean_interval,
    rank_biserial,
    rate,
    repeats_needed,
    sign_flip,
    signed_rank,
    vargha_delaney,
)
from .inputs import Entry, differences, read_entries, remarks, same_images, shared_column
from .model import (
    CONFIDENCE,
    POWER,
    AtLevel,
    Comparison,
    Outcome,
    Overall,
    PairedDifference,
    Success,
    Versus,
    family_size,
    fewest_of,
    least_corrected,
)
from .pairs import Level, Pair, pair_up
from .repeats import ALPHA


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
        column: what is compared; without it the score.
        baseline: the place among the paths of the result that all others are compared with.
        higher_is_better: more of it is better; errors are not so.
        force: compare results of different experiments, too.

    Raises:
        ResultError: a result cannot be read, or they are of different experiments.
    """
    entries = read_entries(paths)
    compared = shared_column(entries, column)
    differing = differences(entries)
    if differing and not force:
        raise ResultError(
            f"These results are not of one experiment: {'; '.join(differing)}. "
            "--force compares them all the same."
        )
    return compare(
        entries,
        compared,
        baseline=None if baseline is None else entries[baseline],
        higher_is_better=higher_is_better,
        forced=differing,
        remarks=remarks(entries),
    )


def compare(
    entries: Sequence[Entry],
    column: Column,
    *,
    baseline: Entry | None = None,
    higher_is_better: bool = False,
    forced: tuple[str, ...] = (),
    remarks: tuple[str, ...] = (),
) -> Comparison:
    """Compare results: all with the ``baseline``, or each with each.

    Raises:
        ResultError: two results have no seed and level in common.
    """
    others = [entry for entry in entries if entry is not baseline]
    if baseline is None:
        chosen = [(a, b) for i, a in enumerate(entries) for b in entries[i + 1 :]]
    else:
        chosen = [(baseline, other) for other in others]
    if not chosen:
        raise ResultError("A comparison needs at least two results.")
    versus = [_versus(a, b, column, higher_is_better) for a, b in chosen]
    ordered = (*([baseline] if baseline else []), *others)
    return Comparison(
        entries=ordered,
        baseline=baseline,
        column=column,
        higher_is_better=higher_is_better,
        forced=forced,
        remarks=remarks,
        versus=_corrected(versus, higher_is_better),
    )


def _versus(first: Entry, second: Entry, column: Column, higher_is_better: bool) -> Versus:
    paired = pair_up(first, second, column.name)
    levels = tuple(
        _at_level(level, pairs, higher_is_better) for level, pairs in paired.levels.items()
    )
    return Versus(
        first=first,
        second=second,
        levels=levels,
        overall=_overall(paired.levels, levels, higher_is_better),
        n_only_first=paired.n_only_first,
        n_only_second=paired.n_only_second,
        same_images=same_images(first.result, second.result),
    )


def _at_level(level: Level, pairs: Sequence[Pair], higher_is_better: bool) -> AtLevel:
    has = [(pair.first is not None, pair.second is not None) for pair in pairs]
    return AtLevel(
        level=level,
        seeds=tuple(pair.seed for pair in pairs),
        n_only_first=has.count((True, False)),
        n_only_second=has.count((False, True)),
        n_neither=has.count((False, False)),
        value=_difference(_both(pairs), higher_is_better),
        success=_success(pairs),
    )


def _both(pairs: Iterable[Pair]) -> list[tuple[float, float]]:
    return [
        (pair.first, pair.second)
        for pair in pairs
        if pair.first is not None and pair.second is not None
    ]


def _difference(values: Sequence[tuple[float, float]], higher_is_better: bool) -> PairedDifference:
    first, second = [a for a, _ in values], [b for _, b in values]
    found = [b - a for a, b in values]
    better, worse = (second, first) if higher_is_better else (first, second)
    is_tested = len(found) > 1
    return PairedDifference(
        first=mean_interval(first, confidence=CONFIDENCE),
        second=mean_interval(second, confidence=CONFIDENCE),
        difference=mean_interval(found, confidence=CONFIDENCE),
        cohens_d=cohens_d(found),
        hedges_g=hedges_g(found),
        rank_biserial=rank_biserial(found),
        superiority=vargha_delaney(better, worse) if is_tested else None,
        p=sign_flip(found) if is_tested else None,
        p_signed_rank=signed_rank(found) if is_tested else None,
    )


def _success(pairs: Sequence[Pair]) -> Success | None:
    ended = [(pair.first_ok, pair.second_ok) for pair in pairs]
    first = rate(sum(a is True for a, _ in ended), len(ended), confidence=CONFIDENCE)
    second = rate(sum(b is True for _, b in ended), len(ended), confidence=CONFIDENCE)
    if first is None or second is None or any(None in both for both in ended):
        return None
    first_only, second_only = ended.count((True, False)), ended.count((False, True))
    return Success(
        first=first,
        second=second,
        first_only=first_only,
        second_only=second_only,
        p=mcnemar(first_only, second_only) if len(ended) > 1 else None,
    )


def _overall(
    levels: dict[Level, tuple[Pair, ...]], found: Sequence[AtLevel], higher_is_better: bool
) -> Overall:
    by_seed: dict[int, list[Pair]] = {}
    for pairs in levels.values():
        for pair in pairs:
            by_seed.setdefault(pair.seed, []).append(pair)
    most = max(len(pairs) for pairs in by_seed.values())
    seeds = sorted(seed for seed, pairs in by_seed.items() if len(pairs) == most)
    complete = {
        level: [pair for pair in pairs if pair.seed in set(seeds)]
        for level, pairs in levels.items()
        if all(
            pair.first is not None and pair.second is not None
            for pair in pairs
            if pair.seed in set(seeds)
        )
    }
    values = [
        _both(pair for pairs in complete.values() for pair in pairs if pair.seed == seed)
        for seed in seeds
    ]
    ended = [[(p.first_ok, p.second_ok) for p in by_seed[seed]] for seed in seeds]
    has_status = not any(None in both for pairs in ended for both in pairs)
    means = [at.value.difference.mean for at in found]
    return Overall(
        seeds=tuple(seeds),
        n_levels=len(levels),
        levels=tuple(complete),
        value=_difference([_mean(pairs) for pairs in values if pairs], higher_is_better),
        success=_difference(
            [_mean([(float(a is True), float(b is True)) for a, b in pairs]) for pairs in ended],
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


def _corrected(versus: Sequence[Versus], higher_is_better: bool) -> tuple[Versus, ...]:
    """Correct four families of tests, and give the verdict of each."""
    levels = [at for each in versus for at in each.levels]
    values = _judged([at.value for at in levels], higher_is_better)
    successes = holm(
        [at.success.p if at.success and at.success.is_tested else None for at in levels]
    )
    overall = _judged([each.overall.value for each in versus], higher_is_better)
    ended = iter(_judged([each.overall.success for each in versus if each.overall.success], True))
    corrected = iter(
        replace(
            at,
            value=value,
            success=None if at.success is None else replace(at.success, p_holm=p),
        )
        for at, value, p in zip(levels, values, successes, strict=True)
    )
    return tuple(
        replace(
            each,
            levels=tuple(next(corrected) for _ in each.levels),
            overall=replace(
                each.overall,
                value=value,
                success=next(ended) if each.overall.success else None,
            ),
        )
        for each, value in zip(versus, overall, strict=True)
    )


def _judged(family: Sequence[PairedDifference], higher_is_better: bool) -> list[PairedDifference]:
    """Correct one family by Holm, give verdicts, and plan repeats for its strictest step.

    Tests that could not reach `ALPHA` alone are no part of it (Tarone 1990): they can never be
    called different, wrongly or not.
    """
    alpha, fewest = ALPHA / family_size(family), fewest_of(family)
    corrected = holm([d.p if d.is_tested else None for d in family])
    return [
        replace(
            d,
            p_holm=p,
            verdict=_verdict(
                d,
                p,
                can_differ=d.difference.n >= fewest or (least is not None and least <= ALPHA),
                higher_is_better=higher_is_better,
            ),
            fewest=fewest,
            needed=None
            if d.hedges_g is None
            else repeats_needed(d.hedges_g, alpha=alpha, target_power=POWER),
        )
        for d, p, least in zip(family, corrected, least_corrected(family), strict=True)
    ]


def _verdict(
    d: PairedDifference, p: float | None, *, can_differ: bool, higher_is_better: bool
) -> Outcome:
    mean, n = d.difference.mean, d.difference.n
    if n == 0 or mean is None:
        return "no pair"
    if n == 1:
        return "one repeat"
    if mean == 0.0 and d.difference.std == 0.0:
        return "equal"
    if not can_differ:
        return "too few"
    if p is None or p > ALPHA:
        return "not shown"
    return "second" if (mean > 0) == higher_is_better else "first"
