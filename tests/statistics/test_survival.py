"""Times to success: Kaplan-Meier and log-rank against published numbers and exact special cases."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from uwsim.statistics import (
    TrialTime,
    log_rank,
    median_interval,
    paired_log_rank,
    rate,
    sign_flip,
    success_curve,
)


def succeeded(*times: float) -> list[TrialTime]:
    return [TrialTime(time=time, has_succeeded=True) for time in times]


def censored(*times: float) -> list[TrialTime]:
    return [TrialTime(time=time, has_succeeded=False) for time in times]


# Freireich et al. 1963, Blood 21, 699: weeks of remission of 42 children with leukaemia.
TREATED = succeeded(6, 6, 6, 7, 10, 13, 16, 22, 23) + censored(
    6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35
)
PLACEBO = succeeded(1, 1, 2, 2, 3, 4, 4, 5, 5, 8, 8, 8, 8, 11, 11, 12, 12, 15, 17, 22, 23)


def test_the_curve_is_that_of_the_published_example() -> None:
    curve = success_curve(TREATED)
    assert curve is not None
    shares = dict(zip(curve.times, curve.shares, strict=True))
    published = {6: 0.857, 7: 0.807, 10: 0.753, 13: 0.690, 16: 0.627, 22: 0.538, 23: 0.448}
    for week, survival in published.items():  # Collett, Modelling Survival Data, and elsewhere
        assert 1 - shares[week] == pytest.approx(survival, abs=5e-4)
    assert curve.median.value == 23
    assert curve.median.high == math.inf
    placebo = success_curve(PLACEBO)
    assert placebo is not None
    assert placebo.median.value == 8


def test_the_log_rank_test_is_that_of_the_published_example() -> None:
    test = log_rank(TREATED, PLACEBO)
    assert (test.n_successes, test.expected_successes) == (9, pytest.approx(19.25, abs=5e-3))
    assert test.chi_square == pytest.approx(16.79, abs=5e-3)
    assert test.p == pytest.approx(4.17e-5, rel=1e-3)
    assert log_rank(PLACEBO, TREATED).chi_square == pytest.approx(test.chi_square)


def test_the_log_rank_test_agrees_with_scipy() -> None:
    data = [stats.CensoredData([t.time for t in s if t.has_succeeded],
                               right=[t.time for t in s if not t.has_succeeded])
            for s in (TREATED, PLACEBO)]  # fmt: skip
    theirs = stats.logrank(*data)
    ours = log_rank(TREATED, PLACEBO)
    assert ours.chi_square == pytest.approx(theirs.statistic**2)
    assert ours.p == pytest.approx(theirs.pvalue)


@pytest.mark.parametrize(("n_ok", "n"), [(0, 5), (3, 5), (5, 5), (9, 12)])
def test_with_one_time_limit_the_curve_ends_at_the_exact_interval_of_the_rate(
    n_ok: int, n: int
) -> None:
    curve = success_curve(succeeded(*range(1, n_ok + 1)) + censored(*[60.0] * (n - n_ok)))
    assert curve is not None
    for k, (share, low, high) in enumerate(
        zip(curve.shares[: n_ok + 1], curve.lows, curve.highs, strict=False)
    ):
        expected = rate(k, n)
        assert expected is not None
        assert (share, low, high) == pytest.approx((k / n, expected.low, expected.high))


@pytest.mark.parametrize("n", [6, 9, 20])
def test_without_censoring_the_limits_of_the_median_are_order_statistics(n: int) -> None:
    curve = success_curve(succeeded(*range(1, n + 1)))
    assert curve is not None
    expected = median_interval([(t, t) for t in range(1, n + 1)])
    assert (curve.median.low, curve.median.high) == (expected.low, expected.high)


def test_the_beta_product_with_censoring_is_that_of_a_simulation() -> None:
    rng = np.random.Generator(np.random.Philox(4))
    factors = {6: (21, 3), 7: (17, 1), 10: (15, 1), 13: (12, 1)}  # week: left, successes
    product = np.ones(200_000)
    for left, events in factors.values():
        product *= rng.beta(left - events + 1, events, len(product))
    upper = np.quantile(product, 0.975)
    lower = np.quantile(product * rng.beta(11, 1, len(product)), 0.025)
    curve = success_curve(TREATED)
    assert curve is not None
    k = curve.times.index(13)
    assert (1 - curve.highs[k], 1 - curve.lows[k]) == pytest.approx((lower, upper), abs=3e-3)


def test_a_trial_that_failed_for_good_lowers_the_curve_to_its_end() -> None:
    trials = succeeded(10.0, 20.0)
    failed = success_curve([*trials, *censored(math.inf, math.inf)])
    stopped = success_curve([*trials, *censored(5.0, 5.0)])
    assert failed is not None
    assert stopped is not None
    assert failed.shares[-1] == 0.5
    assert stopped.shares[-1] == 1.0  # nothing is known about these two after 5 s


def test_less_than_half_has_no_median() -> None:
    curve = success_curve(succeeded(3.0) + censored(9.0, 9.0, 9.0))
    assert curve is not None
    assert (curve.median.value, curve.median.high) == (None, math.inf)
    assert success_curve([]) is None


def test_log_rank_scores_sum_to_observed_minus_expected() -> None:
    first, second = succeeded(3, 5, 8) + censored(9), succeeded(4, 6) + censored(9, 9)
    pooled = [*first, *second]
    scores = []
    for trial in pooled:
        hazard = sum(
            1 / sum(other.time >= event.time for other in pooled)
            for event in pooled
            if event.has_succeeded and event.time <= trial.time
        )
        scores.append(trial.has_succeeded - hazard)
    test = log_rank(first, second)
    assert sum(scores[:4]) == pytest.approx(test.n_successes - test.expected_successes)
    differences = [a - b for a, b in zip(scores[:4], scores[4:], strict=True)]
    assert paired_log_rank(first, second) == sign_flip(differences)


def test_the_paired_test_sees_a_difference_that_seeds_hide() -> None:
    """The seeds differ much more than the algorithms: only the pairs show who is faster."""
    base = [5.0 * 1.6**k for k in range(8)]
    slow = succeeded(*[1.2 * t for t in base])
    fast = succeeded(*base)
    assert log_rank(fast, slow).p > 0.5
    assert paired_log_rank(fast, slow) == pytest.approx(2 / 2**8)


def test_impossible_times_are_errors() -> None:
    with pytest.raises(ValueError, match="expected a finite number of at least 0"):
        TrialTime(time=math.inf, has_succeeded=True)
    with pytest.raises(ValueError, match="expected a finite number of at least 0"):
        TrialTime(time=-1.0, has_succeeded=False)
    with pytest.raises(ValueError, match="expected pairs"):
        paired_log_rank(succeeded(1.0), [])
