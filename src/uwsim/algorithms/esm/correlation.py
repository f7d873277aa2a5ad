"""Correlation of template and image: sums over the pixels of the patch, compiled."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .pyramid import Grey
from .template import Runs


class Statistics(NamedTuple):
    """Of the pixels of a patch and what the image has there."""

    n: float
    """How many pixels count."""
    mean_i: float
    """Mean of the image."""
    deviation_i: float
    """Standard deviation of the image."""
    mean_t: float
    """Mean of the template."""
    square_t: float
    """Sum of the squares of the template, about its mean."""
    cross: float
    """Sum of the products of both, about the means."""


@njit
def nearest_zncc(image: Grey, runs: Runs, values: Grey, homography: Array) -> float:
    """ZNCC of a template with the nearest pixels of the image; see `alignment.zncc`."""
    height, width = values.shape
    total = n = sum_i = sum_ii = sum_t = sum_tt = sum_it = 0.0
    for row in range(height):
        v = (2.0 * row + 1.0) / height - 1.0
        for column in range(runs[row, 0], runs[row, 1]):
            u = (2.0 * column + 1.0) / width - 1.0
            total += 1.0
            w = homography[2, 0] * u + homography[2, 1] * v + homography[2, 2]
            if w <= 0.0:
                continue
            x = (homography[0, 0] * u + homography[0, 1] * v + homography[0, 2]) / w
            y = (homography[1, 0] * u + homography[1, 1] * v + homography[1, 2]) / w
            x, y = x + 0.5, y + 0.5  # from the corner: its whole part is the nearest pixel's index
            if 0.0 <= x < image.shape[1] and 0.0 <= y < image.shape[0]:
                i, t = float(image[int(y), int(x)]), float(values[row, column])
                n += 1.0
                sum_i += i
                sum_ii += i * i
                sum_t += t
                sum_tt += t * t
                sum_it += i * t
    if n < 0.25 * total or n == 0.0:
        return -1.0
    square_i, square_t = sum_ii - sum_i * sum_i / n, sum_tt - sum_t * sum_t / n
    if square_i <= 1e-6 * n or square_t <= 1e-6 * n:
        return -1.0
    return float((sum_it - sum_i * sum_t / n) / np.sqrt(square_i * square_t))


@njit
def statistics(runs: Runs, values: Grey, warped: Grey, valid: Grey) -> Statistics:
    """Sums over the pixels whose four neighbours are in the image."""
    n = sum_i = sum_ii = sum_t = sum_tt = sum_it = 0.0
    for row in range(runs.shape[0]):
        for column in range(runs[row, 0], runs[row, 1]):
            w = valid[row + 1, column + 1] * valid[row, column + 1] * valid[row + 2, column + 1]
            if w * valid[row + 1, column] * valid[row + 1, column + 2] > 0.0:
                i, t = float(warped[row + 1, column + 1]), float(values[row, column])
                n += 1.0
                sum_i += i
                sum_ii += i * i
                sum_t += t
                sum_tt += t * t
                sum_it += i * t
    if n == 0.0:
        return Statistics(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    mean_i, mean_t = sum_i / n, sum_t / n
    deviation = np.sqrt(max(sum_ii / n - mean_i * mean_i, 0.0))
    square_t, cross = sum_tt - n * mean_t**2, sum_it - n * mean_i * mean_t
    return Statistics(n, mean_i, deviation, mean_t, square_t, cross)
