"""Confidence interval of a success rate."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from uwsim.statistics import rate


def test_mendels_peas_have_the_published_interval() -> None:
    # R: binom.test(682, 682 + 243) -> 0.7076683 0.7654066
    found = rate(682, 925)
    assert found is not None
    assert (found.low, found.high) == pytest.approx((0.7076683, 0.7654066), abs=5e-8)
    assert found.value == 682 / 925


@pytest.mark.parametrize(("k", "n"), [(0, 5), (1, 5), (3, 10), (10, 10), (29, 30)])
def test_the_limits_are_scipys(k: int, n: int) -> None:
    found = rate(k, n, confidence=0.9)
    theirs = stats.binomtest(k, n).proportion_ci(0.9, method="exact")
    assert found is not None
    assert (found.low, found.high) == pytest.approx((theirs.low, theirs.high), abs=1e-12)


def test_never_and_always_are_not_certainty_and_no_trial_says_nothing() -> None:
    never, always = rate(0, 10), rate(10, 10)
    assert never is not None
    assert always is not None
    assert (never.low, never.high) == pytest.approx((0.0, 1 - 0.025**0.1), abs=1e-12)
    assert (always.low, always.high) == pytest.approx((0.025**0.1, 1.0), abs=1e-12)
    assert rate(0, 0) is None


@pytest.mark.parametrize(("n", "on_average"), [(5, 0.985), (10, 0.98), (20, 0.975), (30, 0.97)])
def test_the_limits_contain_every_rate_in_95_cases_of_100_or_more(
    n: int, on_average: float
) -> None:
    found = [rate(k, n) for k in range(n + 1)]
    limits = [(r.low, r.high) for r in found if r is not None]
    rates = np.linspace(0.005, 0.995, 199)
    coverage = np.zeros(len(rates))
    for k, (low, high) in enumerate(limits):
        coverage += stats.binom.pmf(k, n, rates) * ((low <= rates) & (rates <= high))
    assert coverage.min() >= 0.95
    assert coverage.mean() == pytest.approx(on_average, abs=0.006)
