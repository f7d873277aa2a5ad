"""Paired tests, effect sizes, Holm and power against scipy, published numbers and hand work."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy import stats

from uwsim.base.rng import stream
from uwsim.statistics import (
    cohens_d,
    hedges_g,
    holm,
    mcnemar,
    min_p_value,
    min_pairs,
    power,
    rank_biserial,
    repeats_needed,
    sign_flip,
    signed_rank,
    vargha_delaney,
)

DARWIN = [49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48]
"""Darwin 1876: crossed less self-fertilised maize, eighths of an inch (Fisher 1935, section 17)."""
TIED = [2.0, 2.0, -1.0, 0.0, 3.0, -2.0, 1.0, 0.0, 5.0]


def draw(n: int, shift: float = 0.4) -> list[float]:
    return stream(0, f"paired/{n}").normal(shift, 1.0, n).tolist()


# ---------------------------------------------------------------------------- sign flips


def test_darwins_maize_has_fishers_p_value() -> None:
    # Fisher 1935, section 21: 1726 of 32 768 sign patterns, 835 + 28 on each side.
    assert sign_flip(DARWIN) == 1726 / 32768


@pytest.mark.parametrize("n", [1, 2, 5, 9])
def test_every_sign_pattern_counts_once(n: int) -> None:
    values = draw(n)
    sums = [
        abs(sum(s * v for s, v in zip(signs, values, strict=True)))
        for signs in itertools.product((1, -1), repeat=n)
    ]
    expected = sum(s >= abs(sum(values)) - 1e-12 for s in sums) / 2**n
    assert sign_flip(values) == expected


def test_sign_flips_agree_with_scipy() -> None:
    theirs = stats.permutation_test(
        (draw(12),), np.mean, permutation_type="samples", n_resamples=np.inf
    )
    assert sign_flip(draw(12)) == pytest.approx(theirs.pvalue, abs=1e-12)


def test_drawn_sign_patterns_come_close_to_all_of_them_and_are_the_same_every_time() -> None:
    values = draw(21)
    p = sign_flip(values)
    sums = np.zeros(1)
    for value in values:
        sums = np.concatenate([sums + value, sums - value])
    exact = float(np.mean(np.abs(sums) >= abs(sum(values)) - 1e-12))
    assert p == pytest.approx(exact, abs=0.003)
    assert sign_flip(values) == p


def test_hundreds_of_differences_are_tested_as_student_does() -> None:
    assert sign_flip(draw(201, 0.1)) == pytest.approx(
        stats.ttest_1samp(draw(201, 0.1), 0.0).pvalue, rel=1e-10
    )


def test_no_difference_is_p_1_and_no_pair_is_no_test() -> None:
    assert sign_flip([0.0] * 4) == 1.0
    assert sign_flip([0.0] * 300) == 1.0
    assert sign_flip([]) is None


def test_many_zeros_do_not_make_few_differences_significant() -> None:
    """Six equal differences among 400 pairs: exactly 2/2^6, where Student's test has 1.4 %."""
    assert sign_flip([1.0] * 6 + [0.0] * 394) == 2 / 2**6
    assert sign_flip([1.0] * 30 + [0.0] * 394) == pytest.approx(1e-5)
    assert signed_rank([]) is None
    assert signed_rank([0.0, 0.0]) == 1.0


def test_equal_differences_reach_the_smallest_p_there_is_in_spite_of_rounding() -> None:
    assert sign_flip([0.1] * 10) == 2 / 2**10


@pytest.mark.parametrize(("alpha", "fewest"), [(0.05, 6), (0.0625, 5), (0.01, 8), (0.05 / 27, 11)])
def test_fewest_pairs_that_can_reach_a_level(alpha: float, fewest: int) -> None:
    assert min_pairs(alpha) == fewest
    assert 2 / 2**fewest <= alpha < 2 / 2 ** (fewest - 1)


@pytest.mark.parametrize("n", [1, 2, 5, 6, 7, 12])
def test_the_smallest_p_is_that_of_differences_of_one_sign_and_scipy_agrees(n: int) -> None:
    values = np.abs(draw(n)) + 0.1
    assert sign_flip(values.tolist()) == min_p_value(n)
    if n > 1:
        theirs = stats.permutation_test(
            (values,), np.mean, permutation_type="samples", n_resamples=np.inf
        )
        assert theirs.pvalue == pytest.approx(min_p_value(n), abs=1e-12)
    assert all((sign_flip(draw(n, shift)) or 0.0) >= min_p_value(n) for shift in (0.0, 1.0, 9.0))


