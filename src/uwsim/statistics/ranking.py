"""Ranks of several algorithms over tasks, with ties and intervals, and Bradley-Terry strengths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.rng import stream
from .holm import holm
from .paired import sign_flip

N_RANK_RESAMPLES = 10_000
"""The number of resamples of the seeds."""
MAX_ITERATIONS = 10_000
"""The greatest number of iterations for the strengths."""
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
    low: int
    """The best place within the interval over resampled seeds."""
    high: int
    """The worst place within the interval over resampled seeds."""
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
      over all seeds and tasks, each divided by the number of seeds of its task. The p-values of all
      pairs are corrected by Holm's method. ``n_better`` counts the algorithms with a higher score
      and a corrected p up to ``alpha``. The probability that any of these statements is false is
      at most ``alpha``. With few seeds no difference can be shown, and all algorithms share rank 1.
    - *Interval.* In each task the seeds are drawn with replacement, the same for all algorithms.
      ``low`` and ``high`` are percentiles of the place over `N_RANK_RESAMPLES` resamples. The
      places of algorithms that are nearly equal vary from resample to resample. For few seeds the
      interval is too narrow (Hall and Miller 2009, *Ann. Statist.* 37, 3929).

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
    resampled_places = _places(_resampled_totals(arrays))  # (n_algorithms, N_RANK_RESAMPLES)
    tail = (1 - confidence) / 2
    low = np.quantile(resampled_places, tail, axis=1, method="lower")
    high = np.quantile(resampled_places, 1 - tail, axis=1, method="higher")
    is_better = _shown_better(arrays, totals, alpha)
    return tuple(
        Rank(
            score=float(totals[i]),
            place=int(place),
            low=int(low[i]),
            high=int(high[i]),
            n_better=int(is_better[:, i].sum()),
            n_worse=int(is_better[i].sum()),
        )
        for i, place in enumerate(_places(totals[:, np.newaxis])[:, 0])
    )


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
    p_values = holm(
        [
            sign_flip(np.concatenate([(s[i] - s[j]) / s.shape[1] for s in tasks]).tolist())
            for i, j in pairs
        ]
    )
    is_better = np.zeros((n, n), dtype=np.bool_)
    for (i, j), p in zip(pairs, p_values, strict=True):
        if p is not None and p <= alpha:
            winner, loser = (i, j) if totals[i] > totals[j] else (j, i)
            is_better[winner, loser] = True
    return is_better
