"""Small linear algebra whose results have the same bytes on every processor.

BLAS and LAPACK, which numpy's ``@``, ``dot`` and ``linalg`` call, choose their code by the
processor. Two machines add in different orders, and in minutes of tracking a difference of 1e-16
grows to a pixel. Code that computes numbers of a result uses the loops of this module, whose order
is fixed; ``tests/test_same_bytes.py`` lists the modules that may call BLAS and LAPACK.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from .jit import njit

Array = npt.NDArray[np.float64]
SWEEPS = 60
"""The greatest number of sweeps of Jacobi's method, which needs ten at most."""


def product(left: npt.ArrayLike, right: npt.ArrayLike) -> Array:
    """Return ``left @ right`` of matrices, vectors, or stacks of matrices along the first axis."""
    a = np.ascontiguousarray(left, dtype=np.float64)
    b = np.ascontiguousarray(right, dtype=np.float64)
    if a.ndim == 1:
        return product(b.swapaxes(-1, -2), a)
    if a.shape[-1] != b.shape[-2 if b.ndim > 1 else 0]:
        raise ValueError(f"{a.shape} and {b.shape} cannot be multiplied")
    if a.ndim == 2 and b.ndim == 2:
        return multiply_matrices(a, b)
    if b.ndim == 3:
        return _multiply_stacks(a[None] if a.ndim == 2 else a, b)
    columns = b[:, None] if b.ndim == 1 else b
    matrix = multiply_matrices(a.reshape(math.prod(a.shape[:-1]), a.shape[-1]), columns)
    return matrix.reshape(a.shape[:-1] + b.shape[1:])


@njit
def rotate(rotation: Array, vector: Array) -> Array:
    """Return ``rotation @ vector`` for (3, 3) and (3,)."""
    rotated_vector = np.empty(3)
    for i in range(3):
        rotated_vector[i] = (
            rotation[i, 0] * vector[0] + rotation[i, 1] * vector[1] + rotation[i, 2] * vector[2]
        )
    return rotated_vector


@njit
def rotate_back(rotation: Array, vector: Array) -> Array:
    """Return ``rotation.T @ vector`` for (3, 3) and (3,)."""
    rotated_vector = np.empty(3)
    for i in range(3):
        rotated_vector[i] = (
            rotation[0, i] * vector[0] + rotation[1, i] * vector[1] + rotation[2, i] * vector[2]
        )
    return rotated_vector


@njit
def rotate_rows(rotation: Array, vectors: Array) -> Array:
    """Return ``vectors @ rotation.T`` for (3, 3) and (n, 3), with the bytes of `product`."""
    return multiply_matrices(vectors, rotation.T.copy())


@njit
def cross(left: Array, right: Array) -> Array:
    """Return the vector product of (3,) and (3,)."""
    vector = np.empty(3)
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        vector[i] = left[j] * right[k] - left[k] * right[j]
    return vector


def dot(left: Array, right: Array) -> float:
    """Return the sum of the products of the components of two vectors, first to last."""
    total = 0.0
    for x, y in zip(left.tolist(), right.tolist(), strict=True):
        total += x * y
    return total


def length(vector: npt.ArrayLike) -> float:
    """Return the Euclidean length of a vector."""
    components = np.asarray(vector, dtype=np.float64)
    return math.sqrt(dot(components, components))


def determinant(matrix: Array) -> float:
    """Return the determinant of a matrix (3, 3)."""
    return float(determinants(matrix[None])[0])


def determinants(matrices: Array) -> Array:
    """Return the determinants of matrices (n, 3, 3), (n,)."""
    (a, b, c), (d, e, f), (g, h, i) = matrices.transpose(1, 2, 0)
    values: Array = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return values


def solve(matrix: Array, right: Array) -> Array:
    """Return x of ``matrix @ x = right`` for (n, n) and (n,) or (n, m), by elimination.

    Raises:
        numpy.linalg.LinAlgError: the matrix is singular.
    """
    columns = right if right.ndim == 2 else right[:, None]
    solution, is_regular = eliminate(matrix.astype(np.float64), columns.astype(np.float64))
    if not is_regular:
        raise np.linalg.LinAlgError("Singular matrix")
    return solution if right.ndim == 2 else solution[:, 0]


