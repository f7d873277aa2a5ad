r"""Simplification of meshes by a greatest error in metres.

Edges are collapsed in the order of their quadric error (M. Garland, P. S. Heckbert, *Surface
simplification using quadric error metrics*, SIGGRAPH 1997). The smallest number of triangles is
searched for which

.. math:: \max_{p} \min_{q} \lVert p - q \rVert \le e

holds both ways: p are the corners of the one surface and q all points of the other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .convex_faces import Ints, numbered

N_TRIALS = 8
"""Numbers of triangles that are tried at most."""
SIZE = 10.0
"""To which a mesh is scaled: the thresholds of the simplification are lengths. Measured on rocks
and pipes: with 1 the error is up to ten times as large, with 30 edges are left that need not be."""
LEAST = 12
"""Triangles that are left at least."""
FIRST = 0.05
"""Share of the triangles that is tried first."""
GOOD = 0.8
"""An error that is at least this share of the one allowed ends the search."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Simplified:
    """A mesh of fewer triangles."""

    triangles: Array
    """Its faces, turning as the mesh's do, (n, 3, 3) [m]."""
    error: float
    """Its greatest distance from the mesh [m]."""


def simplified(triangles: Array, error: float, at_most: int) -> Simplified:
    """Simplify a mesh as far as an error allows, and to a number of triangles in any case.

    Args:
        triangles: its faces, (n, 3, 3) [m].
        error: greatest distance allowed between the surfaces [m].
        at_most: triangles that may be left; where the error needs more it is exceeded.
    """
    points, faces = _welded(triangles)
    if not len(faces):
        return Simplified(triangles=triangles, error=0.0)
    mesh = _Mesh(points, faces)
    many = min(at_most, len(faces))
    best = mesh.collapsed(many, math.inf)
    if best.error > error or error <= 0.0:
        return best
    few, n = LEAST, round(FIRST * len(faces))
    for _ in range(N_TRIALS):
        n = min(max(n, few + 1), many - 1)
        if n <= few:
            break
        found = mesh.collapsed(n, 4.0 * error)
        if found.error <= error:
            best, many = found, n
            if found.error >= GOOD * error:
                break
        else:
            few = n
        # of a smooth surface the error is inversely proportional to the number of triangles
        n = round(n * min(max(found.error / (0.85 * error), 0.2), 5.0))
        if not few < n < many:
            n = round(math.sqrt(few * many))
    return best


def _welded(triangles: Array) -> tuple[Array, Ints]:
    """Corners that lie apart, (k, 3) [m], and their numbers in each face that has area, (n, 3)."""
    corners = triangles.reshape(-1, 3)
    numbers = numbered(corners)
    points = np.empty((int(numbers.max(initial=-1)) + 1, 3))
    points[numbers[::-1]] = corners[::-1]  # of equal ones the first
    faces = numbers.reshape(-1, 3)
    apart = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return points, faces[apart]


class _Mesh:
    """A mesh and what distances from it need.

    Args:
        points: its corners, (k, 3) [m].
        faces: their numbers in each face, (n, 3).
    """

    def __init__(self, points: Array, faces: Ints) -> None:
        self._points, self._faces = points, faces
        self._surface = _Surface(points[faces])
        self._low = points.min(axis=0)
        size = float((points.max(axis=0) - self._low).max())  # [m]
        self._unit = max(size / SIZE, 1e-9)

    def collapsed(self, n: int, enough: float) -> Simplified:
        """Collapse edges until about n triangles are left; an error above ``enough`` is one."""
        if n >= len(self._faces):
            return Simplified(triangles=self._surface.triangles, error=0.0)
        import fast_simplification

        scaled = ((self._points - self._low) / self._unit).astype(np.float32)
        corners, numbers = fast_simplification.simplify(
            scaled, self._faces.astype(np.int32), target_count=n
        )
        points = self._low + self._unit * np.asarray(corners, np.float64)
        if not len(numbers):
            return Simplified(triangles=self._surface.triangles, error=math.inf)
        left = _Surface(points[np.asarray(numbers, np.int64)])
        error = left.distance(self._points, enough)
        if error < enough:
            error = max(error, self._surface.distance(points, enough))
        return Simplified(triangles=left.triangles, error=error)


