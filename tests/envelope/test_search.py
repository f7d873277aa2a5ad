"""The search for a breaking point, on runs that are drawn instead of played."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from uwsim.envelope import Range, Search, search
from uwsim.statistics import median_interval

WHERE = Range(start=0.0, stop=1.3, tolerance=0.01)


class Runs:
    """Answers as a law says, and remembers what it was asked."""

    def __init__(self, breaks: Callable[[int, float], bool]) -> None:
        self.breaks = breaks
        self.made: dict[tuple[int, float], bool] = {}

    def ask(self, wanted: Sequence[tuple[int, float]]) -> list[bool]:
        for key in wanted:
            if key not in self.made:
                self.made[key] = bool(self.breaks(*key))
        return [self.made[key] for key in wanted]


def found(breaks: Callable[[int, float], bool], n: int = 10, where: Range = WHERE) -> Search:
    return search(range(n), where, Runs(breaks).ask)


def brackets(result: Search) -> list[tuple[float, float]]:
    return [
        (
            -math.inf if one.hold_level is None else one.hold_level,
            math.inf if one.break_level is None else one.break_level,
        )
        for one in result.thresholds
    ]


@pytest.mark.parametrize("point", [0.004, 0.1234, 0.65, 1.2999])
def test_a_sharp_point_lies_in_the_bracket_of_every_seed(point: float) -> None:
    runs = Runs(lambda seed, level: level >= point)
    result = search(range(10), WHERE, runs.ask)
    assert all(low < point <= high <= low + 0.0101 for low, high in brackets(result))
    assert len(runs.made) <= 9 + 10 * (WHERE.max_cuts() + 1)
    assert all(0.0 <= level <= 1.3 and round(level, 3) == level for _, level in runs.made)
    assert result.reversal is None


def test_each_seed_has_a_point_of_its_own() -> None:
    result = found(lambda seed, level: level > 0.5 + 0.05 * seed, 6)
    middles = [(low + high) / 2 for low, high in brackets(result)]
    assert middles == pytest.approx([0.5 + 0.05 * seed for seed in range(6)], abs=0.006)


def test_a_range_may_fall() -> None:
    where = Range(start=1.0, stop=0.2, tolerance=0.02)
    result = found(lambda seed, level: level < 0.43, 3, where)
    assert all(one.break_level < 0.43 <= one.hold_level for one in result.thresholds)
    assert all(one.hold_level - one.break_level <= 0.0201 for one in result.thresholds)


def test_what_never_breaks_costs_a_run_a_seed_and_is_open_above() -> None:
    runs = Runs(lambda seed, level: False)
    result = search(range(10), WHERE, runs.ask)
    assert brackets(result) == [(1.3, math.inf)] * 10
    assert len(runs.made) == 9 + 9


def test_what_is_broken_from_the_start_is_open_below() -> None:
    assert brackets(found(lambda seed, level: True)) == [(-math.inf, 0.0)] * 10


def test_seeds_that_never_break_stand_beside_those_that_do() -> None:
    result = found(lambda seed, level: level > 0.7 and seed % 2 == 0)
    assert sum(high == math.inf for _, high in brackets(result)) == 5
    result = found(lambda seed, level: level > 0.7 and seed % 2 == 1)
    assert sum(high == math.inf for _, high in brackets(result)) == 5


def test_a_criterion_that_goes_back_is_warned_of_and_its_first_point_found() -> None:
    result = found(lambda seed, level: 0.4 < level < 0.9 or level > 1.2)
    assert result.reversal is not None
    assert (result.reversal.break_level, result.reversal.hold_level) == (0.488, 1.137)
    assert (result.reversal.n, result.reversal.n_broken, result.reversal.n_held) == (10, 10, 10)
    assert all(low <= 0.4 < high for low, high in brackets(result))


def test_one_stray_run_is_no_reversal() -> None:
    result = found(lambda seed, level: level > 0.8 or (seed == 0 and level == 0.325))
    assert result.reversal is None
    assert all(low <= 0.8 < high for low, high in brackets(result))


def test_the_same_seeds_search_alike() -> None:
    one, other = (Runs(lambda seed, level: level > 0.5) for _ in "ab")
    search(range(4), WHERE, one.ask)
    search(range(4), WHERE, other.ask)
    assert list(one.made) == list(other.made)


def coverage(width: float, lapse: float, n: int, n_sets: int) -> float:
    """Share of searches whose interval holds the true point of a logistic curve."""
    hits = 0
    for number in range(n_sets):
        chance = np.random.default_rng([7, number])
        point = float(chance.uniform(0.3, 1.0))

        def breaks(seed: int, level: float, at: float = point, draw: object = chance) -> bool:
            bend = max(-500.0, min(500.0, (level - at) / width)) if width else 0.0
            share = 1.0 / (1.0 + math.exp(-bend)) if width else float(level >= at)
            return chance.random() < lapse + (1.0 - 2.0 * lapse) * share  # noqa: B023

        result = search(range(100 * number, 100 * number + n), WHERE, Runs(breaks).ask)
        limits = median_interval(brackets(result))
        assert limits.low is not None
        assert limits.high is not None
        hits += limits.low <= point <= limits.high
    return hits / n_sets


@pytest.mark.parametrize(
    ("width", "lapse", "n"), [(0.0, 0.0, 6), (0.02, 0.0, 10), (0.06, 0.0, 10), (0.06, 0.05, 10)]
)
def test_the_bound_holds_the_true_point_as_often_as_promised(
    width: float, lapse: float, n: int
) -> None:
    # of 200 searches at 95 %, 183 or fewer hits have a chance of 2 %; these cover 97 to 100 %
    assert coverage(width, lapse, n, 200) > 0.92


@pytest.mark.slow
@pytest.mark.parametrize("n", [6, 10, 20])
@pytest.mark.parametrize("lapse", [0.0, 0.05])
@pytest.mark.parametrize("width", [0.0, 0.02, 0.06])
def test_it_does_so_for_every_curve_of_the_page(width: float, lapse: float, n: int) -> None:
    assert coverage(width, lapse, n, 1000) >= 0.945
