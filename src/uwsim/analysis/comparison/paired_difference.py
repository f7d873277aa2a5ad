"""The paired differences of two results: intervals, effect sizes, tests, correction, verdict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ...statistics import (
    cohens_d,
    hedges_g,
    holm,
    mean_interval,
    rank_biserial,
    repeats_needed,
    sign_flip,
    signed_rank,
    vargha_delaney,
)
from .model import (
    CONFIDENCE,
    POWER,
    PairedDifference,
    Verdict,
    family_size,
    min_corrected_p,
    min_family_repeats,
)
from .repeats import ALPHA


def paired_difference(
    values: Sequence[tuple[float, float]], higher_is_better: bool
) -> PairedDifference:
    """Return the statistics of pairs of values, before any correction for other tests."""
    first_values, second_values = [a for a, _ in values], [b for _, b in values]
    paired_differences = [b - a for a, b in values]
    better_values, worse_values = (
        (second_values, first_values) if higher_is_better else (first_values, second_values)
    )
    is_tested = len(paired_differences) > 1
    return PairedDifference(
        first=mean_interval(first_values, confidence=CONFIDENCE),
        second=mean_interval(second_values, confidence=CONFIDENCE),
        difference=mean_interval(paired_differences, confidence=CONFIDENCE),
        cohens_d=cohens_d(paired_differences),
        hedges_g=hedges_g(paired_differences),
        rank_biserial=rank_biserial(paired_differences),
        superiority=vargha_delaney(better_values, worse_values) if is_tested else None,
        p=sign_flip(paired_differences) if is_tested else None,
        p_signed_rank=signed_rank(paired_differences) if is_tested else None,
    )


def correct_family(
    family: Sequence[PairedDifference], higher_is_better: bool
) -> list[PairedDifference]:
    """Apply Holm's correction to a family of tests; add verdicts and the repeats needed.

    Tests that could not reach `ALPHA` without correction are not part of the family (Tarone 1990),
    because they can never be significant. The repeats needed are planned for the strictest step of
    the correction.
    """
    alpha, repeats_to_test = ALPHA / family_size(family), min_family_repeats(family)
    p_values = holm([d.p if d.is_tested else None for d in family])
    return [
        replace(
            d,
            p_holm=p,
            verdict=_verdict(
                d,
                p,
                can_differ=d.difference.n >= repeats_to_test
                or (min_p is not None and min_p <= ALPHA),
                higher_is_better=higher_is_better,
            ),
            repeats_to_test=repeats_to_test,
            repeats_needed=None
            if d.hedges_g is None
            else repeats_needed(d.hedges_g, alpha=alpha, target_power=POWER),
        )
        for d, p, min_p in zip(family, p_values, min_corrected_p(family), strict=True)
    ]


def _verdict(
    d: PairedDifference, p: float | None, *, can_differ: bool, higher_is_better: bool
) -> Verdict:
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