def inverse(matrix: Array) -> Array:
    """Return the inverse of a matrix (n, n), or of each matrix of a stack (..., n, n).

    Raises:
        numpy.linalg.LinAlgError: a matrix is singular.
    """
    stack = np.array(matrix, dtype=np.float64, ndmin=3)
    inverses, are_regular = _invert_all(stack.reshape(-1, *matrix.shape[-2:]))
    if not are_regular:
        raise np.linalg.LinAlgError("Singular matrix")
    return inverses.reshape(matrix.shape)


def singular_values(matrix: Array) -> Array:
    """Return the singular values of a matrix (m, n), largest first, (min(m, n),)."""
    return _decompose(matrix)[1]


def rank(matrix: Array) -> int:
    """Return the number of singular values above the rounding error, as numpy counts them."""
    values = singular_values(matrix)
    threshold = values.max(initial=0.0) * max(matrix.shape) * np.finfo(np.float64).eps
    return int(np.sum(values > threshold))


def pseudo_inverse(matrix: Array, *, rcond: float) -> Array:
    """Return the Moore-Penrose inverse (n, m) of a matrix (m, n).

    Singular values up to ``rcond`` times the largest count as zero.
    """
    left, values, right = _decompose(matrix)
    is_used = values > rcond * values.max(initial=0.0)
    return product(right[:, is_used] / values[is_used], left[:, is_used].T)


def _decompose(matrix: Array) -> tuple[Array, Array, Array]:
    """Return ``matrix = left @ diag(values) @ right.T`` by Jacobi's one-sided method (Hestenes)."""
    is_wide = matrix.shape[0] < matrix.shape[1]
    columns = np.array(matrix.T if is_wide else matrix, dtype=np.float64, order="C")
    rotation = np.eye(columns.shape[1])
    _rotate_until_orthogonal(columns, rotation)
    values = np.linalg.norm(columns, axis=0)
    order = np.argsort(-values, kind="stable")
    values, columns, rotation = values[order], columns[:, order], rotation[:, order]
    unit_columns = np.divide(columns, values, out=np.zeros_like(columns), where=values > 0.0)
    return (rotation, values, unit_columns) if is_wide else (unit_columns, values, rotation)


@njit
def world_positions(
    origins: Array, axes: Array, bodies: npt.NDArray[np.int64], points: Array
) -> Array:
    """Return the world positions of one point on each of some bodies, (n, 3).

    Args:
        origins: the origins of all bodies, (m, 3).
        axes: the axes of all bodies, (m, 3, 3).
        bodies: the indices of the bodies, (n,).
        points: the points in the axes of their bodies, (n, 3).
    """
    positions = np.empty((len(bodies), 3))
    for row in range(len(bodies)):
        body = bodies[row]
        for i in range(3):
            positions[row, i] = (
                origins[body, i]
                + axes[body, i, 0] * points[row, 0]
                + axes[body, i, 1] * points[row, 1]
                + axes[body, i, 2] * points[row, 2]
            )
    return positions


@njit
def multiply_matrices(a: Array, b: Array) -> Array:
    """Return ``a @ b`` of two matrices, row by row.

    The inner loop is along the rows of ``b`` if these are long.
    """
    matrix = np.zeros((a.shape[0], b.shape[1]))
    if b.shape[1] > 3:
        for i in range(a.shape[0]):
            for j in range(a.shape[1]):
                for k in range(b.shape[1]):
                    matrix[i, k] += a[i, j] * b[j, k]
        return matrix
    if b.shape == (3, 3):  # as below, with the three sums of a row in one loop
        for i in range(a.shape[0]):
            x, y, z = a[i, 0], a[i, 1], a[i, 2]
            for k in range(3):
                matrix[i, k] = 0.0 + x * b[0, k] + y * b[1, k] + z * b[2, k]
        return matrix
    for i in range(a.shape[0]):
        for k in range(b.shape[1]):
            total = 0.0
            for j in range(a.shape[1]):
                total += a[i, j] * b[j, k]
            matrix[i, k] = total
    return matrix


@njit
def _multiply_stacks(a: Array, b: Array) -> Array:
    """Return the products of (n, i, j) and (n, j, k); a stack of one matrix is used for all n."""
    n = max(a.shape[0], b.shape[0])
    products = np.empty((n, a.shape[1], b.shape[2]))
    for m in range(n):
        left = a[m if a.shape[0] > 1 else 0]
        right = b[m if b.shape[0] > 1 else 0]
        for i in range(left.shape[0]):
            for k in range(right.shape[1]):
                total = 0.0
                for j in range(left.shape[1]):
                    total += left[i, j] * right[j, k]
                products[m, i, k] = total
    return products


