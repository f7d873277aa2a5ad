"""Ray casting against triangles, compiled: the exact first hit of each ray from one point.

Rays that are neighbours go together (`packet`); those that go apart search alone.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .bodies import Bodies, Cone, Engine, find_near, follow, is_missed, renew_frames
from .packet import (
    DX,
    DY,
    DZ,
    GROUP,
    HIT,
    LANES,
    NEAR,
    Bounds,
    bounds_of,
    fill_lanes,
    find_nearest,
)
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
    bodies: Bodies,
    place: Engine,
    origin: Array,
    directions: Array,
    limits: tuple[Array, float],
    hits: Hits,
) -> None:
    """Find the first hits of rays.

    Args:
        trees: of the bodies.
        bodies: where they are.
        place: where those are that some of them follow.
        origin: where the rays begin, in W, (3,) [m].
        directions: of the rays in W, unit vectors, (n, 3).
        limits: from where on each ray hits, (n,), and how far all go [m].
        hits: for the results.
    """
    begins, reach = limits
    n = len(directions)
    hits.distance[:] = reach
    follow(bodies, place)
    last = np.full(n, -1)  # the triangle that a ray hits
    whose = np.zeros(n, dtype=np.int32)
    stack, entries = np.empty(DEEPEST, dtype=np.int32), np.empty(DEEPEST)
    waiting = np.empty(len(bodies.links) + 1, dtype=np.int32)
    near = np.empty(len(bodies.balls), dtype=np.int32)
    lanes = np.empty(LANES)
    steps = _steps(directions)
    here = origin[0], origin[1], origin[2]
    first = 0
    while first < n:
        end = min(first + steps[first // GROUP], n)
        cone = _cone(directions, first, end)
        beam = _bounds(directions, first, end), cone
        n_near = find_near(bodies, place, here, beam, reach, waiting, near)
        farthest = reach
        for number in range(n_near):
            body = near[number]
            if farthest < reach and is_missed(bodies, place, body, here, cone, farthest):
                continue
            renew_frames(bodies, place, body)
            f = bodies.body_from_world[body]
            begin = placed(f, origin[0], origin[1], origin[2], 1.0)
            bounds = fill_lanes(lanes, f, directions, (first, end), (begins, hits.distance))
            rays = begin, bounds
            find_nearest(trees, trees.roots[body], rays, lanes, end - first, stack, entries)
            farthest = 0.0
            for i in range(first, end):
                k = i - first
                triangle = int(lanes[HIT + k])
                if triangle >= 0:
                    ray = (lanes[DX + k], lanes[DY + k], lanes[DZ + k], begins[i])
                    at = meets_triangle(trees.triangles[triangle], begin, ray)
                    hits.distance[i] = at if at < np.inf else lanes[NEAR + k]
                    last[i], whose[i] = triangle, body
                farthest = max(farthest, hits.distance[i])
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
                f = bodies.body_from_world[whose[i]]
                _set_normal(hits.normal[i], trees.triangles[last[i]], f)
            _turn_towards(hits.normal[i], directions[i])


@njit
def _bounds(directions: Array, first: int, end: int) -> Bounds:
    """Bounds of one over the directions of some rays."""
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for i in range(first, end):
        x, y, z = directions[i, 0], directions[i, 1], directions[i, 2]
        x0, y0, z0 = min(x0, x), min(y0, y), min(z0, z)
        x1, y1, z1 = max(x1, x), max(y1, y), max(z1, z)
    return bounds_of((x0, y0, z0), (x1, y1, z1))


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
def _cone(directions: Array, first: int, end: int) -> Cone:
    """A cone around some rays."""
    x = y = z = 0.0
    for i in range(first, end):
        x, y, z = x + directions[i, 0], y + directions[i, 1], z + directions[i, 2]
    size = math.sqrt(x * x + y * y + z * z)
    if size <= 1e-9 * (end - first):
        return Cone((x, y, z), math.pi)
    x, y, z = x / size, y / size, z / size
    cosine = 1.0
    for i in range(first, end):
        along = x * directions[i, 0] + y * directions[i, 1] + z * directions[i, 2]
        cosine = min(cosine, along)
    return Cone((x, y, z), math.acos(max(cosine, -1.0)) + 1e-6)


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