@pytest.mark.parametrize("n", [21, 60, 200])
def test_where_sign_patterns_are_drawn_no_p_is_below_one_in_all_of_them(n: int) -> None:
    assert min_p_value(n) == 1e-5
    assert 1e-5 <= (sign_flip([1.0] * n) or 0.0) <= 2e-5


@pytest.mark.parametrize("n_tests", [1, 3, 27])
def test_with_the_fewest_pairs_of_a_corrected_level_the_clearest_differences_are_shown(
    n_tests: int,
) -> None:
    fewest = min_pairs(0.05 / n_tests)
    clear = [sign_flip([1.0] * fewest)] * n_tests
    assert all(p is not None and p <= 0.05 for p in holm(clear))
    short = [sign_flip([1.0] * (fewest - 1))] * n_tests
    assert all(p is not None and p > 0.05 for p in holm(short))


# ---------------------------------------------------------------------------- signed ranks


@pytest.mark.parametrize("n", [1, 4, 10, 25, 60])
def test_signed_ranks_agree_with_scipy(n: int) -> None:
    theirs = stats.wilcoxon(draw(n), method="exact")
    assert signed_rank(draw(n)) == pytest.approx(theirs.pvalue, abs=1e-12)


def test_tied_and_zero_differences_are_counted_exactly() -> None:
    values = [v for v in TIED if v]
    ranks = stats.rankdata(np.abs(values))
    found = sum(rank for rank, value in zip(ranks, values, strict=True) if value > 0)
    sums = [
        sum(rank for rank, sign in zip(ranks, signs, strict=True) if sign)
        for signs in itertools.product((True, False), repeat=len(values))
    ]
    middle = sum(ranks) / 2
    expected = sum(abs(s - middle) >= abs(found - middle) - 1e-9 for s in sums) / len(sums)
    assert signed_rank(TIED) == pytest.approx(expected, abs=1e-12)


def test_hundreds_of_ranks_have_the_normal_limit() -> None:
    theirs = stats.wilcoxon(draw(250, 0.1), method="approx", correction=True)
    assert signed_rank(draw(250, 0.1)) == pytest.approx(theirs.pvalue, rel=1e-12)
    near = stats.wilcoxon(draw(200, 0.1), method="approx", correction=True)
    assert signed_rank(draw(200, 0.1)) == pytest.approx(near.pvalue, rel=0.05)


# ---------------------------------------------------------------------------- McNemar, Holm


@pytest.mark.parametrize(("b", "c"), [(0, 0), (1, 0), (3, 9), (5, 5), (0, 6), (120, 80)])
def test_mcnemar_is_a_fair_coin(b: int, c: int) -> None:
    expected = stats.binomtest(b, b + c).pvalue if b + c else 1.0
    assert mcnemar(b, c) == pytest.approx(expected, abs=1e-12)


def test_holm_is_r_s_p_adjust() -> None:
    # R: p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm") -> 0.03 0.06 0.06 0.02
    assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx((0.03, 0.06, 0.06, 0.02))
    assert holm([0.9, 0.8]) == (1.0, 1.0)


def test_what_was_not_tested_is_not_corrected_for() -> None:
    assert holm([None, 0.02, None]) == (None, 0.02, None)
    assert holm([]) == ()


@pytest.mark.parametrize("n_tests", [5, 20])
def test_holm_seldom_finds_a_difference_where_there_is_none(n_tests: int) -> None:
    random = stream(0, f"holm/{n_tests}")
    found = 0
    for _ in range(400):
        sets = random.normal(0.0, 1.0, (n_tests, 10)).tolist()
        found += min(p for p in holm([sign_flip(values) for values in sets]) if p) <= 0.05
    assert found / 400 <= 0.08


# ---------------------------------------------------------------------------- sizes of effects


def test_cohens_d_and_hedges_g_by_hand() -> None:
    values = [1.0, 2.0, 3.0]  # mean 2, deviation 1
    assert cohens_d(values) == 2.0
    assert hedges_g(values) == pytest.approx(2.0 / math.gamma(0.5))  # J(2) = 1/sqrt(pi)
    d = cohens_d(draw(10))
    assert d is not None
    assert hedges_g(draw(10)) == pytest.approx((1 - 3 / (4 * 9 - 1)) * d, rel=0.001)


