"""The normal equations of a step and their solution, compiled."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .patch import Patch
from .pyramid import Grey


class Weights(NamedTuple):
    """What turns the pixels of a run into columns of J."""

    offset: np.float32
    gain: np.float32
    from_u: np.float32
    from_v: np.float32
    share: np.float32


class Run(NamedTuple):
    """The pixels of one row of the patch, n of them, with one around them in the image."""

    abscissa: Grey
    v: np.float32
    warped: Grey
    valid: Grey
    values: Grey
    slope_u: Grey
    slope_v: Grey


@njit
def normal_equations(
    patch: Patch,
    sampled: tuple[Grey, Grey],
    brightness: tuple[float, float],
    a: float,
    b: float,
) -> Array:
    """Products of the eight columns of J with each other, the image, the template and 1.

    ``sampled`` is the warped image and where it is valid, ``brightness`` offset and gain. Returns
    (8, 11): J^T [J, (I - offset) gain, I*, 1]. Sums run down the columns of the patch in
    float32, side by side, so that the processor does several at once, then across in float64.
    """
    height, width = patch.values.shape
    warped, valid = sampled
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
        first, last = patch.runs[row, 0], patch.runs[row, 1]
        v = np.float32((2.0 * row + 1.0) / height - 1.0)
        run = Run(
            abscissa[first:last],
            v,
            warped[row : row + 3, first : last + 2],
            valid[row : row + 3, first : last + 2],
            patch.values[row, first:last],
            patch.slope_u[row, first:last],
            patch.slope_v[row, first:last],
        )
        fill_columns(columns, run, weights)
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
def fill_columns(columns: Grey, run: Run, weights: Weights) -> None:
    """Write the eight columns of J, the image, the template and 1 for one run of pixels."""
    abscissa, v, warped, valid, values, slope_u, slope_v = run
    offset, gain, from_u, from_v, share = weights
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
