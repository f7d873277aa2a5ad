"""The QR decomposition of many tall matrices, compiled: the same bytes on every processor."""

from __future__ import annotations

import math

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from ..base.numerics.memory import Floats


def compute_triangles(matrices: Array) -> Array:
    """Return the triangle R of each matrix, by Householder reflections.

    Args:
        matrices: the matrices, (k, m, n).

    Returns:
        The triangles, (k, n, n), whose diagonals may have any sign. With less rows than columns,
        the last rows are 0.
    """
    k, _, n = matrices.shape
    columns = np.ascontiguousarray(np.swapaxes(matrices, 1, 2))
    triangles = np.zeros((k, n, n))
    _reflect_all(columns, triangles)
    return triangles


@njit
def _reflect_all(columns: Floats, triangles: Floats) -> None:
    for i in range(len(columns)):
        _reflect(columns[i])
        n, m = columns.shape[1], columns.shape[2]
        for column in range(n):
            for row in range(min(column + 1, m)):
                triangles[i, row, column] = columns[i, column, row]


@njit
def _reflect(columns: Floats) -> None:
    """Replace a matrix, stored column by column, by its triangle; below it are leftovers."""
    n, m = columns.shape
    for k in range(min(n, m)):
        size = 0.0
        for i in range(k, m):
            size += columns[k, i] * columns[k, i]
        if size == 0.0:
            continue
        size = math.sqrt(size)
        first = columns[k, k]
        pivot = -size if first > 0.0 else size
        head = first - pivot  # the first element of the reflection vector
        scale = 1.0 / (pivot * head)
        for j in range(k + 1, n):
            total = head * columns[j, k]
            for i in range(k + 1, m):
                total += columns[k, i] * columns[j, i]
            total *= scale
            columns[j, k] += total * head
            for i in range(k + 1, m):
                columns[j, i] += total * columns[k, i]
        columns[k, k] = pivot
