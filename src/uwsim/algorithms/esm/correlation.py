"""Correlation of a template and an image: sums over the pixels of a patch, in compiled code."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .pyramid import Grey
from .template import Runs


class Statistics(NamedTuple):
    """The statistics of the template and the image over the pixels of a patch."""

    n: float
    """The number of pixels."""
    mean_i: float
    """The mean of the image's pixels [grey level]."""
    deviation_i: float
    """The standard deviation of the image's pixels [grey level]."""
    mean_t: float
    """The mean of the template's pixels, which are normalised."""
    square_t: float
    """The sum of the squared deviations of the template's pixels from their mean."""
    cross: float
    """The sum of the products of the deviations of both from their means [grey level]."""


@njit
def nearest_zncc(image: Grey, runs: Runs, values: Grey, homography: Array) -> float:
    """Return the ZNCC of a template with the nearest image pixels; see `alignment.zncc`."""
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
            x, y = x + 0.5, y + 0.5  # the integer parts are the indices of the nearest pixel
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
def statistics(runs: Runs, values: Grey, samples: Grey, mask: Grey) -> Statistics:
    """Compute the statistics over the pixels of a patch whose four neighbours are in the image.

    Args:
        runs: the columns of the patch in each row of the template.
        values: the pixels of the template, (h, w).
        samples: the image at these pixels and their neighbours, (h + 2, w + 2).
        mask: 1 for samples inside the image, else 0, (h + 2, w + 2).
    """
    n = sum_i = sum_ii = sum_t = sum_tt = sum_it = 0.0
    for row in range(runs.shape[0]):
        for column in range(runs[row, 0], runs[row, 1]):
            w = mask[row + 1, column + 1] * mask[row, column + 1] * mask[row + 2, column + 1]
            if w * mask[row + 1, column] * mask[row + 1, column + 2] > 0.0:
                i, t = float(samples[row + 1, column + 1]), float(values[row, column])
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
