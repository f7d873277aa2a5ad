"""The iterations of an alignment, in compiled code: sample, compare, solve, step.

`alignment` has the formulas and the symbols I, I*, J, s, a and b.
"""

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
    """The settings of an alignment that compiled code reads."""

    a: float
    """The weight of the image's gradient in J."""
    b: float
    """The weight of the template's gradient in J."""
    photometric: bool
    """True if patches are normalised; see `alignment.Method`."""
    max_iterations: int
    """The greatest number of steps."""
    precision: float
    """The length of a step below which the iterations end; see `alignment.Method`."""


@njit
def iterate(
    image: Grey, patch: Patch, guess: Array, settings: Settings
) -> tuple[Array, float, int]:
    """Align a patch with an image, starting at ``guess``.

    ``guess`` is a homography from normalised template coordinates to image points [px], (3, 3).

    Returns:
        The homography with the best score, its correlation, and the number of steps.
    """
    height, width = patch.values.shape
    samples = np.zeros((height + 2, width + 2), np.float32)
    mask = np.zeros((height + 2, width + 2), np.float32)
    homography = guess.copy()
    best_homography = guess.copy()
    best_score, best_correlation = -np.inf, -1.0
    iterations, max_iterations = 0, settings.max_iterations
    n_pixels = 0
    for row in range(height):
        n_pixels += patch.runs[row, 1] - patch.runs[row, 0]
    while True:
        sample_image(image, homography, patch.runs, samples, mask)
        sums = statistics(patch.runs, patch.values, samples, mask)
        if sums.n < 0.25 * n_pixels or sums.n < 32.0 or sums.square_t <= 0.0:
            break
        score, correlation = _score(sums, patch, settings.photometric)
        if score > best_score:
            best_score, best_correlation = score, correlation
            best_homography[:] = homography
        if iterations >= max_iterations or sums.deviation_i <= 1e-6:
            break
        scale = sums.deviation_i if settings.photometric else patch.contrast
        offset = sums.mean_i if settings.photometric else patch.mean
        gram = normal_equations(
            patch, (samples, mask), (offset, 1.0 / scale), settings.a, settings.b
        )
        matrix, right = _system(gram, sums, scale, settings.photometric)
        step, is_solvable = solve(matrix, -right)
        square = 0.0  # a sum of numba's loads all of scipy.linalg
        for component in step:
            square += component * component
        length = np.sqrt(square)
        if not is_solvable or not length < 2.0:
            break
        homography = multiply(homography, exponential(step))
        iterations += 1
        if length < settings.precision:
            max_iterations = iterations
    return best_homography, best_correlation, iterations


@njit
def _score(sums: Statistics, patch: Patch, photometric: bool) -> tuple[float, float]:
    """Return the score of the present homography (greater is better), and its correlation."""
    n, square_t, cross = sums.n, sums.square_t, sums.cross
    correlation = -1.0
    if sums.deviation_i > 1e-6:
        correlation = cross / (n * sums.deviation_i * np.sqrt(square_t / n))
    if photometric:
        return correlation, correlation
    shift = (sums.mean_i - patch.mean) / patch.contrast - sums.mean_t
    spread = sums.deviation_i / patch.contrast
    score = -(spread**2 - 2.0 * cross / n / patch.contrast + square_t / n + shift**2)
    return score, correlation


@njit
def _system(gram: Array, sums: Statistics, scale: float, photometric: bool) -> tuple[Array, Array]:
    """Return J^T J (8, 8) and J^T s (8,) from the products in `normal_equations`.

    If ``photometric``, J is projected onto the complement of gain and offset. ``scale`` is the
    contrast by which the image is divided [grey level].
    """
    n, square_t = sums.n, sums.square_t
    matrix = gram[:8, :8].copy()
    right = gram[:8, 8] - gram[:8, 9]
    if photometric:
        jt_one = gram[:8, 10]
        jt_t = gram[:8, 9] - sums.mean_t * jt_one
        right = gram[:8, 8] - jt_t * (sums.cross / scale / square_t)
        for i in range(8):
            for k in range(8):
                matrix[i, k] -= jt_one[i] * jt_one[k] / n + jt_t[i] * jt_t[k] / square_t
    return matrix, right


@njit
def sample_image(image: Grey, homography: Array, runs: Runs, samples: Grey, mask: Grey) -> None:
    """Interpolate the image at the warped template pixels and at their neighbours.

    Args:
        image: the image.
        homography: the homography from normalised template coordinates to image points [px].
        runs: the columns of the patch in each row of the template.
        samples: the output, (rows + 2, columns + 2); bilinear interpolation, 0 outside the image.
        mask: the output, of the same shape; 1 for samples inside the image, else 0.
    """
    height, width = runs.shape[0], samples.shape[1] - 2
    limit_x, limit_y = image.shape[1] - 1.0, image.shape[0] - 1.0
    step_x = homography[0, 0] * 2.0 / width
    step_y = homography[1, 0] * 2.0 / width
    step_w = homography[2, 0] * 2.0 / width
    for row in range(height + 2):
        start, end = width, 0
        for k in range(max(row - 2, 0), min(row + 1, height)):
            if runs[k, 1] > runs[k, 0]:
                start, end = min(start, runs[k, 0]), max(end, runs[k, 1])
        u = (2.0 * start - 1.0) / width - 1.0
        v = (2.0 * row - 1.0) / height - 1.0
        x = homography[0, 0] * u + homography[0, 1] * v + homography[0, 2]
        y = homography[1, 0] * u + homography[1, 1] * v + homography[1, 2]
        w = homography[2, 0] * u + homography[2, 1] * v + homography[2, 2]
        for column in range(start, end + 2):
            mask[row, column] = 0.0
            samples[row, column] = 0.0
            if w > 0.0:
                px, py = x / w, y / w
                if px >= 0.0 and py >= 0.0 and px < limit_x and py < limit_y:
                    i, j = int(px), int(py)
                    fx, fy = np.float32(px - i), np.float32(py - j)
                    upper = image[j, i] + fx * (image[j, i + 1] - image[j, i])
                    lower = image[j + 1, i] + fx * (image[j + 1, i + 1] - image[j + 1, i])
                    samples[row, column] = upper + fy * (lower - upper)
                    mask[row, column] = 1.0
            x += step_x
            y += step_y
            w += step_w
