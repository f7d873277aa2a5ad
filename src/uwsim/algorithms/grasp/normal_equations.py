"""The solution of small normal equations in compiled code."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit


@njit
def cholesky_solve(normal: Array, right: Array) -> Array:
    """Solve ``normal @ x = right`` (n,) for a positive definite matrix ``normal`` (n, n)."""
    n = len(right)
    lower = np.zeros((n, n))
    for i in range(n):
        for j in range(i + 1):
            total = normal[i, j]
            for k in range(j):
                total -= lower[i, k] * lower[j, k]
            lower[i, j] = math.sqrt(max(total, 1e-12)) if i == j else total / lower[j, j]
    x = right.copy()
    for i in range(n):
        for k in range(i):
            x[i] -= lower[i, k] * x[k]
        x[i] /= lower[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            x[i] -= lower[k, i] * x[k]
        x[i] /= lower[i, i]
    return x
