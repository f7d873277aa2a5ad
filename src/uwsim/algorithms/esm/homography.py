r"""Homographies as elements of SL(3), the group of 3x3 matrices of determinant 1.

A step of a tracker is a vector :math:`x \in R^8` of coordinates in the tangent space sl(3), whose
basis are the generators :math:`A_i`. It is applied as
:math:`H \leftarrow H \exp(\sum_i x_i A_i)` (Benhimane and Malis, IROS 2004).
Points are image coordinates [px] from the centre of the top left pixel, unless they are called
normalised.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import determinant, product, solve


@njit
def exponential(x: Array) -> Array:
    r"""Return :math:`\exp(\sum_i x_i A_i)` for x (8,), a homography of determinant 1, (3, 3).

    The generators :math:`A_i`, of trace 0, move the points (u, v) of the plane: 0 right, 1 down,
    2 shear along u, 3 shear along v, 4 stretch along u and compress along v, 5 scale, 6 and 7
    perspective along u and v. The method is scaling and squaring with a Taylor series of order 8,
    accurate to 1e-12 for \|x\| < 1.
    """
    a = np.empty((3, 3))
    a[0, 0], a[0, 1], a[0, 2] = x[4] + x[5] / 3.0, x[2], x[0]
    a[1, 0], a[1, 1], a[1, 2] = x[3], -x[4] + x[5] / 3.0, x[1]
    a[2, 0], a[2, 1], a[2, 2] = x[6], x[7], -2.0 * x[5] / 3.0
    max_entry = np.abs(a).max()
    halvings = 0
    while max_entry > 0.1 and halvings < 30:
        max_entry *= 0.5
        halvings += 1
    a *= 0.5**halvings
    matrix = np.eye(3)
    term = np.eye(3)
    for order in range(1, 9):
        term = multiply(term, a) / order
        matrix += term
    for _ in range(halvings):
        matrix = multiply(matrix, matrix)
    return matrix


@njit
def multiply(left: Array, right: Array) -> Array:
    """Multiply two (3, 3) matrices, with a fixed order of the additions."""
    product = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            product[i, j] = (
                left[i, 0] * right[0, j] + left[i, 1] * right[1, j] + left[i, 2] * right[2, j]
            )
    return product


def normalize_determinant(homography: Array) -> Array:
    """Scale a homography to determinant 1."""
    matrix: Array = homography / math.cbrt(determinant(homography))
    return matrix


def warp(homography: Array, points: Array) -> Array:
    """Apply a homography (3, 3) to points (n, 2); return the points (n, 2)."""
    homogeneous_points = product(points, homography[:, :2].T) + homography[:, 2]
    image_points: Array = homogeneous_points[:, :2] / homogeneous_points[:, 2:]
    return image_points


def homography_between(source: Array, target: Array) -> Array:
    """Compute the homography of determinant 1 that maps four points (4, 2) to four others (4, 2).

    Raises:
        numpy.linalg.LinAlgError: three points are collinear.
    """
    rows = []
    for (u, v), (x, y) in zip(source, target, strict=True):
        rows.append([u, v, 1.0, 0.0, 0.0, 0.0, -x * u, -x * v])
        rows.append([0.0, 0.0, 0.0, u, v, 1.0, -y * u, -y * v])
    entries = solve(np.array(rows), target.reshape(8))
    return normalize_determinant(np.append(entries, 1.0).reshape(3, 3))


def corner_areas(quad: Array) -> Array:
    """Return twice the signed area of the triangle at each corner of a quad (4, 2) [px], (4,)."""
    next_edges = np.roll(quad, -1, axis=0) - quad
    previous_edges = quad - np.roll(quad, 1, axis=0)
    areas: Array = previous_edges[:, 0] * next_edges[:, 1] - previous_edges[:, 1] * next_edges[:, 0]
    return areas


def is_convex(quad: Array) -> bool:
    """Return whether a quad (4, 2) is convex."""
    areas = corner_areas(quad)
    return bool(np.all(areas > 0.0) or np.all(areas < 0.0))