class _Surface:
    """Triangles (n, 3, 3) with the middle and the radius of a ball around each [m]."""

    def __init__(self, triangles: Array) -> None:
        self.triangles = np.ascontiguousarray(triangles)
        a, b, c = (triangles[:, k] for k in range(3))
        self._middles = (a + b + c) / 3.0
        arms = [each - self._middles for each in (a, b, c)]
        squares = [x * x + y * y + z * z for x, y, z in (arm.T for arm in arms)]
        self._radii = np.sqrt(np.maximum(np.maximum(*squares[:2]), squares[2]))

    def distance(self, points: Array, enough: float) -> float:
        """Greatest distance of points (n, 3) from the surface [m]; ends above ``enough``."""
        return _farthest(points, self.triangles, self._middles, self._radii, enough)


@njit
def _farthest(
    points: Array, triangles: Array, middles: Array, radii: Array, enough: float
) -> float:
    """Greatest distance of points from triangles, whose middles and radii are given [m]."""
    worst, last = 0.0, 0
    for i in range(len(points)):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        best = _squared(x, y, z, triangles[last])
        reach = math.sqrt(best)
        for k in range(len(triangles)):
            if best <= worst:
                break  # it is no farther than another
            dx, dy, dz = x - middles[k, 0], y - middles[k, 1], z - middles[k, 2]
            far = reach + radii[k]
            if dx * dx + dy * dy + dz * dz >= far * far:
                continue
            squared = _squared(x, y, z, triangles[k])
            if squared < best:
                best, last = squared, k
                reach = math.sqrt(best)
        worst = max(worst, best)
        if worst > enough * enough:
            break
    return math.sqrt(worst)


@njit
def _squared(x: float, y: float, z: float, triangle: Array) -> float:
    """Square of the distance of a point from a triangle (3, 3) [m2].

    By the regions of C. Ericson, *Real-time collision detection*, 2005, section 5.1.5.
    """
    ax, ay, az = triangle[0, 0], triangle[0, 1], triangle[0, 2]
    ux, uy, uz = triangle[1, 0] - ax, triangle[1, 1] - ay, triangle[1, 2] - az
    vx, vy, vz = triangle[2, 0] - ax, triangle[2, 1] - ay, triangle[2, 2] - az
    px, py, pz = x - ax, y - ay, z - az
    uu, uv, vv = (
        ux * ux + uy * uy + uz * uz,
        ux * vx + uy * vy + uz * vz,
        vx * vx + vy * vy + vz * vz,
    )
    up, vp = ux * px + uy * py + uz * pz, vx * px + vy * py + vz * pz
    area = uu * vv - uv * uv
    s, t = vv * up - uv * vp, uu * vp - uv * up
    if area > 0.0 and s >= 0.0 and t >= 0.0 and s + t <= area:
        s, t = s / area, t / area
    else:  # nearest to an edge
        best_s, best_t, best = 0.0, 0.0, math.inf
        for edge in range(3):
            if edge == 0:
                share = up / uu if uu > 0.0 else 0.0
                s, t = min(max(share, 0.0), 1.0), 0.0
            elif edge == 1:
                share = vp / vv if vv > 0.0 else 0.0
                s, t = 0.0, min(max(share, 0.0), 1.0)
            else:
                ww = uu - 2.0 * uv + vv
                share = (vp - up + uu - uv) / ww if ww > 0.0 else 0.0
                t = min(max(share, 0.0), 1.0)
                s = 1.0 - t
            qx, qy, qz = px - s * ux - t * vx, py - s * uy - t * vy, pz - s * uz - t * vz
            squared = qx * qx + qy * qy + qz * qz
            if squared < best:
                best_s, best_t, best = s, t, squared
        s, t = best_s, best_t
    qx, qy, qz = px - s * ux - t * vx, py - s * uy - t * vy, pz - s * uz - t * vz
    found: float = qx * qx + qy * qy + qz * qz
    return found
