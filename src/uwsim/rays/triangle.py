"""Triangles of bodies, and their intersection with rays, compiled.

The intersection is that of T. Moller, B. Trumbore, *Fast, minimum storage ray-triangle
intersection*, Journal of Graphics Tools 2(1), 1997. Edges belong to both of their triangles, with a
tolerance (`EDGE_TOLERANCE`). No ray passes between two triangles of one mesh.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit

IntArray = npt.NDArray[np.int32]
Point = tuple[float, float, float]
Ray = tuple[float, float, float, float]
"""The direction, and the distance from which it can hit [m]."""
EDGE_TOLERANCE = 1e-9
"""The distance outside a triangle at which a ray still hits it, as a share of its sides."""
MIN_COMPONENT = 1e-300
"""The replacement of a zero component of a direction."""


class Trees(NamedTuple):
    """The trees of all bodies, one after the other, each in the frame of its body."""

    boxes: Array
    """The boxes of both children of a node, (k, 12) [m]."""
    links: IntArray
    """The start and the number of triangles of both children of a node, (k, 4)."""
    triangles: Array
    """The corner and two edges of each triangle, in the order of the leaves, (n, 9) [m]."""
    surfaces: IntArray
    """The number of the surface, and 1 if it is two-sided, (n, 2)."""
    roots: IntArray
    """The first node of each body, (b,)."""
    balls: Array
    """The centre and radius of a ball around each body, in its frame, (b, 4) [m]."""


@njit
def transform_point(f: Array, x: float, y: float, z: float, w: float) -> Point:
    """Transform a point (w = 1) or a direction (w = 0) by the matrix f (4, 4)."""
    return (
        f[0, 0] * x + f[0, 1] * y + f[0, 2] * z + f[0, 3] * w,
        f[1, 0] * x + f[1, 1] * y + f[1, 2] * z + f[1, 3] * w,
        f[2, 0] * x + f[2, 1] * y + f[2, 2] * z + f[2, 3] * w,
    )


@njit
def inverse(component: float) -> float:
    """Return the inverse of a component of a direction; a very large number for zero."""
    return 1.0 / (component if abs(component) > MIN_COMPONENT else MIN_COMPONENT)


@njit
def distance_to_triangle(t: Array, origin: Point, ray: Ray) -> float:
    """Return the distance along a ray to a triangle; infinite without a hit [m]."""
    dx, dy, dz, begin = ray
    px, py, pz = dy * t[8] - dz * t[7], dz * t[6] - dx * t[8], dx * t[7] - dy * t[6]
    determinant = t[3] * px + t[4] * py + t[5] * pz
    if determinant == 0.0:
        return np.inf
    inverse = 1.0 / determinant
    sx, sy, sz = origin[0] - t[0], origin[1] - t[1], origin[2] - t[2]
    u = (sx * px + sy * py + sz * pz) * inverse
    if u < -EDGE_TOLERANCE or u > 1.0 + EDGE_TOLERANCE:
        return np.inf
    qx, qy, qz = sy * t[5] - sz * t[4], sz * t[3] - sx * t[5], sx * t[4] - sy * t[3]
    v = (dx * qx + dy * qy + dz * qz) * inverse
    if v < -EDGE_TOLERANCE or u + v > 1.0 + EDGE_TOLERANCE:
        return np.inf
    distance = (t[6] * qx + t[7] * qy + t[8] * qz) * inverse
    return distance if distance > begin else np.inf
