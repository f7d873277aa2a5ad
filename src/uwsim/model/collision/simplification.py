r"""Simplification of meshes within an error in metres.

Edges are collapsed in the order of their quadric error (M. Garland, P. S. Heckbert, *Surface
simplification using quadric error metrics*, SIGGRAPH 1997). The search finds the smallest number of
triangles for which the error e is not exceeded,

.. math:: \max_{p} \min_{q} \lVert p - q \rVert \le e

where p are the corners of one surface and q all points of the other, in both directions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .convex_faces import Ints, number_corners

N_TRIALS = 8
"""The greatest number of simplifications that are tried."""
SCALED_SIZE = 10.0
"""The size to which a mesh is scaled, because the library that collapses edges has thresholds in
lengths. On rocks and pipes, 1 gives errors up to ten times as large, and 30 leaves more edges."""
MIN_TRIANGLES = 12
"""The minimum number of triangles after simplification."""
FIRST_SHARE = 0.05
"""The fraction of triangles that remain in the first trial [1]."""
GOOD_ERROR_SHARE = 0.8
"""The fraction of the allowed error at which the search ends [1]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SimpleMesh:
    """A simplified mesh."""

    triangles: Array
    """The triangles, in the orientation of the original mesh, (n, 3, 3) [m]."""
    error: float
    """The greatest distance from the original mesh [m]."""


def simplify(triangles: Array, error: float, max_triangles: int) -> SimpleMesh:
    """Simplify a mesh as far as an error allows, but at least to a number of triangles.

    Args:
        triangles: the faces of the mesh, (n, 3, 3) [m].
        error: the greatest distance allowed between the surfaces [m].
        max_triangles: the greatest number of triangles; it takes precedence over the error.
    """
    points, faces = _weld(triangles)
    if not len(faces):
        return SimpleMesh(triangles=triangles, error=0.0)
    mesh = _Mesh(points, faces)
    upper = min(max_triangles, len(faces))
    best_mesh = mesh.collapse(upper, math.inf)
    if best_mesh.error > error or error <= 0.0:
        return best_mesh
    lower, n = MIN_TRIANGLES, round(FIRST_SHARE * len(faces))
    for _ in range(N_TRIALS):
        n = min(max(n, lower + 1), upper - 1)
        if n <= lower:
            break
        simple_mesh = mesh.collapse(n, 4.0 * error)
        if simple_mesh.error <= error:
            best_mesh, upper = simple_mesh, n
            if simple_mesh.error >= GOOD_ERROR_SHARE * error:
                break
        else:
            lower = n
        # the error of a smooth surface is inversely proportional to the number of triangles
        n = round(n * min(max(simple_mesh.error / (0.85 * error), 0.2), 5.0))
        if not lower < n < upper:
            n = round(math.sqrt(lower * upper))
    return best_mesh


def _weld(triangles: Array) -> tuple[Array, Ints]:
    """Return the distinct corners, (k, 3) [m], and their indices in each face, (n, 3)."""
    corners = triangles.reshape(-1, 3)
    numbers = number_corners(corners)
    points = np.empty((int(numbers.max(initial=-1)) + 1, 3))
    points[numbers[::-1]] = corners[::-1]  # the first of equal corners
    faces = numbers.reshape(-1, 3)
    has_area = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return points, faces[has_area]


class _Mesh:
    """A mesh that is simplified, with the surface from which errors are measured.

    Args:
        points: the corners of the mesh, (k, 3) [m].
        faces: the indices of the corners of each face, (n, 3).
    """

    def __init__(self, points: Array, faces: Ints) -> None:
        self._points, self._faces = points, faces
        self._surface = _Surface(points[faces])
        self._low = points.min(axis=0)
        size = float((points.max(axis=0) - self._low).max())  # [m]
        self._unit = max(size / SCALED_SIZE, 1e-9)

    def collapse(self, n: int, limit: float) -> SimpleMesh:
        """Collapse edges until about n triangles remain; errors above ``limit`` are not exact."""
        if n >= len(self._faces):
            return SimpleMesh(triangles=self._surface.triangles, error=0.0)
        import fast_simplification

        scaled_points = ((self._points - self._low) / self._unit).astype(np.float32)
        corners, numbers = fast_simplification.simplify(
            scaled_points, self._faces.astype(np.int32), target_count=n
        )
        points = self._low + self._unit * np.asarray(corners, np.float64)
        if not len(numbers):
            return SimpleMesh(triangles=self._surface.triangles, error=math.inf)
        surface = _Surface(points[np.asarray(numbers, np.int64)])
        error = surface.distance(self._points, limit)
        if error < limit:
            error = max(error, self._surface.distance(points, limit))
        return SimpleMesh(triangles=surface.triangles, error=error)


class _Surface:
    """The triangles of a surface, (n, 3, 3) [m], each with a ball around it."""

    def __init__(self, triangles: Array) -> None:
        self.triangles = np.ascontiguousarray(triangles)
        a, b, c = (triangles[:, k] for k in range(3))
        self._centres = (a + b + c) / 3.0
        arms = [corners - self._centres for corners in (a, b, c)]
        squares = [x * x + y * y + z * z for x, y, z in (arm.T for arm in arms)]
        self._radii = np.sqrt(np.maximum(np.maximum(*squares[:2]), squares[2]))

    def distance(self, points: Array, limit: float) -> float:
        """Compute the greatest distance of points (n, 3) from the surface [m], up to ``limit``."""
        return _max_distance(points, self.triangles, self._centres, self._radii, limit)


@njit
def _max_distance(
    points: Array, triangles: Array, centres: Array, radii: Array, limit: float
) -> float:
    """Compute the greatest distance of points from triangles [m], up to ``limit``.

    ``centres`` (n, 3) and ``radii`` (n,) [m] describe a ball around each triangle.
    """
    max_squared, nearest_index = 0.0, 0
    for i in range(len(points)):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        min_squared = _distance_squared(x, y, z, triangles[nearest_index])
        min_distance = math.sqrt(min_squared)
        for k in range(len(triangles)):
            if min_squared <= max_squared:
                break  # another point is farther
            dx, dy, dz = x - centres[k, 0], y - centres[k, 1], z - centres[k, 2]
            bound = min_distance + radii[k]
            if dx * dx + dy * dy + dz * dz >= bound * bound:
                continue
            distance_squared = _distance_squared(x, y, z, triangles[k])
            if distance_squared < min_squared:
                min_squared, nearest_index = distance_squared, k
                min_distance = math.sqrt(min_squared)
        max_squared = max(max_squared, min_squared)
        if max_squared > limit * limit:
            break
    return math.sqrt(max_squared)


@njit
def _distance_squared(x: float, y: float, z: float, triangle: Array) -> float:
    """Compute the squared distance of a point from a triangle (3, 3) [m2].

    The regions are those of C. Ericson, *Real-time collision detection*, 2005, section 5.1.5.
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
        best_s, best_t, min_squared = 0.0, 0.0, math.inf
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
            q_squared = qx * qx + qy * qy + qz * qz
            if q_squared < min_squared:
                best_s, best_t, min_squared = s, t, q_squared
        s, t = best_s, best_t
    qx, qy, qz = px - s * ux - t * vx, py - s * uy - t * vy, pz - s * uz - t * vz
    result: float = qx * qx + qy * qy + qz * qz
    return result
