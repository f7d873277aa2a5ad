"""The exactly rounded sum of numbers in compiled code, equal to `math.fsum`."""

from __future__ import annotations

import numpy as np

from .jit import njit
from .linear import Array


@njit
def exact_sum(values: Array) -> float:
    """Return the sum of finite numbers, (n,), as if it were computed exactly and then rounded.

    The sum is stored in partial sums that do not overlap (J. R. Shewchuk, *Adaptive Precision
    Floating-Point Arithmetic and Fast Robust Geometric Predicates*, Discrete & Computational
    Geometry 18, 1997). Sums beyond the greatest float are not supported.
    """
    partials, n = np.empty(len(values)), 0
    for number in values:
        x, n_partials = number, 0
        for i in range(n):
            y = partials[i]
            if abs(x) < abs(y):
                x, y = y, x
            high = x + y
            low = y - (high - x)
            if low != 0.0:
                partials[n_partials] = low
                n_partials += 1
            x = high
        n = n_partials
        if x != 0.0:
            partials[n] = x
            n += 1
    if n == 0:
        return 0.0
    n -= 1
    total, low = partials[n], 0.0
    while n > 0:
        n -= 1
        x, y = total, partials[n]
        total = x + y
        low = y - (total - x)
        if low != 0.0:
            break
    if n > 0 and low * partials[n - 1] > 0.0:  # the rest is more than half of the last digit
        double_low = 2.0 * low
        rounded_sum = total + double_low
        if double_low == rounded_sum - total:
            total = rounded_sum
    result: float = total
    return result
