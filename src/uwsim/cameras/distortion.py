r"""Radial and tangential distortion: the model ``plumb_bob`` of ROS and OpenCV.

With :math:`r^2 = x^2 + y^2` of the ideal normalised coordinates (x right, y down),

.. math::
    x_d &= x (1 + k_1 r^2 + k_2 r^4 + k_3 r^6) + 2 p_1 x y + p_2 (r^2 + 2 x^2) \\
    y_d &= y (1 + k_1 r^2 + k_2 r^4 + k_3 r^6) + p_1 (r^2 + 2 y^2) + 2 p_2 x y

(Brown 1966; the coefficients are in the order of CameraInfo: k1, k2, p1, p2, k3.)
"""

from __future__ import annotations

import math

from ..base.numerics.jit import njit
from ..base.numerics.linear import Array

N_COEFFICIENTS = 5
"""The number of coefficients."""
MAX_ITERATIONS = 100
TOLERANCE = 1e-13
"""The change of coordinates at which the inversion ends [1]."""


@njit
def distort_point(x: float, y: float, coefficients: Array) -> tuple[float, float]:
    """Return the distorted coordinates of one point."""
    k1, k2, p1, p2, k3 = (
        coefficients[0],
        coefficients[1],
        coefficients[2],
        coefficients[3],
        coefficients[4],
    )
    square = x * x + y * y
    radial = 1.0 + square * (k1 + square * (k2 + square * k3))
    return (
        x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x),
        y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y,
    )


@njit
def undistort_point(u: float, v: float, coefficients: Array) -> tuple[float, float]:
    """Return the coordinates that `distort_point` maps to a point, by Newton's method.

    The result is NaN if the method does not converge: there is no such point, or the distortion
    folds the image.
    """
    k1, k2, p1, p2, k3 = (
        coefficients[0],
        coefficients[1],
        coefficients[2],
        coefficients[3],
        coefficients[4],
    )
    x, y = u, v
    for _ in range(MAX_ITERATIONS):
        square = x * x + y * y
        radial = 1.0 + square * (k1 + square * (k2 + square * k3))
        slope = 2.0 * (k1 + square * (2.0 * k2 + square * 3.0 * k3))  # of radial, over x
        error_x = x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x) - u
        error_y = y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y - v
        a = radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x
        b = x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y
        d = radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x
        determinant = a * d - b * b
        if not determinant > 0.0 or radial <= 0.0:
            return math.nan, math.nan
        step_x = (d * error_x - b * error_y) / determinant
        step_y = (a * error_y - b * error_x) / determinant
        x -= step_x
        y -= step_y
        if abs(step_x) + abs(step_y) < TOLERANCE:
            return x, y
    return math.nan, math.nan
