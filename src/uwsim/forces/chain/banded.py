"""The solution of linear equations with a symmetric, positive definite band matrix."""

from __future__ import annotations

from ...base.geometry import Array
from ...base.numerics.jit import njit


@njit
def solve_banded(band: Array, right: Array) -> None:
    """Solve A x = b in place by the factors L D L^T.

    Golub and Van Loan, Matrix Computations, 4th ed., 4.3.5, with the factors of 4.1.2.

    Args:
        band: the lower part of A by columns, ``band[j, k] = A[j + k, j]``, (n, w + 1). It receives
            the factors.
        right: the right side b, (n,). It receives the solution.
    """
    n, width = band.shape
    for j in range(n):
        pivot = band[j, 0]
        reach = min(width, n - j)
        for k in range(1, reach):
            factor = band[j, k] / pivot
            for i in range(k, reach):
                band[j + k, i - k] -= factor * band[j, i]
            right[j + k] -= factor * right[j]
        for k in range(1, reach):
            band[j, k] /= pivot
    for j in range(n - 1, -1, -1):
        total = right[j] / band[j, 0]
        for k in range(1, min(width, n - j)):
            total -= band[j, k] * right[j + k]
        right[j] = total
