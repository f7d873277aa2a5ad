"""Intervals against published numbers."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.benchmark.interval import (
    binomial_interval,
    mean_interval,
    per_level,
    rows_by_level,
)
from uwsim.benchmark.result import Column, Missing, Result


def test_students_own_sleep_data_has_the_published_interval() -> None:
    # Student 1908; R: t.test(extra ~ group, data = sleep, paired = TRUE) -> 0.7001142 2.4598858
    hours = [1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4]
    interval = mean_interval(hours)
    assert interval.mean == pytest.approx(1.58, abs=1e-12)
    assert interval.low == pytest.approx(0.7001142, abs=5e-8)
    assert interval.high == pytest.approx(2.4598858, abs=5e-8)


def test_mendels_peas_have_the_published_interval() -> None:
    # R: binom.test(682, 682 + 243) -> 0.7076683 0.7654066
    assert binomial_interval(682, 925) == pytest.approx((0.7076683, 0.7654066), abs=5e-8)


def test_never_and_always_are_not_certainty() -> None:
    assert binomial_interval(0, 10) == pytest.approx((0.0, 1 - 0.025**0.1), abs=1e-12)
    assert binomial_interval(10, 10) == pytest.approx((0.025**0.1, 1.0), abs=1e-12)
    assert binomial_interval(0, 0) is None


def test_one_value_has_a_mean_and_no_limits_and_none_has_nothing() -> None:
    one, none = mean_interval([3.0]), mean_interval([])
    assert (one.n, one.mean, one.low, one.half) == (1, 3.0, None, None)
    assert (none.n, none.mean, none.std) == (0, None, None)


def test_the_interval_contains_the_truth_in_95_of_100_cases() -> None:
    draws = np.random.Generator(np.random.Philox(1)).normal(2.0, 3.0, (2000, 4))
    hits = 0
    for draw in draws.tolist():
        interval = mean_interval(draw)
        assert interval.low is not None
        assert interval.high is not None
        hits += interval.low < 2.0 < interval.high
    assert 0.93 < hits / 2000 < 0.97


def test_repeats_are_gathered_by_level_and_what_is_missing_is_counted() -> None:
    result = Result(
        inputs={},
        run={},
        columns=(
            Column(name="seed", kind="run"),
            Column(name="fog", kind="level", unit="1/m"),
            Column(name="corners", kind="measure", unit="px"),
            Column(name="status", kind="status"),
        ),
        rows=(
            (1, 0.0, 2.0, "ok"),
            (1, 0.5, 8.0, "ok"),
            (2, 0.0, 4.0, "ok"),
            (2, 0.5, None, "lost"),
        ),
        missing=(Missing(row=3, column="corners", why="lost at 3 s"),),
    )
    clear, foggy = per_level(result, "corners")
    assert rows_by_level(result) == {(0.0,): [0, 2], (0.5,): [1, 3]}
    assert (clear.interval.n, clear.interval.mean, clear.n_missing) == (2, 3.0, 0)
    assert (foggy.interval.n, foggy.interval.mean, foggy.n_missing) == (1, 8.0, 1)
    assert foggy.why == "lost at 3 s"
