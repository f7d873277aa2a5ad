"""The confidence interval of a success rate."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Rate:
    """A success rate and its confidence limits."""

    n: int
    """The number of trials, at least 1."""
    successes: int
    """The number of successes."""
    low: float
    """The lower limit, 0 to 1."""
    high: float
    """The upper limit, 0 to 1."""

    @property
    def value(self) -> float:
        """The fraction of successes, 0 to 1."""
        return self.successes / self.n


def rate(successes: int, n: int, *, confidence: float = 0.95) -> Rate | None:
    r"""Return the fraction of k successes in n trials, with its exact limits; None without trials.

    The limits are those of Clopper and Pearson (1934). At the lower limit, k or more successes have
    the probability :math:`\alpha/2`, and at the upper limit k or fewer successes, with
    :math:`\alpha = 1 -` ``confidence``. They are quantiles of beta distributions,

    .. math:: B^{-1}_{\alpha/2}(k, n-k+1), \qquad B^{-1}_{1-\alpha/2}(k+1, n-k)

    The interval contains the true rate with a probability of *at least* ``confidence``, for most
    rates with a higher one: it is conservative.
    """
    from scipy.special import betaincinv

    if n == 0:
        return None
    tail = (1 - confidence) / 2
    low = float(betaincinv(successes, n - successes + 1, tail)) if successes > 0 else 0.0
    high = float(betaincinv(successes + 1, n - successes, 1 - tail)) if successes < n else 1.0
    return Rate(n=n, successes=successes, low=low, high=high)
