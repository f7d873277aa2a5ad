"""Number of repeats for a wanted power: planning, not inference."""

from __future__ import annotations

import math

from .paired import fewest_for

MAX_REPEATS = 100_000
"""More repeats than these are not counted."""


def power(n: int, d: float, alpha: float = 0.05) -> float:
    r"""Return the probability that n pairs show a true effect :math:`d_z` of size d.

    Two-sided, by the paired t-test (Cohen 1988): with :math:`t_c` the quantile
    :math:`1 - \alpha/2` of Student's t with n - 1 degrees of freedom,

    .. math:: 1 - T_{n-1}(t_c;\, d\sqrt n) + T_{n-1}(-t_c;\, d\sqrt n)

    where T is the noncentral distribution. The sign-flip test is as powerful but for its steps.
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


def repeats_needed(d: float, *, alpha: float = 0.05, wanted: float = 0.8) -> int | None:
    """Return the least number of pairs that shows an effect of size d with power ``wanted``.

    Never fewer than the sign-flip test needs to reach ``alpha`` at all (`fewest_for`); None where
    that takes more than `MAX_REPEATS`, as it does without an effect.
    """
    low, high = 1, max(2, fewest_for(alpha))
    if power(high, d, alpha) >= wanted:
        return high
    while power(high, d, alpha) < wanted:
        low, high = high, 2 * high
        if low > MAX_REPEATS:
            return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if power(middle, d, alpha) >= wanted else (middle, high)
    return high if high <= MAX_REPEATS else None
