r"""The confidence interval of a mean, by the smoothed bootstrap-t method."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.rng import stream

N_RESAMPLES = 10_000
"""The number of resamples, which are the same for all data with the same number of values."""
MAX_BOOTSTRAP_VALUES = 200
"""The number of values above which Student's interval is used, which then differs little."""


@dataclass(frozen=True, kw_only=True)
class Interval:
    """A mean and its confidence interval."""

    n: int
    """The number of values."""
    mean: float | None
    """The arithmetic mean, in the values' unit; None without values."""
    std: float | None
    """The standard deviation of the sample (n - 1); None for fewer than two values."""
    low: float | None
    """The lower limit; None for fewer than two values."""
    high: float | None
    """The upper limit; None for fewer than two values. The limits are not symmetric about the
    mean."""


def mean_interval(values: Sequence[float], *, confidence: float = 0.95) -> Interval:
    r"""Return the mean and its two-sided smoothed bootstrap-t interval.

    .. math::

        \Bigl[\bar x - t^*_{1-\alpha/2}\, s/\sqrt n,\; \bar x - t^*_{\alpha/2}\, s/\sqrt n\Bigr],
        \qquad t^* = \frac{\bar x^* - \bar x}{s^*/\sqrt n}

    (Efron 1982, section 10.10; Hall 1988), with the mean :math:`\bar x`, the standard deviation
    :math:`s` and :math:`\alpha = 1 -` ``confidence``. A resample :math:`x^*` has the same size as
    the sample; to every value in it, a normal error of the variance :math:`s^2/n` is added
    (Hesterberg 2004). Resamples then vary as much as samples, they never consist of equal values,
    and the limits are finite from two values on. Above `MAX_BOOTSTRAP_VALUES` values, the quantiles
    of :math:`t^*` are those of Student's t.

    The coverage was measured (``docs/statistics.md``): 95 % for any number of normal values, at
    least 93 % for 10 or more values with a skewness up to 2. For distributions with long tails it
    is below ``confidence``.

    The limits do not depend on the order of the values; values of opposite sign have limits of
    opposite sign.
    """
    n = len(values)
    if n == 0:
        return Interval(n=0, mean=None, std=None, low=None, high=None)
    mean = math.fsum(values) / n
    if n == 1:
        return Interval(n=1, mean=mean, std=None, low=None, high=None)
    std = math.hypot(*(v - mean for v in values)) / math.sqrt(n - 1)
    if std <= 1e-14 * abs(mean):
        return Interval(n=n, mean=mean, std=std, low=mean, high=mean)
    z_scores = np.array(sorted((v - mean) / std for v in values))
    low, high = _quantiles(z_scores, (1 - confidence) / 2)
    scale = std / math.sqrt(n)
    return Interval(n=n, mean=mean, std=std, low=mean - high * scale, high=mean - low * scale)


def _quantiles(z_scores: npt.NDArray[np.float64], tail: float) -> tuple[float, float]:
    """Return the quantiles ``tail`` and ``1 - tail`` of t* for sorted z-scores (n,)."""
    from scipy.special import stdtrit

    n = len(z_scores)
    if n > MAX_BOOTSTRAP_VALUES:
        quantile = float(stdtrit(n - 1, 1 - tail))
        return -quantile, quantile
    resamples = _resamples(n)
    mean = resamples.mean_error / math.sqrt(n)  # (N_RESAMPLES,)
    square = resamples.square_error / n
    for i, z in enumerate(z_scores.tolist()):
        mean = mean + z * resamples.shares[i]
        square = square + z * z * resamples.shares[i] + 2 * z / math.sqrt(n) * resamples.errors[i]
    t = np.sort(mean / np.sqrt((square - mean * mean) / (n - 1)))
    k = max(1, round((len(t) + 1) * tail))
    return float(t[k - 1]), float(t[-k])


@dataclass(frozen=True, eq=False, kw_only=True)
class _Resamples:
    """The resamples of n values, in the terms in which any data have their mean and mean square.

    The unit of errors is the standard deviation of the values divided by the root of n.
    """

    shares: npt.NDArray[np.float64]
    """The number of times that each value is drawn, divided by n, (n, N_RESAMPLES)."""
    errors: npt.NDArray[np.float64]
    """The sum of the errors that are added to each value, divided by n, (n, N_RESAMPLES)."""
    mean_error: npt.NDArray[np.float64]
    """The mean of the errors in each resample, (N_RESAMPLES,)."""
    square_error: npt.NDArray[np.float64]
    """The mean of the squared errors in each resample, (N_RESAMPLES,)."""


@functools.lru_cache(maxsize=4)
def _resamples(n: int) -> _Resamples:
    """Draw half of the resamples; the other half are their mirror images.

    Values of opposite sign then have limits of opposite sign.
    """
    rng = stream(0, f"statistics/bootstrap/{n}")
    half = N_RESAMPLES // 2
    draws = rng.integers(0, n, (n, half))
    error = rng.standard_normal((n, half))
    draws = np.concatenate([draws, n - 1 - draws], axis=1)
    error = np.concatenate([error, -error], axis=1)
    cells = (draws * N_RESAMPLES + np.arange(N_RESAMPLES)).ravel()
    counts = np.bincount(cells, minlength=n * N_RESAMPLES).reshape(n, N_RESAMPLES)
    sums = np.bincount(cells, weights=error.ravel(), minlength=n * N_RESAMPLES)
    return _Resamples(
        shares=counts / n,
        errors=sums.reshape(n, N_RESAMPLES) / n,
        mean_error=error.mean(axis=0),
        square_error=(error * error).mean(axis=0),
    )
