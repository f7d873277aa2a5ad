"""The normal equations for a step of the alignment, and their solution, in compiled code.

I is the warped image and I* the template. J is the Jacobian of their difference with respect to
the step, (n, 8) for n pixels; a and b are the weights of the gradients of I and of I* in J.
`alignment` has the formulas.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .patch import Patch
from .pyramid import Grey


class Weights(NamedTuple):
    """The offset and factors that convert the pixels of a run to columns of J and of the image."""

    offset: np.float32
    """The brightness that is subtracted from the image [grey level]."""
    gain: np.float32
    """The factor of the image after the offset is subtracted [1 / grey level]."""
    from_u: np.float32
    """The factor of a difference of two samples that are two columns apart, for the gradient by
    the normalised coordinate u; it includes the weight a of the image."""
    from_v: np.float32
    """The factor of a difference of two samples that are two rows apart, for the gradient by v."""
    template_weight: np.float32
    """The weight b of the template's gradient."""


class Run(NamedTuple):
    """The n pixels of one row of the patch, with their neighbours in the image."""

    abscissa: Grey
    """The normalised coordinate u of each pixel, (n,)."""
    v: np.float32
    """The normalised coordinate v of the row."""
    samples: Grey
    """The image at the pixels and their neighbours, (3, n + 2) [grey level]."""
    mask: Grey
    """1 for samples inside the image, else 0, (3, n + 2)."""
    values: Grey
    """The pixels of the template, (n,)."""
    slope_u: Grey
    """The derivative of the template with respect to u, (n,)."""
    slope_v: Grey
    """The derivative of the template with respect to v, (n,)."""


@njit
def normal_equations(
    patch: Patch,
    image_samples: tuple[Grey, Grey],
    brightness: tuple[float, float],
    a: float,
    b: float,
) -> Array:
    """Compute the products of J with J, with the image, with the template and with 1.

    The products of the c-th pixels of all runs are summed in float32, so that the processor adds
    several c at once; these sums are then added in float64.

    Args:
        patch: the template.
        image_samples: the warped image and its mask (`alignment_kernel.sample_image`).
        brightness: the offset [grey level] and the gain [1 / grey level] of the image.
        a: the weight of the image's gradient in J.
        b: the weight of the template's gradient in J.

    Returns:
        J^T [J, (I - offset) gain, I*, 1], (8, 11).
    """
    height, width = patch.values.shape
    samples, mask = image_samples
    offset, gain = brightness
    sums = np.zeros((60, width), np.float32)
    columns = np.empty((11, width), np.float32)
    abscissa = np.empty(width, np.float32)
    for c in range(width):
        abscissa[c] = (2.0 * c + 1.0) / width - 1.0
    weights = Weights(
        np.float32(offset),
        np.float32(gain),
        np.float32(0.25 * a * gain * width),
        np.float32(0.25 * a * gain * height),
        np.float32(b),
    )
    for row in range(height):
        start, end = patch.runs[row, 0], patch.runs[row, 1]
        v = np.float32((2.0 * row + 1.0) / height - 1.0)
        run = Run(
            abscissa[start:end],
            v,
            samples[row : row + 3, start : end + 2],
            mask[row : row + 3, start : end + 2],
            patch.values[row, start:end],
            patch.slope_u[row, start:end],
            patch.slope_v[row, start:end],
        )
        fill_columns(columns, run, weights)
        index = 0
        for i in range(8):
            for k in range(i, 11):
                for c in range(end - start):
                    sums[index, c] += columns[i, c] * columns[k, c]
                index += 1
    products = np.empty((8, 11))
    index = 0
    for i in range(8):
        for k in range(i, 11):
            total = 0.0
            for c in range(width):
                total += sums[index, c]
            products[i, k] = total
            if k < 8:
                products[k, i] = total
            index += 1
    return products


@njit
def fill_columns(columns: Grey, run: Run, weights: Weights) -> None:
    """Compute the eight columns of J, the image, the template and 1 for one run of pixels."""
    abscissa, v, samples, mask, values, slope_u, slope_v = run
    offset, gain, from_u, from_v, template_weight = weights
    upper_row, centre_row, lower_row = samples[0], samples[1], samples[2]
    valid_upper, valid_centre, valid_lower = mask[0], mask[1], mask[2]
    for c in range(abscissa.size):
        w = valid_upper[c + 1] * valid_lower[c + 1]
        w *= valid_centre[c] * valid_centre[c + 1] * valid_centre[c + 2]
        u = abscissa[c]
        gu = w * (from_u * (centre_row[c + 2] - centre_row[c]) + template_weight * slope_u[c])
        gv = w * (from_v * (lower_row[c + 1] - upper_row[c + 1]) + template_weight * slope_v[c])
        radial_slope = gu * u + gv * v
        columns[0, c] = gu
        columns[1, c] = gv
        columns[2, c] = gu * v
        columns[3, c] = gv * u
        columns[4, c] = gu * u - gv * v
        columns[5, c] = radial_slope
        columns[6, c] = -u * radial_slope
        columns[7, c] = -v * radial_slope
        columns[8, c] = (centre_row[c + 1] - offset) * gain
        columns[9, c] = values[c]
        columns[10, c] = np.float32(1.0)


@njit
def solve(matrix: Array, right: Array) -> tuple[Array, bool]:
    """Solve a symmetric system (8, 8) by Cholesky decomposition.

    Returns:
        The solution (8,), and False if the matrix is not positive definite.
    """
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
