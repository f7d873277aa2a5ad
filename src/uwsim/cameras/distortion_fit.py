r"""The coefficients of CameraInfo for a lens behind a port, fitted to its rays.

The model is ``plumb_bob`` if it meets every pixel within `PLUMB_BOB_LIMIT`, else
``rational_polynomial`` with the coefficients k1, k2, p1, p2, k3, k4, k5, k6:

.. math:: x_d = x \frac{1 + k_1 r^2 + k_2 r^4 + k_3 r^6}{1 + k_4 r^2 + k_5 r^4 + k_6 r^6} + \dots

The fit is by least squares over a grid of pixels, with the focal length and the principal point of
the pinhole. The equations of the rational model are multiplied by its denominator, which is then
taken from the last fit.

Neither model has the tangential distortion of a lens in air behind a port: coefficients p1 and p2
of 0.003 there leave more than 1 px.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

from ..base.geometry import Array, Intrinsics

Model = Literal["plumb_bob", "rational_polynomial"]
PLUMB_BOB_LIMIT = 0.05
"""The greatest residual of ``plumb_bob`` with which it is published [px]."""
GRID = (25, 19)
"""The number of columns and rows of the pixels of a fit."""
N_ROUNDS = 6
"""The number of fits of the rational model."""


@dataclass(frozen=True, kw_only=True)
class DistortionFit:
    """The distortion in the words of CameraInfo."""

    model: Model
    """The model of the coefficients."""
    coefficients: tuple[float, ...]
    """The coefficients, in the order of ROS and OpenCV."""
    residual: float
    """The greatest distance of a pixel of the grid from the model [px]."""


@lru_cache(maxsize=64)
def fit_distortion(camera: Intrinsics) -> DistortionFit:
    """Fit a model of distortion to a camera with a lens."""
    columns = np.linspace(0.0, camera.width - 1.0, GRID[0])
    rows = np.linspace(0.0, camera.height - 1.0, GRID[1])
    u, v = (grid.ravel() for grid in np.meshgrid(columns, rows))
    yd = (v - camera.cy) / camera.fy
    xd = (u - camera.cx + camera.skew * yd) / camera.fx
    assert camera.lens is not None
    x, y = camera.lens.undistort(xd, yd)
    points = x, y, xd, yd
    focal = math.sqrt(camera.fx * camera.fy)
    plumb_bob = _fit_plumb_bob(points)
    residual = focal * _find_residual(points, plumb_bob)
    if residual <= PLUMB_BOB_LIMIT:
        return DistortionFit(model="plumb_bob", coefficients=plumb_bob, residual=residual)
    rational = _fit_rational(points)
    rational_residual = focal * _find_residual(points, rational)
    if rational_residual >= residual:
        return DistortionFit(model="plumb_bob", coefficients=plumb_bob, residual=residual)
    return DistortionFit(
        model="rational_polynomial", coefficients=rational, residual=rational_residual
    )


Points = tuple[Array, Array, Array, Array]
"""The ideal coordinates x and y, then those in the image."""


def apply_model(coefficients: tuple[float, ...], x: Array, y: Array) -> tuple[Array, Array]:
    """Return the image coordinates of ideal ones by a model of five or eight coefficients."""
    k1, k2, p1, p2, k3, *rest = coefficients
    k4, k5, k6 = rest or (0.0, 0.0, 0.0)
    square = x * x + y * y
    radial = 1.0 + square * (k1 + square * (k2 + square * k3))
    radial = radial / (1.0 + square * (k4 + square * (k5 + square * k6)))
    return (
        x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x),
        y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y,
    )


def _find_residual(points: Points, coefficients: tuple[float, ...]) -> float:
    """Return the greatest distance between the model and the points [1]."""
    x, y, xd, yd = points
    model_x, model_y = apply_model(coefficients, x, y)
    return float(np.sqrt((model_x - xd) ** 2 + (model_y - yd) ** 2).max())


def _fit_plumb_bob(points: Points) -> tuple[float, ...]:
    x, y, xd, yd = points
    square = x * x + y * y
    columns = [
        _join(x * square, y * square),
        _join(x * square**2, y * square**2),
        _join(2.0 * x * y, square + 2.0 * y * y),
        _join(square + 2.0 * x * x, 2.0 * x * y),
        _join(x * square**3, y * square**3),
    ]
    return _solve(columns, _join(xd - x, yd - y))


def _fit_rational(points: Points) -> tuple[float, ...]:
    x, y, xd, yd = points
    square = x * x + y * y
    coefficients: tuple[float, ...] = (0.0,) * 8
    for _ in range(N_ROUNDS):
        _, _, p1, p2, _, k4, k5, k6 = coefficients
        denominator = 1.0 + square * (k4 + square * (k5 + square * k6))
        # The tangential part is taken from the last fit where the denominator multiplies it.
        radial_x = xd - (2.0 * p1 * x * y + p2 * (square + 2.0 * x * x))
        radial_y = yd - (p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y)
        columns = [
            _join(x * square / denominator, y * square / denominator),
            _join(x * square**2 / denominator, y * square**2 / denominator),
            _join(2.0 * x * y, square + 2.0 * y * y),
            _join(square + 2.0 * x * x, 2.0 * x * y),
            _join(x * square**3 / denominator, y * square**3 / denominator),
            *(
                _join(-radial_x * square**k / denominator, -radial_y * square**k / denominator)
                for k in (1, 2, 3)
            ),
        ]
        right = _join(xd - x / denominator, yd - y / denominator)
        right -= _join(radial_x * (1.0 - 1.0 / denominator), radial_y * (1.0 - 1.0 / denominator))
        coefficients = _solve(columns, right)
    return coefficients


def _join(first: Array, second: Array) -> Array:
    equations: Array = np.concatenate([first, second])
    return equations


def _solve(columns: list[Array], right: Array) -> tuple[float, ...]:
    """Solve linear equations by least squares: Gram and Schmidt's method, twice for each column.

    Sums are exact (`math.fsum`), so that the result does not depend on the processor. A column that
    depends on those before gets 0.
    """
    basis: list[Array] = []
    triangle: list[list[float]] = []
    for column in columns:
        rest, shares = column.copy(), [0.0] * len(basis)
        for _ in range(2):
            for i, vector in enumerate(basis):
                share = _multiply(vector, rest)
                shares[i] += share
                rest = rest - share * vector
        norm, full_norm = math.sqrt(_multiply(rest, rest)), math.sqrt(_multiply(column, column))
        is_new = norm > 1e-12 * full_norm
        basis.append(rest / norm if is_new else np.zeros_like(rest))
        triangle.append([*shares, norm if is_new else 0.0])
    solution = [0.0] * len(columns)
    products = [_multiply(vector, right) for vector in basis]
    for i in reversed(range(len(columns))):
        if triangle[i][i] > 0.0:
            terms = [triangle[j][i] * solution[j] for j in range(i + 1, len(columns))]
            solution[i] = (products[i] - math.fsum(terms)) / triangle[i][i]
    return tuple(solution)


def _multiply(first: Array, second: Array) -> float:
    return math.fsum((first * second).tolist())
