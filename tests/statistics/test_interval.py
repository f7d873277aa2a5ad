"""The interval of a mean: what it is, and how often it contains the truth."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from uwsim.base.rng import stream
from uwsim.statistics import Interval, mean_interval

SLEEP = [1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4]
"""Student 1908: hours of sleep gained by ten patients."""


def limits(interval: Interval) -> tuple[float, float]:
    assert interval.low is not None
    assert interval.high is not None
    return interval.low, interval.high


def test_one_value_has_a_mean_and_no_limits_and_none_has_nothing() -> None:
    one, none = mean_interval([3.0]), mean_interval([])
    assert (one.n, one.mean, one.std, one.low, one.high) == (1, 3.0, None, None, None)
    assert (none.n, none.mean, none.std) == (0, None, None)


def test_values_without_spread_have_limits_without_width() -> None:
    assert limits(mean_interval([0.1] * 7)) == pytest.approx((0.1, 0.1), abs=1e-15)
    assert limits(mean_interval([0.0] * 3)) == (0.0, 0.0)


def test_the_limits_are_quantiles_of_a_smoothed_bootstrap_t_drawn_one_by_one() -> None:
    values = np.array(SLEEP)
    n, mean, std = len(values), values.mean(), values.std(ddof=1)
    random = np.random.Generator(np.random.Philox(5))
    found = []
    for _ in range(40_000):
        resample = random.choice(values, n) + random.normal(0.0, std / math.sqrt(n), n)
        found.append((resample.mean() - mean) / (resample.std(ddof=1) / math.sqrt(n)))
    low, high = np.quantile(found, [0.025, 0.975])
    scale = std / math.sqrt(n)
    assert limits(mean_interval(SLEEP)) == pytest.approx(
        (mean - high * scale, mean - low * scale), abs=0.03 * std
    )


def test_a_long_tail_above_reaches_further_than_student_says_and_less_far_below() -> None:
    low, high = limits(mean_interval(SLEEP))
    student = stats.t.interval(0.95, 9, np.mean(SLEEP), stats.sem(SLEEP))  # 0.7001 to 2.4599
    assert 0.7 < low < 1.58 < 2.46 < high < 3.5
    assert low > student[0]
    assert high > student[1]


def test_many_values_have_students_interval() -> None:
    values = stream(1, "many").normal(2.0, 3.0, 300)
    expected = stats.t.interval(0.95, 299, values.mean(), stats.sem(values))
    assert limits(mean_interval(values.tolist())) == pytest.approx(expected, rel=1e-12)


def test_between_the_two_methods_there_is_no_step() -> None:
    values = stream(2, "step").normal(0.0, 1.0, 201)
    low, high = limits(mean_interval(values[:200].tolist()))
    student = stats.t.interval(0.95, 199, values[:200].mean(), stats.sem(values[:200]))
    assert (low, high) == pytest.approx(student, abs=0.03 * (student[1] - student[0]))


@pytest.mark.parametrize("n", [2, 3, 5, 12])
def test_limits_move_with_the_values_scale_with_them_and_are_mirrored_with_them(n: int) -> None:
    values = stream(3, f"moved/{n}").lognormal(0.0, 1.0, n).tolist()
    low, high = limits(mean_interval(values))
    assert limits(mean_interval([7.0 + 3.0 * v for v in values])) == pytest.approx(
        (7.0 + 3.0 * low, 7.0 + 3.0 * high), rel=1e-12
    )
    assert limits(mean_interval([-v for v in values])) == pytest.approx((-high, -low), rel=1e-12)


def test_the_order_of_the_values_and_other_draws_change_no_bit() -> None:
    first = mean_interval(SLEEP)
    mean_interval([1.0, 2.0, 4.0])
    assert mean_interval(SLEEP[::-1]) == first


def test_less_confidence_is_less_width() -> None:
    (a, b), (c, d) = limits(mean_interval(SLEEP)), limits(mean_interval(SLEEP, confidence=0.8))
    assert a < c < d < b


def test_an_outlier_among_few_does_not_make_the_limits_absurd() -> None:
    low, high = limits(mean_interval([1.0, 1.01, 0.99, 1.02, 5.0]))
    assert -2.0 < low < 1.8
    assert 2.5 < high < 8.0


def test_very_large_values_do_not_overflow() -> None:
    low, high = limits(mean_interval([1e200, 2e200, 4e200]))
    assert math.isfinite(low)
    assert math.isfinite(high)


# ---------------------------------------------------------------------------- coverage

N_SETS = 3000
"""Three standard errors of a coverage of 95 % are then 1.2 %."""


def coverage(name: str, n: int) -> float:
    """Share of data sets whose interval contains the true mean."""
    random = stream(0, f"coverage/{name}/{n}")
    if name == "normal":
        sets, truth = random.normal(2.0, 3.0, (N_SETS, n)), 2.0
    elif name == "exponential":
        sets, truth = random.exponential(1.0, (N_SETS, n)), 1.0
    else:
        sigma = float(name.removeprefix("log-normal "))
        sets, truth = random.lognormal(0.0, sigma, (N_SETS, n)), math.exp(sigma**2 / 2)
    found = [limits(mean_interval(values)) for values in sets.tolist()]
    return sum(low <= truth <= high for low, high in found) / N_SETS


@pytest.mark.slow
@pytest.mark.parametrize("n", [3, 5, 10, 20, 30])
@pytest.mark.parametrize("name", ["normal", "log-normal 0.25"])
def test_of_100_intervals_93_to_97_contain_the_truth_whatever_the_number_of_values(
    name: str, n: int
) -> None:
    assert 0.93 <= coverage(name, n) <= 0.97


@pytest.mark.slow
@pytest.mark.parametrize("n", [10, 20, 30])
@pytest.mark.parametrize("name", ["log-normal 0.5", "exponential"])
def test_of_skewed_values_93_of_100_intervals_contain_the_truth_from_ten_values_on(
    name: str, n: int
) -> None:
    assert 0.93 <= coverage(name, n) <= 0.97


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "n", "least"),
    [
        ("log-normal 0.5", 5, 0.915), ("exponential", 5, 0.90), ("log-normal 1", 5, 0.85),
        ("log-normal 1", 10, 0.88), ("log-normal 1", 30, 0.91),
    ],
)  # fmt: skip
def test_outside_the_promise_intervals_fall_short_by_as_much_as_is_documented(
    name: str, n: int, least: float
) -> None:
    assert least <= coverage(name, n) < 0.94