@njit
def compose(r_a: Array, p_a: Array, r_b: Array, p_b: Array) -> tuple[Array, Array]:
    """Return the position and rotation of ``a_from_b @ b_from_c``; r: rotations, p: positions."""
    rotation, position = np.empty((3, 3)), np.empty(3)
    for i in range(3):
        x, y, z = r_a[i, 0], r_a[i, 1], r_a[i, 2]
        for k in range(3):
            rotation[i, k] = x * r_b[0, k] + y * r_b[1, k] + z * r_b[2, k]
        position[i] = x * p_b[0] + y * p_b[1] + z * p_b[2] + p_a[i]
    return position, rotation


@njit
def transform_points(points: Array, rotation: Array, position: Array) -> Array:
    """Return ``points @ rotation.T + position`` for (n, 3)."""
    rows = np.empty((points.shape[0], 3))
    for n in range(points.shape[0]):
        x, y, z = points[n, 0], points[n, 1], points[n, 2]
        for i in range(3):
            rows[n, i] = rotation[i, 0] * x + rotation[i, 1] * y + rotation[i, 2] * z + position[i]
    return rows


@njit
def eliminate(a: Array, b: Array) -> tuple[Array, bool]:
    """Eliminate with partial pivoting; overwrite both, return the solution and its existence."""
    n, m = b.shape
    for column in range(n):
        pivot = column
        for row in range(column + 1, n):
            if abs(a[row, column]) > abs(a[pivot, column]):
                pivot = row
        if a[pivot, column] == 0.0:
            return b, False
        for k in range(n):
            a[column, k], a[pivot, k] = a[pivot, k], a[column, k]
        for k in range(m):
            b[column, k], b[pivot, k] = b[pivot, k], b[column, k]
        for row in range(column + 1, n):
            factor = a[row, column] / a[column, column]
            for k in range(column, n):
                a[row, k] -= factor * a[column, k]
            for k in range(m):
                b[row, k] -= factor * b[column, k]
    for column in range(n - 1, -1, -1):
        for k in range(m):
            for row in range(column + 1, n):
                b[column, k] -= a[column, row] * b[row, k]
            b[column, k] /= a[column, column]
    return b, True


@njit
def invert(matrix: Array, output: Array) -> bool:
    """Write the inverse of a matrix (n, n) to ``output``; return False if it is singular."""
    inverse, is_regular = eliminate(matrix.copy(), np.eye(matrix.shape[0]))
    output[:] = inverse
    return is_regular


@njit
def _invert_all(matrices: Array) -> tuple[Array, bool]:
    """Return the inverses of (n, k, k), which are overwritten, and whether all are regular."""
    inverses, are_regular = np.empty(matrices.shape), True
    for i in range(matrices.shape[0]):
        inverse, is_regular = eliminate(matrices[i], np.eye(matrices.shape[1]))
        inverses[i] = inverse
        are_regular = are_regular and is_regular
    return inverses, are_regular


@njit
def _rotate_until_orthogonal(a: Array, rotation: Array) -> None:
    """Rotate pairs of columns of ``a`` (m, n) and ``rotation`` (n, n) until all are orthogonal."""
    m, n = a.shape
    for _ in range(SWEEPS):
        is_done = True
        for i in range(n - 1):
            for j in range(i + 1, n):
                square_i, square_j, product = 0.0, 0.0, 0.0
                for k in range(m):
                    square_i += a[k, i] * a[k, i]
                    square_j += a[k, j] * a[k, j]
                    product += a[k, i] * a[k, j]
                if abs(product) <= 1e-15 * math.sqrt(square_i * square_j):
                    continue
                is_done = False
                zeta = (square_j - square_i) / (2.0 * product)
                sign = 1.0 if zeta >= 0.0 else -1.0
                tangent = sign / (abs(zeta) + math.sqrt(1.0 + zeta * zeta))
                cosine = 1.0 / math.sqrt(1.0 + tangent * tangent)
                sine = cosine * tangent
                for k in range(m):
                    element = a[k, i]
                    a[k, i] = cosine * element - sine * a[k, j]
                    a[k, j] = sine * element + cosine * a[k, j]
                for k in range(n):
                    element = rotation[k, i]
                    rotation[k, i] = cosine * element - sine * rotation[k, j]
                    rotation[k, j] = sine * element + cosine * rotation[k, j]
        if is_done:
            return
