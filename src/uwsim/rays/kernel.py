"""Ray casting against triangles, compiled: the exact first hit of each ray from one point.

Rays that are neighbours go together (`packet`); those that go apart search alone.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .packet import DX, DY, DZ, GROUP, HIT, LANES, NEAR, fill_lanes, find_nearest
from .triangle import Trees, Whole, meets_triangle, placed

CLOSE = 0.97
"""Least cosine of the angles between rays that go together, 14 degrees."""
DEEPEST = 128
"""Nodes that can wait while the nearer child is looked at."""


class Hits(NamedTuple):
    """The first hits of rays."""

    distance: Array
    """Along the ray; infinite where nothing is hit, (n,) [m]."""
    normal: Array
    """Unit normal in W, towards the origin of the ray; zero where nothing is hit, (n, 3)."""
    surface: Whole
    """Number of the surface; -1 where nothing is hit, (n,)."""


@njit
def cast_rays(
    trees: Trees,
    frames: tuple[Array, Array],
    origin: Array,
    directions: Array,
    limits: tuple[Array, float],
    hits: Hits,
) -> None:
    """Find the first hits of rays.

    Args:
        trees: of the bodies.
        frames: ``world_from_body`` and ``body_from_world`` of the bodies, (b, 4, 4) each.
        origin: where the rays begin, in W, (3,) [m].
        directions: of the rays in W, unit vectors, (n, 3).
        limits: from where on each ray hits, (n,), and how far all go [m].
        hits: for the results.
    """
    world_from_body, body_from_world = frames
    begins, reach = limits
    n = len(directions)
    hits.distance[:] = reach
    last = np.full(n, -1)  # the triangle that a ray hits
    whose = np.zeros(n, dtype=np.int32)
    stack, entries = np.empty(DEEPEST, dtype=np.int32), np.empty(DEEPEST)
    lanes = np.empty(LANES)
    steps = _steps(directions)
    axis, half_angle = _cone(directions)
    for body in range(len(trees.roots)):
        if _is_missed(trees.balls[body], world_from_body[body], origin, axis, half_angle, reach):
            continue
        f = body_from_world[body]
        begin = placed(f, origin[0], origin[1], origin[2], 1.0)
        first = 0
        while first < n:
            end = min(first + steps[first // GROUP], n)
            low, high = fill_lanes(lanes, f, directions, (first, end), (begins, hits.distance))
            beam = begin, low, high
            find_nearest(trees, trees.roots[body], beam, lanes, end - first, stack, entries)
            for i in range(first, end):
                k = i - first
                triangle = int(lanes[HIT + k])
                if triangle < 0:
                    continue
                ray = (lanes[DX + k], lanes[DY + k], lanes[DZ + k], begins[i])
                at = meets_triangle(trees.triangles[triangle], begin, ray)
                hits.distance[i] = at if at < np.inf else lanes[NEAR + k]
                last[i], whose[i] = triangle, body
            first = end
    for i in range(n):
        if last[i] < 0:
            hits.distance[i], hits.surface[i] = np.inf, -1
            hits.normal[i] = 0.0
        else:
            hits.surface[i] = trees.surfaces[last[i], 0]
            if i > 0 and last[i] == last[i - 1]:
                for k in range(3):
                    hits.normal[i, k] = hits.normal[i - 1, k]
            else:
                _set_normal(hits.normal[i], trees.triangles[last[i]], body_from_world[whose[i]])
            _turn_towards(hits.normal[i], directions[i])


@njit
def _steps(directions: Array) -> Whole:
    """How many rays go together in each group: all, or each alone where they go apart."""
    steps = np.empty((len(directions) + GROUP - 1) // GROUP, dtype=np.int32)
    for group in range(len(steps)):
        first = group * GROUP
        least = 1.0
        for i in range(first + 1, min(first + GROUP, len(directions))):
            cosine = 0.0
            for axis in range(3):
                cosine += directions[first, axis] * directions[i, axis]
            least = min(least, cosine)
        steps[group] = GROUP if least >= CLOSE else 1
    return steps


@njit
def _cone(directions: Array) -> tuple[Array, float]:
    """Axis and half angle [rad] of a cone around all rays."""
    axis = np.zeros(3)
    for i in range(len(directions)):
        for k in range(3):
            axis[k] += directions[i, k]
    size = math.sqrt(axis[0] ** 2 + axis[1] ** 2 + axis[2] ** 2)
    if size <= 1e-9 * len(directions):
        return axis, math.pi
    axis /= size
    cosine = 1.0
    for i in range(len(directions)):
        along = axis[0] * directions[i, 0] + axis[1] * directions[i, 1] + axis[2] * directions[i, 2]
        cosine = min(cosine, along)
    return axis, math.acos(max(cosine, -1.0)) + 1e-6


@njit
def _is_missed(
    ball: Array, frame: Array, origin: Array, axis: Array, half_angle: float, reach: float
) -> bool:
    """Whether no ray of a cone comes near a body."""
    x, y, z = placed(frame, ball[0], ball[1], ball[2], 1.0)
    x, y, z = x - origin[0], y - origin[1], z - origin[2]
    stretch = 0.0
    for row in range(3):
        for column in range(3):
            stretch += frame[row, column] ** 2
    radius = ball[3] * math.sqrt(stretch)  # at least the greatest factor
    distance = math.sqrt(x * x + y * y + z * z)
    if distance <= radius:
        return False
    if distance - radius > reach:
        return True
    along = (x * axis[0] + y * axis[1] + z * axis[2]) / distance
    between = math.acos(min(max(along, -1.0), 1.0))
    return between > half_angle + math.asin(radius / distance)


@njit
def _set_normal(normal: Array, t: Array, f: Array) -> None:
    """Unit normal of a triangle in W: the transpose of ``body_from_world`` takes it there."""
    nx, ny, nz = t[4] * t[8] - t[5] * t[7], t[5] * t[6] - t[3] * t[8], t[3] * t[7] - t[4] * t[6]
    for axis in range(3):
        normal[axis] = f[0, axis] * nx + f[1, axis] * ny + f[2, axis] * nz
    size = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    for axis in range(3):
        normal[axis] /= size


@njit
def _turn_towards(normal: Array, direction: Array) -> None:
    """Let a normal point against the ray."""
    along = normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2]
    if along > 0.0:
        for axis in range(3):
            normal[axis] = -normal[axis]
