"""Power analysis: the number of repeats that a planned comparison needs."""

from __future__ import annotations

import math

from .paired import min_pairs

MAX_REPEATS = 100_000
"""The greatest number of repeats that is planned."""


def power(n: int, d: float, alpha: float = 0.05) -> float:
    r"""Return the probability that a test of n pairs detects an effect of the size d.

    It is the power of the two-sided paired t-test at the level :math:`\alpha` (Cohen 1988),

    .. math:: 1 - T_{n-1}(t_c;\, d\sqrt n) + T_{n-1}(-t_c;\, d\sqrt n)

    where :math:`t_c` is the quantile :math:`1 - \alpha/2` of Student's t with n - 1 degrees of
    freedom, and T the distribution function of the noncentral t. The power of the sign-flip test is
    about the same.

    Args:
        n: the number of pairs.
        d: the true effect size :math:`d_z` (`uwsim.statistics.cohens_d`).
        alpha: the significance level.
    """
    from scipy.special import ncfdtr, stdtrit

    if n < 2:
        return 0.0
    shift = abs(d) * math.sqrt(n)
    critical = float(stdtrit(n - 1, 1 - alpha / 2))
    if shift - critical > 30:
        return 1.0
    # The square of a noncentral t is a noncentral F; nctdtr gives NaN for large shifts.
    return 1 - float(ncfdtr(1, n - 1, shift * shift, critical * critical))


def repeats_needed(d: float, *, alpha: float = 0.05, target_power: float = 0.8) -> int | None:
    """Return the minimum number of pairs for which the test has the power ``target_power``.

    It is at least the number of pairs for which the sign-flip test can reach ``alpha``
    (`min_pairs`). The result is None if more than `MAX_REPEATS` pairs are needed, as for d = 0.

    Args:
        d: the true effect size (`power`).
        alpha: the significance level.
        target_power: the required probability of detecting the effect.
    """
    low, high = 1, max(2, min_pairs(alpha))
    if power(high, d, alpha) >= target_power:
        return high
    while power(high, d, alpha) < target_power:
        low, high = high, 2 * high
        if low > MAX_REPEATS:
            return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if power(middle, d, alpha) >= target_power else (middle, high)
    return high if high <= MAX_REPEATS else None
