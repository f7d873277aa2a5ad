"""Covariance of the navigation filter, compiled: it is propagated at the rate of the IMU."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit


@njit
def propagated(covariance: Array, rotation: Array, pull: Array, step: float, noise: Array) -> Array:
    """Return ``F P F' + Q dt`` of the error state (15, 15).

    Args:
        covariance: P, (15, 15).
        rotation: axes of the base in the navigation frame, (3, 3).
        pull: specific force in navigation axes, (3,) [m/s2].
        step: dt [s].
        noise: diagonal of Q, (15,).
    """
    moves = np.eye(15)
    for i in range(3):
        moves[i, 3 + i] = step
        for k in range(3):
            moves[3 + i, 12 + k] = -step * rotation[i, k]
            moves[6 + i, 9 + k] = -step * rotation[i, k]
    x, y, z = pull
    moves[3, 7], moves[3, 8] = step * z, -step * y
    moves[4, 6], moves[4, 8] = -step * z, step * x
    moves[5, 6], moves[5, 7] = step * y, -step * x
    half = _product(moves, covariance)
    found = _times_transposed(half, moves)
    for i in range(15):
        found[i, i] += step * noise[i]
    return found


@njit
def turned_by(rotation: Array, vector: Array, *, in_base: bool) -> Array:
    """Turn a rotation (3, 3) by a rotation vector (3,) [rad] of the base's axes, or the others."""
    x, y, z = vector
    angle = math.sqrt(x * x + y * y + z * z)
    if angle < 1e-12:
        return rotation.copy()
    x, y, z = x / angle, y / angle, z / angle
    s, c = math.sin(angle), 1.0 - math.cos(angle)
    turn = np.empty((3, 3))
    turn[0, 0], turn[0, 1], turn[0, 2] = (
        1.0 - c * (y * y + z * z),
        c * x * y - s * z,
        c * x * z + s * y,
    )
    turn[1, 0], turn[1, 1], turn[1, 2] = (
        c * x * y + s * z,
        1.0 - c * (x * x + z * z),
        c * y * z - s * x,
    )
    turn[2, 0], turn[2, 1], turn[2, 2] = (
        c * x * z - s * y,
        c * y * z + s * x,
        1.0 - c * (x * x + y * y),
    )
    return _product(rotation, turn) if in_base else _product(turn, rotation)


@njit
def turn_between(rotation: Array, other: Array) -> Array:
    """Rotation vector (3,) [rad] of ``other @ rotation.T``, by less than half a turn."""
    turn = _times_transposed(other, rotation)
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    axis *= 0.5
    sine = math.sqrt(axis[0] ** 2 + axis[1] ** 2 + axis[2] ** 2)
    if sine < 1e-12:
        return axis
    return axis * (math.atan2(sine, 0.5 * (turn[0, 0] + turn[1, 1] + turn[2, 2] - 1.0)) / sine)


@njit
def distance(covariance: Array, jacobian: Array, error: Array, variance: float) -> float:
    """Squared Mahalanobis distance of an error (m,) with a jacobian (m, 15)."""
    solved = _solve(_innovation(covariance, jacobian, variance), error.copy().reshape(-1, 1))
    total = 0.0
    for i in range(len(error)):
        total += error[i] * solved[i, 0]
    return total


@njit
def corrected(
    covariance: Array, jacobian: Array, error: Array, variance: float
) -> tuple[Array, Array]:
    """Return the correction (15,) and the covariance after it (Joseph's form)."""
    shares = _times_transposed(covariance, jacobian)  # (15, m)
    gain = _solve(_innovation(covariance, jacobian, variance), shares.T.copy()).T.copy()
    kept = -_product(gain, jacobian)
    for i in range(15):
        kept[i, i] += 1.0
    found = _times_transposed(_product(kept, covariance), kept)
    found += variance * _times_transposed(gain, gain)
    return _product(gain, error.copy().reshape(-1, 1))[:, 0], found


@njit
def _innovation(covariance: Array, jacobian: Array, variance: float) -> Array:
    found = _product(jacobian, _times_transposed(covariance, jacobian))
    for i in range(len(found)):
        found[i, i] += variance
    return found


@njit
def _product(a: Array, b: Array) -> Array:
    found = np.zeros((a.shape[0], b.shape[1]))
    for i in range(a.shape[0]):
        for j in range(a.shape[1]):
            if a[i, j] != 0.0:
                for k in range(b.shape[1]):
                    found[i, k] += a[i, j] * b[j, k]
    return found


@njit
def _times_transposed(a: Array, b: Array) -> Array:
    """``a @ b.T``."""
    found = np.zeros((a.shape[0], b.shape[0]))
    for i in range(a.shape[0]):
        for k in range(b.shape[0]):
            for j in range(a.shape[1]):
                found[i, k] += a[i, j] * b[k, j]
    return found


@njit
def _solve(a: Array, b: Array) -> Array:
    """Eliminate without pivots: ``a`` (m, m) is positive definite; ``b`` (m, n)."""
    a, b = a.copy(), b.copy()
    m = len(a)
    for column in range(m):
        for row in range(column + 1, m):
            factor = a[row, column] / a[column, column]
            for k in range(column, m):
                a[row, k] -= factor * a[column, k]
            for k in range(b.shape[1]):
                b[row, k] -= factor * b[column, k]
    for column in range(m - 1, -1, -1):
        for k in range(b.shape[1]):
            for row in range(column + 1, m):
                b[column, k] -= a[column, row] * b[row, k]
            b[column, k] /= a[column, column]
    return b
