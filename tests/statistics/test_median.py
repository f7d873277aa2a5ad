"""The median of what is known between limits, and its exact interval."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from uwsim.statistics import median_interval, min_values_for_median


def points(values: list[float]) -> list[tuple[float, float]]:
    return [(value, value) for value in values]


@pytest.mark.parametrize(
    ("n", "rank", "confidence"),
    [(6, 1, 1 - 2 / 64), (8, 1, 1 - 2 / 256), (9, 2, 1 - 20 / 512), (10, 2, 1 - 22 / 1024)],
)
def test_the_limits_are_the_order_statistics_of_the_tables(
    n: int, rank: int, confidence: float
) -> None:
    found = median_interval(points([float(i) for i in range(1, n + 1)]))
    assert (found.low, found.high) == (float(rank), float(n + 1 - rank))
    assert found.confidence == pytest.approx(confidence)
    assert found.value == (n + 1) / 2


@pytest.mark.parametrize("n", range(6, 41))
@pytest.mark.parametrize("confidence", [0.9, 0.95, 0.99])
def test_they_are_those_of_an_independent_library(n: int, confidence: float) -> None:
    values = np.random.default_rng(n).normal(size=n).tolist()
    theirs = stats.quantile_test(values, p=0.5).confidence_interval(confidence)
    ours = median_interval(points(values), confidence=confidence)
    if ours.low is None:
        assert not (math.isfinite(theirs.low) and math.isfinite(theirs.high))
    else:
        assert (ours.low, ours.high) == (theirs.low, theirs.high)


def test_too_few_values_have_no_limits_and_the_fewest_are_known() -> None:
    assert median_interval(points([1.0, 2.0, 4.0])).low is None
    assert median_interval(points([1.0, 2.0, 4.0])).value == 2.0
    assert [min_values_for_median(c) for c in (0.5, 0.9, 0.95, 0.99)] == [2, 5, 6, 8]
    assert median_interval(points([1.0] * 5), confidence=0.9375).low == 1.0
    with pytest.raises(ValueError, match="at least one"):
        median_interval([])


def test_brackets_give_limits_that_lie_outside() -> None:
    found = median_interval([(i - 0.25, i + 0.25) for i in range(1, 11)])
    assert (found.value, found.low, found.high) == (5.5, 1.75, 9.25)


def test_values_beyond_reach_count_without_being_known() -> None:
    inside = [(float(i), float(i)) for i in range(7)]
    found = median_interval([*inside, *[(9.0, math.inf)] * 3])
    assert (found.value, found.low, found.high) == (4.5, 1.0, math.inf)
    found = median_interval([*inside[:4], *[(9.0, math.inf)] * 6])
    assert (found.value, found.low, found.high) == (None, 1.0, math.inf)
    assert median_interval([(-math.inf, 0.0)] * 6).value is None
