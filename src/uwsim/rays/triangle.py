"""Triangles of bodies, and where a ray meets one, compiled.

A ray meets a triangle by T. Moller, B. Trumbore, *Fast, minimum storage ray-triangle intersection*,
Journal of Graphics Tools 2(1), 1997. Edges belong to both of their triangles, and a little more
(`TOUCH`): no ray passes between two triangles of one mesh.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit

Whole = npt.NDArray[np.int32]
Point = tuple[float, float, float]
Ray = tuple[float, float, float, float]
"""Direction, and where it begins to hit [m]."""
TOUCH = 1e-9
"""How far outside of a triangle a ray still hits it, as a share of its sides."""
TINY = 1e-300
"""Takes the place of a component of a direction that is zero."""


class Trees(NamedTuple):
    """The trees of all bodies, one after the other, each in the frame of its body."""

    boxes: Array
    """Of both children of a node, (k, 12) [m]."""
    links: Whole
    """Of both children of a node: where and how many, (k, 4)."""
    triangles: Array
    """Corner and two edges, in the order of the leaves, (n, 9) [m]."""
    surfaces: Whole
    """Number of the surface, and whether both sides are seen, (n, 2)."""
    roots: Whole
    """First node of each body, (b,)."""
    balls: Array
    """Centre and radius of a ball around each body, in its frame, (b, 4) [m]."""


@njit
def placed(f: Array, x: float, y: float, z: float, w: float) -> Point:
    """A point (w = 1) or a direction (w = 0) in another frame, by the matrix f (4, 4)."""
    return (
        f[0, 0] * x + f[0, 1] * y + f[0, 2] * z + f[0, 3] * w,
        f[1, 0] * x + f[1, 1] * y + f[1, 2] * z + f[1, 3] * w,
        f[2, 0] * x + f[2, 1] * y + f[2, 2] * z + f[2, 3] * w,
    )


@njit
def inverse(component: float) -> float:
    """One over a component of a direction; very much for zero."""
    return 1.0 / (component if abs(component) > TINY else TINY)


@njit
def meets_triangle(t: Array, origin: Point, ray: Ray) -> float:
    """Where a ray meets a triangle that is not seen from behind; infinite where it does not [m]."""
    dx, dy, dz, begin = ray
    px, py, pz = dy * t[8] - dz * t[7], dz * t[6] - dx * t[8], dx * t[7] - dy * t[6]
    determinant = t[3] * px + t[4] * py + t[5] * pz
    if determinant == 0.0:
        return np.inf
    inverse = 1.0 / determinant
    sx, sy, sz = origin[0] - t[0], origin[1] - t[1], origin[2] - t[2]
    u = (sx * px + sy * py + sz * pz) * inverse
    if u < -TOUCH or u > 1.0 + TOUCH:
        return np.inf
    qx, qy, qz = sy * t[5] - sz * t[4], sz * t[3] - sx * t[5], sx * t[4] - sy * t[3]
    v = (dx * qx + dy * qy + dz * qz) * inverse
    if v < -TOUCH or u + v > 1.0 + TOUCH:
        return np.inf
    at = (t[6] * qx + t[7] * qy + t[8] * qz) * inverse
    return at if at > begin else np.inf
