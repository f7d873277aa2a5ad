"""Ranks of several algorithms over tasks, with ties and intervals, and Bradley-Terry strengths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.rng import stream
from .holm import holm
from .paired import min_p_value, min_pairs, sign_flip

N_RANK_RESAMPLES = 10_000
"""The number of resamples of the seeds."""
MAX_ITERATIONS = 10_000
"""The greatest number of iterations for the strengths."""
MIN_SEEDS_OF_PLACES = 6
"""The number of seeds of each task from which an interval of the place is stated."""
EQUAL_SCORES = 1e-9
"""The difference, as a share of the largest absolute score, up to which scores are equal [1]."""

Scores = npt.NDArray[np.float64]
"""The scores of a task, (n_algorithms, n_seeds): a higher score is better."""


@dataclass(frozen=True, kw_only=True)
class Rank:
    """The rank of one algorithm among several."""

    score: float
    """The mean over the tasks of the mean score over the seeds."""
    place: int
    """1 plus the number of algorithms with a higher score; equal scores share a place."""
    low: int | None
    """The best place within the interval over resampled seeds; None for too few seeds."""
    high: int | None
    """The worst place within the interval over resampled seeds; None for too few seeds."""
    n_better: int
    """The number of algorithms that are shown to be better."""
    n_worse: int
    """The number of algorithms that are shown to be worse."""

    @property
    def rank(self) -> int:
        """1 plus the number of algorithms that are shown to be better: ties share a rank."""
        return 1 + self.n_better


def paired_ranks(
    tasks: Sequence[Scores], *, confidence: float = 0.95, alpha: float = 0.05
) -> tuple[Rank, ...]:
    r"""Rank algorithms that ran the same seeds of the same tasks.

    The score of an algorithm is the mean over the tasks of its mean over the seeds, so all tasks
    have the same weight. There are two statements on its rank:

    - *Ties.* For each pair of algorithms, a sign-flip test of the sum of the paired differences
      over all seeds and tasks, each divided by the number of seeds of its task. A unit is a seed of
      a task: the tasks are given, and the seeds of different tasks are independent draws, so each
      unit has a sign of its own. If one algorithm is better in some tasks and worse in others, and
      the sum is 0, the test shows a difference less often than ``alpha``. The p-values of all pairs
      are corrected by Holm's method; pairs that differ in too few units to reach ``alpha`` are not
      counted (Tarone 1990, *Biometrics* 46, 515). ``n_better`` counts the algorithms with a higher
      score and a corrected p up to ``alpha``. The probability that any of these statements is
      false is at most ``alpha``. With few units no difference can be shown, and all algorithms
      share rank 1 (`seeds_to_rank`).
    - *Interval.* In each task the seeds are drawn with replacement, the same for all algorithms.
      ``low`` and ``high`` are percentiles of the place over `N_RANK_RESAMPLES` resamples. The
      places of algorithms that are nearly equal vary from resample to resample. For few seeds the
      interval is too narrow (Hall and Miller 2009, *Ann. Statist.* 37, 3929). It is None for tasks
      of fewer than `MIN_SEEDS_OF_PLACES` seeds, and if no pair can be separated.

    Args:
        tasks: the scores of each task, (n_algorithms, n_seeds); the seeds may differ between tasks.
        confidence: the share of the resamples within the interval, at least.
        alpha: the significance level of the ties.

    Raises:
        ValueError: there is no task, algorithm or seed, or the numbers of algorithms differ.
    """
    arrays = [np.asarray(scores, dtype=np.float64) for scores in tasks]
    if not arrays or any(a.ndim != 2 or 0 in a.shape or len(a) != len(arrays[0]) for a in arrays):
        shapes = ", ".join(str(array.shape) for array in arrays) or "no task"
        raise ValueError(f"scores of {shapes}: expected (n_algorithms, n_seeds) for each task")
    totals = np.mean([array.mean(axis=1) for array in arrays], axis=0)  # (n_algorithms,)
    is_better = _shown_better(arrays, totals, alpha)
    n_seeds = [array.shape[1] for array in arrays]
    has_places = min(n_seeds) >= MIN_SEEDS_OF_PLACES and (
        bool(is_better.any()) or sum(n_seeds) >= _units_to_rank(len(totals), alpha)
    )
    intervals = _place_intervals(arrays, confidence) if has_places else [(None, None)] * len(totals)
    return tuple(
        Rank(
            score=float(totals[i]),
            place=int(place),
            low=intervals[i][0],
            high=intervals[i][1],
            n_better=int(is_better[:, i].sum()),
            n_worse=int(is_better[i].sum()),
        )
        for i, place in enumerate(_places(totals[:, np.newaxis])[:, 0])
    )


def seeds_to_rank(n_algorithms: int, n_tasks: int = 1, *, alpha: float = 0.05) -> int:
    r"""Return the least number of seeds of each task from which ranks can differ.

    The smallest p of a sign-flip test of n units is :math:`2/2^n`, and the first step of Holm's
    method multiplies it by the number of pairs :math:`k(k-1)/2` of k algorithms. A unit is a seed
    of a task. From n seeds on, an algorithm that is better in each unit can be shown to be better.

    Args:
        n_algorithms: the number k of algorithms.
        n_tasks: the number of tasks, all with the same number of seeds.
        alpha: the significance level of the ties.
    """
    return -(-_units_to_rank(n_algorithms, alpha) // n_tasks)


def _units_to_rank(n_algorithms: int, alpha: float) -> int:
    """Return the least number of units at which a difference of two algorithms can be shown."""
    return min_pairs(alpha / max(1, n_algorithms * (n_algorithms - 1) // 2))


@dataclass(frozen=True, kw_only=True)
class Strength:
    """The strength of one algorithm after the model of Bradley and Terry."""

    value: float
    """The natural logarithm of the strength; the mean over all algorithms is 0."""
    standard_error: float
    """The standard error of the value."""


def bradley_terry(
    wins: npt.NDArray[np.float64], *, prior_games: float = 1.0
) -> tuple[Strength, ...]:
    r"""Return the strengths of algorithms from the numbers of wins between each two.

    In the model of Bradley and Terry (1952, *Biometrika* 39, 324), i wins against j with the
    probability :math:`1 / (1 + e^{\beta_j - \beta_i})`. The strengths :math:`\beta` maximise the
    likelihood (iteration of Hunter 2004, *Ann. Statist.* 32, 384); the standard errors follow from
    the information matrix on the plane :math:`\sum \beta = 0`. Each pair also plays ``prior_games``
    games that end in a draw. This keeps an algorithm that wins always at a finite strength.

    Use it across tasks, a game being a task. Games of equal seeds of one task are not independent,
    and the standard errors would be too small.

    Args:
        wins: the number of games that i wins against j, (n, n); a draw is half a win of both.
        prior_games: the number of drawn games that are added to each pair.

    Raises:
        ValueError: the matrix is not square, or has a negative number.
    """
    counts = np.array(wins, dtype=np.float64)
    n = len(counts)
    if counts.shape != (n, n) or (counts < 0.0).any():
        raise ValueError(f"wins of shape {counts.shape}: expected (n, n) numbers of at least 0")
    counts += prior_games / 2
    np.fill_diagonal(counts, 0.0)
    games, total_wins = counts + counts.T, counts.sum(axis=1)
    strengths = np.ones(n)
    for _ in range(MAX_ITERATIONS):
        sums = (games / (strengths[:, np.newaxis] + strengths)).sum(axis=1)
        new_strengths = total_wins / np.where(sums > 0.0, sums, 1.0) if n > 1 else strengths
        new_strengths = new_strengths / np.exp(np.log(new_strengths).mean())
        is_converged = bool(np.allclose(new_strengths, strengths, rtol=1e-12, atol=0.0))
        strengths = new_strengths
        if is_converged:
            break
    values = np.log(strengths)
    probabilities = 1 / (1 + np.exp(values - values[:, np.newaxis]))  # of a win of i against j
    information = -games * probabilities * probabilities.T
    information -= np.diag(information.sum(axis=1))
    errors = np.sqrt(np.diag(np.linalg.pinv(information)).clip(0.0))
    return tuple(
        Strength(value=float(value), standard_error=float(error))
        for value, error in zip(values, errors, strict=True)
    )


def count_wins(tasks: Sequence[Scores]) -> npt.NDArray[np.float64]:
    """Return the number of tasks in which i has a higher mean score than j, (n, n).

    Tasks with equal means count half for both. These are the games of `bradley_terry`.
    """
    means = np.array([np.asarray(scores).mean(axis=1) for scores in tasks])  # (n_tasks, n)
    tolerance = EQUAL_SCORES * np.abs(means).max(initial=0.0)
    differences = means[:, :, np.newaxis] - means[:, np.newaxis, :]
    wins: npt.NDArray[np.float64] = (
        (differences > tolerance) + 0.5 * (np.abs(differences) <= tolerance)
    ).sum(axis=0)
    np.fill_diagonal(wins, 0.0)
    return wins


def _place_intervals(tasks: Sequence[Scores], confidence: float) -> list[tuple[int, int]]:
    """Return the interval of the place of each algorithm over resampled seeds."""
    places = _places(_resampled_totals(tasks))  # (n_algorithms, N_RANK_RESAMPLES)
    tail = (1 - confidence) / 2
    low = np.quantile(places, tail, axis=1, method="lower")
    high = np.quantile(places, 1 - tail, axis=1, method="higher")
    return [
        (int(low_place), int(high_place)) for low_place, high_place in zip(low, high, strict=True)
    ]


def _resampled_totals(tasks: Sequence[Scores]) -> Scores:
    """Return the score of each algorithm in each resample, (n_algorithms, N_RANK_RESAMPLES)."""
    totals = np.zeros((len(tasks[0]), N_RANK_RESAMPLES))
    for i, scores in enumerate(tasks):
        n = scores.shape[1]
        rng = stream(0, f"statistics/ranks/{i}/{n}")
        counts = rng.multinomial(n, np.full(n, 1 / n), size=N_RANK_RESAMPLES)
        totals += scores @ counts.T / (n * len(tasks))
    return totals


def _places(totals: Scores) -> npt.NDArray[np.int64]:
    """Return 1 plus the number of higher scores in each column, (n_algorithms, n)."""
    tolerance = EQUAL_SCORES * np.abs(totals).max(initial=0.0)
    places = np.ones(totals.shape, dtype=np.int64)
    for other in totals:
        places += other > totals + tolerance
    return places


def _shown_better(tasks: Sequence[Scores], totals: Scores, alpha: float) -> npt.NDArray[np.bool_]:
    """Return whether algorithm i is shown to be better than j, (n, n)."""
    n = len(totals)
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
    p_values = holm([paired_p([(s[i], s[j]) for s in tasks], alpha) for i, j in pairs])
    is_better = np.zeros((n, n), dtype=np.bool_)
    for (i, j), p in zip(pairs, p_values, strict=True):
        if p is not None and p <= alpha:
            winner, loser = (i, j) if totals[i] > totals[j] else (j, i)
            is_better[winner, loser] = True
    return is_better


def paired_p(tasks: Sequence[tuple[Scores, Scores]], alpha: float) -> float | None:
    """Return the p-value of equal scores of two algorithms over tasks of equal weight.

    A unit is a seed of a task, with a sign of its own (`paired_ranks`). The p-value is None if too
    few units differ for any p up to ``alpha``.

    Args:
        tasks: the scores of both in each task, each of shape (n_seeds,).
        alpha: the significance level.
    """
    differences = np.concatenate([(first - second) / len(first) for first, second in tasks])
    if min_p_value(int(np.count_nonzero(differences))) > alpha:
        return None
    return sign_flip(differences.tolist())
