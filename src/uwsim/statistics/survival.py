"""The time to success of trials that may end without one: Kaplan-Meier curves, log-rank tests."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .median import Median
from .paired import sign_flip


@dataclass(frozen=True, kw_only=True)
class TrialTime:
    """The time at which a trial succeeded, or up to which it was observed without success."""

    time: float
    """The time of the success or of the end of the observation (censoring), in any unit, at least
    0. It is infinite for a trial that failed, and could not have succeeded later."""
    has_succeeded: bool
    """True if ``time`` is that of the success; False if the trial is censored."""

    def __post_init__(self) -> None:
        if not self.time >= 0.0 or (self.has_succeeded and math.isinf(self.time)):
            raise ValueError(f"time {self.time!r}: expected a finite number of at least 0")


@dataclass(frozen=True, kw_only=True)
class SuccessCurve:
    """The share of trials that succeed up to each time, with its confidence limits."""

    n: int
    """The number of trials, at least 1."""
    n_successes: int
    """The number of trials that succeeded."""
    times: tuple[float, ...]
    """0, and the finite times of successes and censoring, in ascending order, each once (k,)."""
    shares: tuple[float, ...]
    """The estimated share that succeeds up to each of the times, 0 to 1 (k,)."""
    lows: tuple[float, ...]
    """The lower limit of the share from each time to the next (k,)."""
    highs: tuple[float, ...]
    """The upper limit of the share from each time to the next (k,)."""
    median: Median
    """The time up to which half of the trials succeed, with its confidence limits."""


def success_curve(trials: Sequence[TrialTime], *, confidence: float = 0.95) -> SuccessCurve | None:
    r"""Return the share of trials that succeed up to each time; None without trials.

    The share is :math:`1 - \hat S(t)` with the estimate of Kaplan and Meier (1958, *J. Am. Stat.
    Assoc.* 53, 457)

    .. math:: \hat S(t) = \prod_{t_j \le t} \Bigl(1 - \frac{d_j}{Y_j}\Bigr)

    where :math:`d_j` trials succeed at the time :math:`t_j`, and :math:`Y_j` are still without
    success, and observed, just before. If no trial is censored before the last success, it is the
    plain fraction of the trials that have succeeded.

    The limits are those of the beta product (Fay, Brittain and Proschan 2013, *Biostatistics* 14,
    723). The upper limit of S(t) is a quantile of :math:`\prod B(Y_j - d_j + 1, d_j)` over the
    times up to t. For the lower limit there is one more factor, :math:`B(Y, 1)`, with the number Y
    of trials that remain after t. Each product is approximated by the beta distribution with its
    mean and variance. Without censoring the limits are the exact ones of `uwsim.statistics.rate`.

    The median is the first time at which the share is 1/2 or more. Its limits are the first times
    at which the upper and the lower limit of the share are 1/2 or more (Brookmeyer and Crowley
    1982). Without censoring they are the order statistics of `uwsim.statistics.median_interval`.

    *Not modelled*: censoring that depends on how near the success was. A trial that failed for good
    is no such case if its time is infinite: it then counts as never successful.
    """
    if not trials:
        return None
    times = sorted({0.0, *(trial.time for trial in trials if math.isfinite(trial.time))})
    tail = (1 - confidence) / 2
    survival, first_moment, second_moment = 1.0, 1.0, 1.0
    n_left = len(trials)
    steps: list[tuple[float, float, float, float]] = []
    for time in times:
        n_events = sum(trial.has_succeeded for trial in trials if trial.time == time)
        a, total = n_left - n_events + 1, n_left + 1
        survival *= 1 - n_events / n_left
        first_moment *= a / total
        second_moment *= a * (a + 1) / (total * (total + 1))
        n_left = sum(trial.time > time for trial in trials)
        steps.append(
            (time, 1 - survival, *_share_limits(first_moment, second_moment, n_left, tail))
        )
    median_time, low, high = (_first_half(steps, column) for column in (1, 3, 2))
    return SuccessCurve(
        n=len(trials),
        n_successes=sum(trial.has_succeeded for trial in trials),
        times=tuple(times),
        shares=tuple(share for _, share, _, _ in steps),
        lows=tuple(low for _, _, low, _ in steps),
        highs=tuple(high for _, _, _, high in steps),
        median=Median(
            n=len(trials),
            value=median_time if math.isfinite(median_time) else None,
            low=low,
            high=high,
            confidence=confidence,
        ),
    )


@dataclass(frozen=True, kw_only=True)
class LogRank:
    """The result of a log-rank test of two samples."""

    n_successes: int
    """The number of successes in the first sample."""
    expected_successes: float
    """The number of successes in the first sample that are expected if the samples are alike."""
    chi_square: float
    """The statistic, chi-square with one degree of freedom; 0 without a success."""
    p: float
    """The p-value; it is asymptotic, for ten or more successes."""


def log_rank(first: Sequence[TrialTime], second: Sequence[TrialTime]) -> LogRank:
    r"""Compare the times to success of two samples that are not paired, by the log-rank test.

    At the time :math:`t_j` of a success, :math:`Y_j` trials are left, :math:`Y_{1j}` of them in the
    first sample, and :math:`d_j` succeed. The statistic is

    .. math::

        \chi^2 = \frac{\bigl(\sum_j d_{1j} - d_j Y_{1j}/Y_j\bigr)^2}
        {\sum_j d_j \frac{Y_{1j}}{Y_j} \bigl(1 - \frac{Y_{1j}}{Y_j}\bigr) \frac{Y_j - d_j}{Y_j - 1}}

    (Mantel 1966; Peto and Peto 1972). Use `paired_log_rank` for two algorithms under equal seeds.
    """
    from scipy.special import chdtrc

    n_successes, expectation, variance = 0, 0.0, 0.0
    for time in sorted({trial.time for trial in (*first, *second) if trial.has_succeeded}):
        n_first = sum(trial.time >= time for trial in first)
        n = n_first + sum(trial.time >= time for trial in second)
        first_events = sum(trial.has_succeeded and trial.time == time for trial in first)
        events = first_events + sum(trial.has_succeeded and trial.time == time for trial in second)
        share = n_first / n
        n_successes += first_events
        expectation += events * share
        if n > 1:
            variance += events * share * (1 - share) * (n - events) / (n - 1)
    chi_square = (n_successes - expectation) ** 2 / variance if variance > 0.0 else 0.0
    return LogRank(
        n_successes=n_successes,
        expected_successes=expectation,
        chi_square=chi_square,
        p=float(chdtrc(1, chi_square)),
    )


def paired_log_rank(first: Sequence[TrialTime], second: Sequence[TrialTime]) -> float | None:
    r"""Return the two-sided p-value of the log-rank test of paired trials; None without pairs.

    Each trial of both samples has its log-rank score :math:`\delta - \hat\Lambda(t)`: 1 for a
    success or 0, minus the estimate of Nelson and Aalen of the cumulative hazard in the pooled
    sample. The sum of the scores of the first sample is successes minus the expected ones of
    `log_rank`. If neither algorithm is better, the two trials of a pair can be exchanged. p is
    therefore that of the sign-flip test of the differences of their scores
    (`uwsim.statistics.sign_flip`). It needs no large sample, and uses the pairs (O'Brien and
    Fleming 1987, *Biometrics* 43, 169, with other scores).

    Args:
        first: the trials of the first algorithm.
        second: the trials of the second algorithm, of the same seeds in the same order.
    """
    if len(first) != len(second):
        raise ValueError(f"{len(first)} and {len(second)} trials: expected pairs")
    all_trials = (*first, *second)
    times = np.array([trial.time for trial in all_trials])
    events = np.array([trial.has_succeeded for trial in all_trials])
    hazards = np.array([1.0 / np.count_nonzero(times >= time) for time in times])
    cumulative = np.array([hazards[events & (times <= time)].sum() for time in times])
    scores = events - cumulative
    return sign_flip((scores[: len(first)] - scores[len(first) :]).tolist())


def _share_limits(
    first_moment: float, second_moment: float, n_left: int, tail: float
) -> tuple[float, float]:
    """Return the limits of the share that has succeeded, from the moments of the beta product."""
    from scipy.special import betaincinv

    low, high = 0.0, 1.0
    if first_moment < 1.0:
        low = 1.0 - float(betaincinv(*_beta_parameters(first_moment, second_moment), 1 - tail))
    if n_left:
        mean, square = first_moment * n_left / (n_left + 1), second_moment * n_left / (n_left + 2)
        high = 1.0 - float(betaincinv(*_beta_parameters(mean, square), tail))
    return low, high


def _beta_parameters(mean: float, square: float) -> tuple[float, float]:
    """Return the parameters of the beta distribution with this mean and mean square."""
    total = (mean - square) / (square - mean * mean)
    return mean * total, (1 - mean) * total


def _first_half(steps: Sequence[tuple[float, float, float, float]], column: int) -> float:
    """Return the first time at which a column of the steps is 1/2 or more; else infinity."""
    return next((step[0] for step in steps if step[column] >= 0.5 - 1e-12), math.inf)
