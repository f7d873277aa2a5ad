"""The loop of an alignment, compiled: sample, compare, solve, step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .correlation import Statistics, statistics
from .homography import exponential, multiply
from .normal_equations import normal_equations, solve
from .patch import Patch
from .pyramid import Grey
from .template import Runs


class Settings(NamedTuple):
    """Shares of the gradients in J, and the rest of an `alignment.Method`."""

    a: float
    b: float
    photometric: bool
    max_iterations: int
    precision: float


@njit
def iterate(
    image: Grey, patch: Patch, guess: Array, settings: Settings
) -> tuple[Array, float, int]:
    """The whole loop; ``guess`` sends normalised template points to image points."""
    height, width = patch.values.shape
    warped = np.zeros((height + 2, width + 2), np.float32)
    valid = np.zeros((height + 2, width + 2), np.float32)
    current = guess.copy()
    best = guess.copy()
    best_score, best_correlation = -np.inf, -1.0
    iterations, max_iterations = 0, settings.max_iterations
    total = 0
    for row in range(height):
        total += patch.runs[row, 1] - patch.runs[row, 0]
    while True:
        fetch(image, current, patch.runs, warped, valid)
        found = statistics(patch.runs, patch.values, warped, valid)
        if found.n < 0.25 * total or found.n < 32.0 or found.square_t <= 0.0:
            break
        score, correlation = _score(found, patch, settings.photometric)
        if score > best_score:
            best_score, best_correlation = score, correlation
            best[:] = current
        if iterations >= max_iterations or found.deviation_i <= 1e-6:
            break
        scale = found.deviation_i if settings.photometric else patch.contrast
        offset = found.mean_i if settings.photometric else patch.mean
        gram = normal_equations(
            patch, (warped, valid), (offset, 1.0 / scale), settings.a, settings.b
        )
        matrix, right = _system(gram, found, scale, settings.photometric)
        step, solvable = solve(matrix, -right)
        square = 0.0  # a sum of numba's loads all of scipy.linalg
        for component in step:
            square += component * component
        length = np.sqrt(square)
        if not solvable or not length < 2.0:
            break
        current = multiply(current, exponential(step))
        iterations += 1
        if length < settings.precision:
            max_iterations = iterations
    return best, best_correlation, iterations


@njit
def _score(found: Statistics, patch: Patch, photometric: bool) -> tuple[float, float]:
    """What a place is worth, greater is better, and its correlation."""
    n, square_t, cross = found.n, found.square_t, found.cross
    correlation = -1.0
    if found.deviation_i > 1e-6:
        correlation = cross / (n * found.deviation_i * np.sqrt(square_t / n))
    if photometric:
        return correlation, correlation
    shift = (found.mean_i - patch.mean) / patch.contrast - found.mean_t
    spread = found.deviation_i / patch.contrast
    score = -(spread**2 - 2.0 * cross / n / patch.contrast + square_t / n + shift**2)
    return score, correlation


@njit
def _system(gram: Array, found: Statistics, scale: float, photometric: bool) -> tuple[Array, Array]:
    """J^T J and J^T s, without what a change of gain and bias would explain."""
    n, square_t = found.n, found.square_t
    matrix = gram[:8, :8].copy()
    right = gram[:8, 8] - gram[:8, 9]
    if photometric:
        ones = gram[:8, 10]
        along = gram[:8, 9] - found.mean_t * ones
        right = gram[:8, 8] - along * (found.cross / scale / square_t)
        for i in range(8):
            for k in range(8):
                matrix[i, k] -= ones[i] * ones[k] / n + along[i] * along[k] / square_t
    return matrix, right


@njit
def fetch(image: Grey, homography: Array, runs: Runs, warped: Grey, valid: Grey) -> None:
    """Sample the image (bilinear) at the warped template pixels and one pixel around them."""
    height, width = runs.shape[0], warped.shape[1] - 2
    limit_x, limit_y = image.shape[1] - 1.0, image.shape[0] - 1.0
    step_x = homography[0, 0] * 2.0 / width
    step_y = homography[1, 0] * 2.0 / width
    step_w = homography[2, 0] * 2.0 / width
    for row in range(height + 2):
        first, last = width, 0
        for near in range(max(row - 2, 0), min(row + 1, height)):
            if runs[near, 1] > runs[near, 0]:
                first, last = min(first, runs[near, 0]), max(last, runs[near, 1])
        u = (2.0 * first - 1.0) / width - 1.0
        v = (2.0 * row - 1.0) / height - 1.0
        x = homography[0, 0] * u + homography[0, 1] * v + homography[0, 2]
        y = homography[1, 0] * u + homography[1, 1] * v + homography[1, 2]
        w = homography[2, 0] * u + homography[2, 1] * v + homography[2, 2]
        for column in range(first, last + 2):
            valid[row, column] = 0.0
            warped[row, column] = 0.0
            if w > 0.0:
                px, py = x / w, y / w
                if px >= 0.0 and py >= 0.0 and px < limit_x and py < limit_y:
                    i, j = int(px), int(py)
                    fx, fy = np.float32(px - i), np.float32(py - j)
                    upper = image[j, i] + fx * (image[j, i + 1] - image[j, i])
                    lower = image[j + 1, i] + fx * (image[j + 1, i + 1] - image[j + 1, i])
                    warped[row, column] = upper + fy * (lower - upper)
                    valid[row, column] = 1.0
            x += step_x
            y += step_y
            w += step_w
