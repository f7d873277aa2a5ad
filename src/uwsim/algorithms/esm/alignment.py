r"""Bringing an image onto a template: ESM, and its first-order relatives.

With :math:`p` a template pixel, :math:`w` the warp and :math:`\hat H` the guess, the residual
:math:`s_p(x) = I(w(\hat H e^{x}, p)) - I^*(p)` is linearised with

.. math:: J = (a\,J_I + b\,J_{I^*})\,J_w J_G, \qquad x = -J^+ s(0), \qquad
          \hat H \leftarrow \hat H \exp(x)

where :math:`J_I` is the gradient of the warped image and :math:`J_{I^*}` that of the template.
a = b = 1/2 is ESM (Benhimane and Malis 2004, 2007): second order without second derivatives.
a = 0, b = 1 is inverse compositional (Baker and Matthews 2004), a = 1, b = 0 forward compositional.

*Photometry.* Both patches are brought to zero mean and unit variance, and what a change of gain
and bias would explain of J is taken out of it (projection beside 1 and I*), so that light and fog
do not look like motion. Without it the grey levels are compared as they are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...jit import njit
from ...linear import inverse, product
from .homography import exponential, multiply
from .pyramid import Grey
from .template import Runs, Template

Array = npt.NDArray[np.float64]

BLENDS = {"esm": (0.5, 0.5), "ic": (0.0, 1.0), "fc": (1.0, 0.0)}
"""Share (a, b) of the image's and of the template's gradient in J."""


@dataclass(frozen=True, kw_only=True)
class Method:
    """Which linearisation, and when it is done."""

    blend: str = "esm"
    """``esm``, ``ic`` or ``fc``."""
    photometric: bool = True
    """Compare patches of zero mean and unit variance."""
    max_iterations: int = 20
    """At most so many steps in one call."""
    precision: float = 1e-4
    """A step shorter than this, in normalised coordinates, is the last."""


@dataclass(frozen=True, eq=False)
class Alignment:
    """Where an alignment ended."""

    homography: Array
    """Sends template points to the image, (3, 3); the best seen on the way."""
    correlation: float
    """Correlation with the interpolated image, -1..1; -1 when too little is in the image."""
    iterations: int
    """Steps taken."""


def align(image: Grey, template: Template, guess: Array, method: Method) -> Alignment:
    """Refine ``guess`` (3, 3), which sends template points to ``image`` points [px]."""
    a, b = BLENDS[method.blend]
    homography, correlation, iterations = _align(
        image,
        template.runs,
        template.values,
        template.slope_u,
        template.slope_v,
        product(guess, template.image_from_normalised),
        a,
        b,
        method.photometric,
        template.mean,
        template.contrast,
        method.max_iterations,
        method.precision,
    )
    back = inverse(template.image_from_normalised)
    return Alignment(product(homography, back), correlation, iterations)


def zncc(image: Grey, template: Template, homography: Array) -> float:
    """Zero-mean normalised cross-correlation of the template with the image's nearest pixels.

    Pixels are taken as they are, not interpolated: bilinear interpolation averages the noise of
    four pixels, so that a correlation of it stays high where nothing can be seen any more. With
    noise sigma in the image and contrast S T left of the template, the result is
    ``S T / sqrt((S T)^2 + sigma^2)``. -1 when less than a quarter of the patch is in the image.
    """
    return _nearest_zncc(
        image,
        template.runs,
        template.values,
        product(homography, template.image_from_normalised),
    )


@njit
def _align(
    image: Grey,
    runs: Runs,
    values: Grey,
    slope_u: Grey,
    slope_v: Grey,
    guess: Array,
    a: float,
    b: float,
    photometric: bool,
    mean: float,
    contrast: float,
    max_iterations: int,
    precision: float,
) -> tuple[Array, float, int]:
    """The whole loop; ``guess`` sends normalised template points to image points."""
    height, width = values.shape
    warped = np.zeros((height + 2, width + 2), np.float32)
    valid = np.zeros((height + 2, width + 2), np.float32)
    current = guess.copy()
    best = guess.copy()
    best_score, best_correlation = -np.inf, -1.0
    iterations = 0
    total = 0
    for row in range(height):
        total += runs[row, 1] - runs[row, 0]
    while True:
        fetch(image, current, runs, warped, valid)
        n, mean_i, deviation_i, mean_t, square_t, cross = statistics(runs, values, warped, valid)
        if n < 0.25 * total or n < 32.0 or square_t <= 0.0:
            break
        correlation = -1.0
        if deviation_i > 1e-6:
            correlation = cross / (n * deviation_i * np.sqrt(square_t / n))
        if photometric:
            score = correlation
        else:
            shift = (mean_i - mean) / contrast - mean_t
            spread = deviation_i / contrast
            score = -(spread**2 - 2.0 * cross / n / contrast + square_t / n + shift**2)
        if score > best_score:
            best_score, best_correlation = score, correlation
            best[:] = current
        if iterations >= max_iterations or deviation_i <= 1e-6:
            break
        scale = deviation_i if photometric else contrast
        offset = mean_i if photometric else mean
        gram = normal_equations(
            runs, values, slope_u, slope_v, warped, valid, offset, 1.0 / scale, a, b
        )
        matrix = gram[:8, :8].copy()
        right = gram[:8, 8] - gram[:8, 9]
        if photometric:
            ones = gram[:8, 10]
            along = gram[:8, 9] - mean_t * ones
            right = gram[:8, 8] - along * (cross / scale / square_t)
            for i in range(8):
                for k in range(8):
                    matrix[i, k] -= ones[i] * ones[k] / n + along[i] * along[k] / square_t
        step, solvable = solve(matrix, -right)
        length = np.sqrt((step * step).sum())
        if not solvable or not length < 2.0:
            break
        current = multiply(current, exponential(step))
        iterations += 1
        if length < precision:
            max_iterations = iterations
    return best, best_correlation, iterations


@njit
def _nearest_zncc(image: Grey, runs: Runs, values: Grey, homography: Array) -> float:
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
                px, py = x / w - 0.5, y / w - 0.5
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


@njit
def statistics(
    runs: Runs, values: Grey, warped: Grey, valid: Grey
) -> tuple[float, float, float, float, float, float]:
    """Count, mean and deviation of the image, mean, squares and cross sum of the template.

    Only pixels whose four neighbours are in the image count. Squares and cross sum are about
    the means.
    """
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
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    mean_i, mean_t = sum_i / n, sum_t / n
    deviation = np.sqrt(max(sum_ii / n - mean_i * mean_i, 0.0))
    return n, mean_i, deviation, mean_t, sum_tt - n * mean_t**2, sum_it - n * mean_i * mean_t


@njit
def normal_equations(
    runs: Runs,
    values: Grey,
    slope_u: Grey,
    slope_v: Grey,
    warped: Grey,
    valid: Grey,
    offset: float,
    gain: float,
    a: float,
    b: float,
) -> Array:
    """Products of the eight columns of J with each other, the image, the template and 1.

    Returns (8, 11): J^T [J, (I - offset) gain, I*, 1]. Sums run down the columns of the patch in
    float32, side by side, so that the processor does several at once, then across in float64.
    """
    height, width = values.shape
    sums = np.zeros((60, width), np.float32)
    columns = np.empty((11, width), np.float32)
    abscissa = np.empty(width, np.float32)
    for c in range(width):
        abscissa[c] = (2.0 * c + 1.0) / width - 1.0
    from_u, from_v = np.float32(0.25 * a * gain * width), np.float32(0.25 * a * gain * height)
    for row in range(height):
        first, last = runs[row, 0], runs[row, 1]
        v = np.float32((2.0 * row + 1.0) / height - 1.0)
        fill_columns(
            columns,
            abscissa[first:last],
            v,
            warped[row : row + 3, first : last + 2],
            valid[row : row + 3, first : last + 2],
            values[row, first:last],
            slope_u[row, first:last],
            slope_v[row, first:last],
            np.float32(offset),
            np.float32(gain),
            from_u,
            from_v,
            np.float32(b),
        )
        index = 0
        for i in range(8):
            for k in range(i, 11):
                for c in range(last - first):
                    sums[index, c] += columns[i, c] * columns[k, c]
                index += 1
    result = np.empty((8, 11))
    index = 0
    for i in range(8):
        for k in range(i, 11):
            total = 0.0
            for c in range(width):
                total += sums[index, c]
            result[i, k] = total
            if k < 8:
                result[k, i] = total
            index += 1
    return result


@njit
def fill_columns(
    columns: Grey,
    abscissa: Grey,
    v: np.float32,
    warped: Grey,
    valid: Grey,
    values: Grey,
    slope_u: Grey,
    slope_v: Grey,
    offset: np.float32,
    gain: np.float32,
    from_u: np.float32,
    from_v: np.float32,
    share: np.float32,
) -> None:
    """Write the eight columns of J, the image, the template and 1 for one run of pixels."""
    above, here, below = warped[0], warped[1], warped[2]
    valid_above, valid_here, valid_below = valid[0], valid[1], valid[2]
    for c in range(abscissa.size):
        w = valid_above[c + 1] * valid_below[c + 1]
        w *= valid_here[c] * valid_here[c + 1] * valid_here[c + 2]
        u = abscissa[c]
        gu = w * (from_u * (here[c + 2] - here[c]) + share * slope_u[c])
        gv = w * (from_v * (below[c + 1] - above[c + 1]) + share * slope_v[c])
        outward = gu * u + gv * v
        columns[0, c] = gu
        columns[1, c] = gv
        columns[2, c] = gu * v
        columns[3, c] = gv * u
        columns[4, c] = gu * u - gv * v
        columns[5, c] = outward
        columns[6, c] = -u * outward
        columns[7, c] = -v * outward
        columns[8, c] = (here[c + 1] - offset) * gain
        columns[9, c] = values[c]
        columns[10, c] = np.float32(1.0)


@njit
def solve(matrix: Array, right: Array) -> tuple[Array, bool]:
    """Solve a symmetric positive definite system (8, 8) by Cholesky; False when it is not one."""
    n = right.size
    lower = np.zeros((n, n))
    x = right.copy()
    trace = 0.0
    for i in range(n):
        trace += matrix[i, i]
    floor = 1e-9 * trace
    for i in range(n):
        for k in range(i + 1):
            rest = matrix[i, k]
            for m in range(k):
                rest -= lower[i, m] * lower[k, m]
            if i == k:
                if not rest > floor:
                    return x, False
                lower[i, i] = np.sqrt(rest)
            else:
                lower[i, k] = rest / lower[k, k]
    for i in range(n):
        for m in range(i):
            x[i] -= lower[i, m] * x[m]
        x[i] /= lower[i, i]
    for i in range(n - 1, -1, -1):
        for m in range(i + 1, n):
            x[i] -= lower[m, i] * x[m]
        x[i] /= lower[i, i]
    return x, True
