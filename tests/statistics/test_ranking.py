"""Ranks over tasks against closed forms of resampling, and strengths against those of two games."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from uwsim.statistics import bradley_terry, count_wins, paired_ranks
from uwsim.statistics.ranking import _places, _resampled_totals


def test_places_and_the_scores_weigh_tasks_equally() -> None:
    short = np.array([[1.0, 1.0], [0.0, 0.0], [0.0, 0.0]])
    long = np.array([[0.0] * 6, [1.0] * 6, [0.5] * 6])
    first, second, third = paired_ranks([short, long])
    assert (first.score, second.score, third.score) == (0.5, 0.5, 0.25)
    assert (first.place, second.place, third.place) == (1, 1, 3)  # equal scores share a place


def test_the_resampled_order_of_two_has_the_probability_of_a_binomial() -> None:
    """Of n seeds, k favour the first by 1 and the others the second: ahead if Bin(n, k/n) > n/2."""
    scores = np.array([[1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0]])
    places = _places(_resampled_totals([scores]))
    expected = stats.binom.sf(3, 7, 4 / 7)
    assert np.mean(places[0] == 1) == pytest.approx(expected, abs=0.02)
    first, second = paired_ranks([scores])
    assert (first.place, first.low, first.high) == (1, 1, 2)
    assert (second.place, second.low, second.high) == (2, 1, 2)


def test_pairs_separate_what_the_seeds_vary() -> None:
    """Each seed shifts both by up to 100; one is better by 1 in each: its rank is certain."""
    seeds = np.linspace(0.0, 100.0, 8)
    first, second = paired_ranks([np.array([seeds, seeds + 1.0])])
    assert (second.place, second.low, second.high, second.rank) == (1, 1, 1, 1)
    assert (first.place, first.low, first.high, first.rank) == (2, 2, 2, 2)
    assert (second.n_worse, first.n_better) == (1, 1)


def test_too_few_seeds_tie() -> None:
    """The p of 5 pairs is at least 2 / 2^5 > 0.05."""
    scores = np.array([np.ones(5), np.zeros(5)])
    first, second = paired_ranks([scores])
    assert (first.rank, second.rank) == (1, 1)
    assert (first.place, second.place) == (1, 2)
    tasks = paired_ranks([scores, scores])  # ten pairs of two tasks
    assert [rank.rank for rank in tasks] == [1, 2]


def test_equal_algorithms_share_everything() -> None:
    ranks = paired_ranks([np.full((3, 4), 0.1)])
    assert {(rank.place, rank.low, rank.high, rank.rank) for rank in ranks} == {(1, 1, 1, 1)}


def test_other_shapes_are_errors() -> None:
    with pytest.raises(ValueError, match="no task: expected"):
        paired_ranks([])
    with pytest.raises(ValueError, match=r"\(2, 0\): expected"):
        paired_ranks([np.zeros((2, 0))])
    with pytest.raises(ValueError, match=r"\(2, 3\), \(3, 3\): expected"):
        paired_ranks([np.zeros((2, 3)), np.zeros((3, 3))])


def test_two_strengths_are_the_log_odds_of_their_games() -> None:
    first, second = bradley_terry(np.array([[0.0, 12.0], [3.0, 0.0]]), prior_games=0.0)
    assert first.value - second.value == pytest.approx(math.log(12 / 3))
    assert first.value + second.value == pytest.approx(0.0, abs=1e-12)
    # The variance of log odds is 1/12 + 1/3; a half of the difference is the value.
    assert first.standard_error == pytest.approx(math.sqrt(1 / 12 + 1 / 3) / 2)
    always, never = bradley_terry(np.array([[0.0, 4.0], [0.0, 0.0]]))
    assert always.value - never.value == pytest.approx(math.log(4.5 / 0.5))


def test_strengths_that_explain_the_games_exactly_are_found() -> None:
    values = np.array([0.9, 0.2, -0.3, -0.8])
    wins = 10 / (1 + np.exp(values - values[:, np.newaxis]))
    found = bradley_terry(wins, prior_games=0.0)
    assert [strength.value for strength in found] == pytest.approx(values.tolist(), abs=1e-9)
    assert [strength.value for strength in bradley_terry(np.zeros((1, 1)))] == [0.0]
    with pytest.raises(ValueError, match="expected"):
        bradley_terry(np.zeros((2, 3)))


def test_games_are_tasks_and_a_draw_is_half_a_win() -> None:
    wins = count_wins([np.array([[1.0, 0.0], [0.2, 0.2]]), np.array([[0.3], [0.3]])])
    assert wins.tolist() == [[0.0, 1.5], [0.5, 0.0]]
