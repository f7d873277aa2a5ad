"""The triangles of bodies, and their compiled intersection with rays.

The algorithm is described by T. Moller, B. Trumbore, *Fast, minimum storage ray-triangle
intersection*, Journal of Graphics Tools 2(1), 1997. An edge belongs to both triangles that share
it, with a tolerance (`EDGE_TOLERANCE`), so that no ray passes between two triangles of a mesh.
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
"""The direction of a ray (3 components), and the distance at which the ray begins [m]."""
EDGE_TOLERANCE = 1e-9
"""The distance outside a triangle at which a ray still hits it, as a fraction of its side
lengths."""
MIN_COMPONENT = 1e-300
"""The replacement of a zero component of a direction."""


class Trees(NamedTuple):
    """The bounding volume trees of b bodies, one after the other, each in the body's frame."""

    boxes: Array
    """The lower and upper corner of the box of each node's two children, (k, 12) [m]."""
    links: IntArray
    """The node of each child and 0; or, of a leaf, its first triangle and its number of
    triangles, (k, 4)."""
    triangles: Array
    """A corner and two edges of each triangle, in the order of the leaves, (n, 9) [m]."""
    surfaces: IntArray
    """The surface index of each triangle, and 1 if the surface is two-sided, (n, 2)."""
    roots: IntArray
    """The root node of each body's tree, (b,)."""
    balls: Array
    """The centre and radius of each body's bounding ball, in the body's frame, (b, 4) [m]."""


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
    """Return the inverse of a component of a direction, or a very large number for zero."""
    return 1.0 / (component if abs(component) > MIN_COMPONENT else MIN_COMPONENT)


@njit
def distance_to_triangle(t: Array, origin: Point, ray: Ray) -> float:
    """Return the distance along a ray to a triangle; infinite without a hit [m].

    Args:
        t: the triangle, as in `Trees.triangles`, (9,) [m].
        origin: the origin of the ray in the frame of the body [m].
        ray: the direction in the frame of the body, and the distance at which the ray begins [m].
    """
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
