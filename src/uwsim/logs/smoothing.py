r"""Twists from poses, by smoothing: a local polynomial of order 3 (Savitzky and Golay 1964).

Poses are interpolated to the median interval :math:`h` of the log. At each time a polynomial of
order 3 is fitted by least squares to the samples within `HALF_WIDTH` before and after it; its
derivative is the velocity. For 2 m + 1 samples at :math:`i h`, with the sums
:math:`S_k = \sum_i i^k`, it is

.. math:: \dot y = \frac{1}{h} \sum_{i=-m}^{m} \frac{S_6 i - S_4 i^3}{S_2 S_6 - S_4^2} \, y_i

The angular velocity in base axes is the vector part of :math:`2 \bar q \dot q`. Within `HALF_WIDTH`
of an end, the derivative is that of the nearest full window. Noise :math:`\sigma` of positions
gives an error of :math:`\sigma \sqrt{S_6 / (S_2 S_6 - S_4^2)} / h` of the velocity. Accelerations
that change within the window are attenuated.
"""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array
from .frames import multiply_quaternions, rotate_vectors_back

HALF_WIDTH = 0.25
"""The half-width of the window [s]."""
MIN_HALF_SAMPLES = 3
"""The least number of samples on each side of the centre of a window."""
MAX_GRID = 20_000_000
"""The greatest number of interpolated samples."""


def estimate_twists(times: Array, positions: Array, quaternions: Array) -> Array:
    """Return the twists over ground in base axes, (n, 6); NaN if there are too few samples.

    Args:
        times: the times, strictly increasing, (n,) [s].
        positions: the positions in L, (n, 3) [m]; a component may be NaN.
        quaternions: the orientations ``localized_from_base``, wxyz, (n, 4).
    """
    n = len(times)
    twists = np.full((n, 6), np.nan)
    if n < 2 * MIN_HALF_SAMPLES + 1:
        return twists
    interval = float(np.median(np.diff(times)))
    n_grid = int((times[-1] - times[0]) / interval) + 1
    if n_grid > MAX_GRID or n_grid < 2 * MIN_HALF_SAMPLES + 1:
        return twists
    grid = times[0] + interval * np.arange(n_grid)
    half = min(max(MIN_HALF_SAMPLES, round(HALF_WIDTH / interval)), (n_grid - 1) // 2)
    continuous = make_continuous(quaternions)
    rates = np.empty((n_grid, 4))
    for column in range(4):
        rates[:, column] = differentiate(
            np.interp(grid, times, continuous[:, column]), interval, half
        )
    velocities = np.empty((n_grid, 3))
    for column in range(3):
        velocities[:, column] = differentiate(
            np.interp(grid, times, positions[:, column]), interval, half
        )
    rates_at_times = _interpolate(times, grid, rates)
    conjugates = continuous * np.array([1.0, -1.0, -1.0, -1.0])
    twists[:, :3] = rotate_vectors_back(continuous, _interpolate(times, grid, velocities))
    twists[:, 3:] = 2.0 * multiply_quaternions(conjugates, rates_at_times)[:, 1:]
    return twists


def make_continuous(quaternions: Array) -> Array:
    """Return quaternions (n, 4) with signs such that neighbours are close."""
    products = (quaternions[1:] * quaternions[:-1]).sum(axis=1)
    signs = np.cumprod(np.where(products < 0.0, -1.0, 1.0))
    continuous: Array = quaternions * np.concatenate([[1.0], signs])[:, None]
    return continuous


def differentiate(values: Array, interval: float, half: int) -> Array:
    """Return the derivatives of equally spaced values, (n,), by cubic polynomials.

    Args:
        values: the values, (n,), at least 2 ``half`` + 1.
        interval: the interval between values [s].
        half: the number of values on each side of the centre of a window.
    """
    offsets = np.arange(-half, half + 1, dtype=np.float64)
    squares = offsets * offsets
    s2, s4 = float(squares.sum()), float((squares * squares).sum())
    s6 = float((squares * squares * squares).sum())
    weights = (s6 * offsets - s4 * offsets * squares) / (s2 * s6 - s4 * s4)
    n = len(values) - 2 * half
    derivatives = np.zeros(n)
    for index, weight in enumerate(weights.tolist()):
        derivatives += weight * values[index : index + n]
    return np.pad(derivatives, half, mode="edge") / interval


def _interpolate(times: Array, grid: Array, columns: Array) -> Array:
    return np.array([np.interp(times, grid, column) for column in columns.T]).T