def test_hedges_g_is_right_on_average_and_cohens_d_is_not() -> None:
    sets = stream(0, "hedges").normal(0.8, 1.0, (20_000, 6)).tolist()
    assert np.mean([hedges_g(values) for values in sets]) == pytest.approx(0.8, abs=0.012)
    assert np.mean([cohens_d(values) for values in sets]) == pytest.approx(0.8 / 0.8408, abs=0.015)


def test_without_spread_there_is_no_unit_to_measure_by() -> None:
    assert cohens_d([1.0]) is None
    assert cohens_d([0.5] * 4) is None
    assert cohens_d([0.0] * 4) is None
    assert hedges_g([1.0, 2.0]) is None
    assert rank_biserial([0.0]) is None
    assert vargha_delaney([], [1.0]) is None


def test_vargha_delaney_counts_wins_and_half_the_ties() -> None:
    assert vargha_delaney([1.0, 2.0, 3.0], [2.0, 4.0]) == (0 + 0.5 + 1) / 6
    assert vargha_delaney([5.0, 6.0], [1.0, 2.0]) == 1.0
    a, b = draw(30), draw(31, 0.0)
    u = stats.mannwhitneyu(a, b).statistic
    assert vargha_delaney(a, b) == pytest.approx(u / (30 * 31))


def test_rank_biserial_is_what_is_left_of_the_rank_sums() -> None:
    assert rank_biserial([1.0, 2.0, -3.0, 4.0]) == pytest.approx((1 + 2 + 4 - 3) / 10)
    assert rank_biserial(TIED) == pytest.approx((4 + 4 + 6 + 1.5 + 7 - 1.5 - 4) / 28)
    assert rank_biserial([3.0, 1.0]) == 1.0


# ---------------------------------------------------------------------------- power


@pytest.mark.parametrize(("d", "n"), [(0.2, 199), (0.5, 34), (0.8, 15)])
def test_repeats_needed_are_those_of_g_power(d: float, n: int) -> None:
    # G*Power 3.1, t tests, matched pairs, two tails, alpha 0.05, power 0.8
    assert repeats_needed(d) == n
    assert repeats_needed(-d) == n


@pytest.mark.parametrize("alpha", [0.05, 0.05 / 27, 5e-5])
def test_power_is_a_number_and_grows_whatever_the_effect_and_the_repeats(alpha: float) -> None:
    sizes = np.geomspace(0.1, 100, 60)
    for n in (2, 3, 6, 11, 20, 50):
        powers = np.array([power(n, float(d), alpha) for d in sizes])
        assert np.isfinite(powers).all()
        assert (np.diff(powers) >= -1e-12).all()
        assert powers[-1] == 1.0 or n == 2


@pytest.mark.parametrize("d", [3.0, 8.8, 15.6, 1000.0])
def test_repeats_needed_are_never_fewer_than_the_sign_flip_test_needs(d: float) -> None:
    assert repeats_needed(d) == 6
    assert repeats_needed(d, alpha=0.05 / 27) == 11


def test_power_is_the_share_of_experiments_that_show_the_effect() -> None:
    sets = stream(0, "power").normal(0.7, 1.0, (4000, 12))
    shown = stats.ttest_1samp(sets, 0.0, axis=1).pvalue <= 0.05
    assert power(12, 0.7) == pytest.approx(shown.mean(), abs=0.02)


def test_the_sign_flip_test_is_as_powerful_as_the_plan_says() -> None:
    n = repeats_needed(0.9)
    assert n is not None
    sets = stream(0, "plan").normal(0.9, 1.0, (600, n)).tolist()
    shown = np.mean([(sign_flip(values) or 1.0) <= 0.05 for values in sets])
    assert shown == pytest.approx(0.8, abs=0.05)


def test_no_effect_is_never_shown_and_a_large_one_needs_what_the_test_needs() -> None:
    assert repeats_needed(0.0) is None
    assert repeats_needed(0.001) is None
    assert repeats_needed(1e6) == 6
    assert repeats_needed(1e6, alpha=0.05 / 27) == 11
