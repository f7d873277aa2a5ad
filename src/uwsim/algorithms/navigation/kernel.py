"""The computations of the navigation filter, compiled because the IMU has a high rate."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit


@njit
def propagate(covariance: Array, rotation: Array, force: Array, dt: float, noise: Array) -> Array:
    """Compute the covariance ``F P F' + Q dt`` of the error state after a time step, (15, 15).

    F is the transition matrix of the error state, and Q the (diagonal) spectral density of the
    process noise. The 15 error states are, with three components each: position, velocity and
    attitude in navigation axes, then the biases of gyroscope and accelerometer in base axes.

    Args:
        covariance: the covariance P before the step, (15, 15).
        rotation: the rotation ``navigation_from_base``, (3, 3).
        force: the specific force in navigation axes, (3,) [m/s2].
        dt: the time step [s].
        noise: the diagonal of Q, (15,).
    """
    transition = np.eye(15)
    for i in range(3):
        transition[i, 3 + i] = dt
        for k in range(3):
            transition[3 + i, 12 + k] = -dt * rotation[i, k]
            transition[6 + i, 9 + k] = -dt * rotation[i, k]
    x, y, z = force
    transition[3, 7], transition[3, 8] = dt * z, -dt * y
    transition[4, 6], transition[4, 8] = -dt * z, dt * x
    transition[5, 6], transition[5, 7] = dt * y, -dt * x
    transition_covariance = _product(transition, covariance)
    result = _product_transposed(transition_covariance, transition)
    for i in range(15):
        result[i, i] += dt * noise[i]
    return result


@njit
def rotate_by(rotation: Array, vector: Array, *, in_base: bool) -> Array:
    """Rotate ``rotation``, navigation_from_base (3, 3), by a rotation vector (3,) [rad].

    The rotation vector is in base axes if ``in_base``, else in navigation axes.
    """
    x, y, z = vector
    angle = math.sqrt(x * x + y * y + z * z)
    if angle < 1e-12:
        return rotation.copy()
    x, y, z = x / angle, y / angle, z / angle
    s, c = math.sin(angle), 1.0 - math.cos(angle)
    delta = np.empty((3, 3))
    delta[0, 0], delta[0, 1], delta[0, 2] = (
        1.0 - c * (y * y + z * z),
        c * x * y - s * z,
        c * x * z + s * y,
    )
    delta[1, 0], delta[1, 1], delta[1, 2] = (
        c * x * y + s * z,
        1.0 - c * (x * x + z * z),
        c * y * z - s * x,
    )
    delta[2, 0], delta[2, 1], delta[2, 2] = (
        c * x * z - s * y,
        c * y * z + s * x,
        1.0 - c * (x * x + y * y),
    )
    if in_base:
        return _product(rotation, delta)
    return _product(delta, rotation)


@njit
def rotation_between(rotation: Array, other: Array) -> Array:
    """Return the rotation vector (3,) [rad] of ``other @ rotation.T``, of at most half a turn."""
    delta = _product_transposed(other, rotation)
    axis = np.array(
        [delta[2, 1] - delta[1, 2], delta[0, 2] - delta[2, 0], delta[1, 0] - delta[0, 1]]
    )
    axis *= 0.5
    sine = math.sqrt(axis[0] ** 2 + axis[1] ** 2 + axis[2] ** 2)
    if sine < 1e-12:
        return axis
    return axis * (math.atan2(sine, 0.5 * (delta[0, 0] + delta[1, 1] + delta[2, 2] - 1.0)) / sine)


@njit
def squared_distance(covariance: Array, jacobian: Array, error: Array, variance: float) -> float:
    """Return the squared Mahalanobis distance of a measurement from its expected values.

    Args:
        covariance: the covariance of the error state, (15, 15).
        jacobian: the derivatives of the values with respect to the error state, (m, 15).
        error: the measured minus the expected values, (m,).
        variance: the variance of each measured value.
    """
    innovation_covariance = _innovation_covariance(covariance, jacobian, variance)
    weighted_error = _solve(innovation_covariance, error.copy().reshape(-1, 1))
    total = 0.0
    for i in range(len(error)):
        total += error[i] * weighted_error[i, 0]
    return total


@njit
def correct(
    covariance: Array, jacobian: Array, error: Array, variance: float
) -> tuple[Array, Array]:
    """Return the correction of the error state (15,), and the corrected covariance (15, 15).

    The covariance is computed in Joseph form. `squared_distance` describes the arguments.
    """
    cross_covariance = _product_transposed(covariance, jacobian)  # (15, m)
    innovation_covariance = _innovation_covariance(covariance, jacobian, variance)
    gain = _solve(innovation_covariance, cross_covariance.T.copy()).T.copy()
    complement = -_product(gain, jacobian)
    for i in range(15):
        complement[i, i] += 1.0
    updated_covariance = _product_transposed(_product(complement, covariance), complement)
    updated_covariance += variance * _product_transposed(gain, gain)
    return _product(gain, error.copy().reshape(-1, 1))[:, 0], updated_covariance


@njit
def _innovation_covariance(covariance: Array, jacobian: Array, variance: float) -> Array:
    innovation_covariance = _product(jacobian, _product_transposed(covariance, jacobian))
    for i in range(len(innovation_covariance)):
        innovation_covariance[i, i] += variance
    return innovation_covariance


@njit
def _product(a: Array, b: Array) -> Array:
    matrix = np.zeros((a.shape[0], b.shape[1]))
    for i in range(a.shape[0]):
        for j in range(a.shape[1]):
            if a[i, j] != 0.0:
                for k in range(b.shape[1]):
                    matrix[i, k] += a[i, j] * b[j, k]
    return matrix


@njit
def _product_transposed(a: Array, b: Array) -> Array:
    matrix = np.zeros((a.shape[0], b.shape[0]))
    for i in range(a.shape[0]):
        for k in range(b.shape[0]):
            for j in range(a.shape[1]):
                matrix[i, k] += a[i, j] * b[k, j]
    return matrix


@njit
def _solve(a: Array, b: Array) -> Array:
    """Solve ``a x = b`` without pivoting for a positive definite a (m, m) and b (m, n)."""
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
