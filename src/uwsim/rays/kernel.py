"""Compiled ray casting against triangles: the exact first hit of each ray from a common origin.

Neighbouring rays traverse the trees of triangles together (`packet`); divergent rays traverse them
one by one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .bodies import (
    Bodies,
    Cone,
    EngineFrames,
    find_near_bodies,
    is_missed,
    update_boxes,
    update_frames,
)
from .packet import (
    DX,
    DY,
    DZ,
    GROUP_SIZE,
    HIT,
    N_LANES,
    NEAR,
    Bounds,
    bounds_of,
    fill_lanes,
    find_nearest,
)
from .triangle import IntArray, Trees, distance_to_triangle, transform_point

MIN_GROUP_COSINE = 0.97
"""The minimum cosine of the angle between the first and any other ray of a group; 14 degrees."""
STACK_SIZE = 128
"""The largest number of nodes that wait while the nearer child is traversed."""


class Hits(NamedTuple):
    """The first hits of rays."""

    distance: Array
    """The distance along the ray; infinite without a hit, (n,) [m]."""
    normal: Array
    """The unit normal in W, towards the origin of the ray; zero without a hit, (n, 3)."""
    surface: IntArray
    """The index of the surface that is hit; -1 without a hit, (n,)."""


@njit
def cast_rays(
    trees: Trees,
    bodies: Bodies,
    engine_frames: EngineFrames,
    origin: Array,
    directions: Array,
    limits: tuple[Array, float],
    hits: Hits,
) -> None:
    """Find the first hits of rays.

    Args:
        trees: the triangles of the bodies.
        bodies: the poses of the bodies.
        engine_frames: the frames of the engine's bodies.
        origin: the origin of the rays in W, (3,) [m].
        directions: unit vectors in W, (n, 3).
        limits: the distance at which each ray begins, (n,), and the length of all rays [m].
        hits: receives the first hits.
    """
    starts, reach = limits
    n = len(directions)
    hits.distance[:] = reach
    update_boxes(bodies, engine_frames)
    hit_triangles = np.full(n, -1)  # the nearest triangle of each ray
    hit_bodies = np.zeros(n, dtype=np.int32)
    stack, entries = np.empty(STACK_SIZE, dtype=np.int32), np.empty(STACK_SIZE)
    node_stack = np.empty(len(bodies.links) + 1, dtype=np.int32)
    near_bodies = np.empty(len(bodies.balls), dtype=np.int32)
    lanes = np.empty(N_LANES)
    steps = _group_sizes(directions)
    origin_point = origin[0], origin[1], origin[2]
    start = 0
    while start < n:
        end = min(start + steps[start // GROUP_SIZE], n)
        cone = _cone_around(directions, start, end)
        beam = _bounds(directions, start, end), cone
        n_near = find_near_bodies(
            bodies, engine_frames, origin_point, beam, reach, node_stack, near_bodies
        )
        max_distance = reach
        for number in range(n_near):
            body = near_bodies[number]
            if max_distance < reach and is_missed(
                bodies, engine_frames, body, origin_point, cone, max_distance
            ):
                continue
            update_frames(bodies, engine_frames, body)
            f = bodies.body_from_world[body]
            local_origin = transform_point(f, origin[0], origin[1], origin[2], 1.0)
            bounds = fill_lanes(lanes, f, directions, (start, end), (starts, hits.distance))
            rays = local_origin, bounds
            find_nearest(trees, trees.roots[body], rays, lanes, end - start, stack, entries)
            max_distance = 0.0
            for i in range(start, end):
                k = i - start
                triangle = int(lanes[HIT + k])
                if triangle >= 0:
                    ray = (lanes[DX + k], lanes[DY + k], lanes[DZ + k], starts[i])
                    distance = distance_to_triangle(trees.triangles[triangle], local_origin, ray)
                    hits.distance[i] = distance if distance < np.inf else lanes[NEAR + k]
                    hit_triangles[i], hit_bodies[i] = triangle, body
                max_distance = max(max_distance, hits.distance[i])
        start = end
    for i in range(n):
        if hit_triangles[i] < 0:
            hits.distance[i], hits.surface[i] = np.inf, -1
            hits.normal[i] = 0.0
        else:
            hits.surface[i] = trees.surfaces[hit_triangles[i], 0]
            if i > 0 and hit_triangles[i] == hit_triangles[i - 1]:
                for k in range(3):
                    hits.normal[i, k] = hits.normal[i - 1, k]
            else:
                f = bodies.body_from_world[hit_bodies[i]]
                _set_normal(hits.normal[i], trees.triangles[hit_triangles[i]], f)
            _turn_against_ray(hits.normal[i], directions[i])


@njit
def _bounds(directions: Array, start: int, end: int) -> Bounds:
    """Return bounds of the inverse directions of the rays from ``start`` to ``end``."""
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for i in range(start, end):
        x, y, z = directions[i, 0], directions[i, 1], directions[i, 2]
        x0, y0, z0 = min(x0, x), min(y0, y), min(z0, z)
        x1, y1, z1 = max(x1, x), max(y1, y), max(z1, z)
    return bounds_of((x0, y0, z0), (x1, y1, z1))


@njit
def _group_sizes(directions: Array) -> IntArray:
    """Return the number of rays that traverse together in each group; 1 if the rays diverge."""
    steps = np.empty((len(directions) + GROUP_SIZE - 1) // GROUP_SIZE, dtype=np.int32)
    for group in range(len(steps)):
        start = group * GROUP_SIZE
        min_cosine = 1.0
        for i in range(start + 1, min(start + GROUP_SIZE, len(directions))):
            cosine = 0.0
            for axis in range(3):
                cosine += directions[start, axis] * directions[i, axis]
            min_cosine = min(min_cosine, cosine)
        steps[group] = GROUP_SIZE if min_cosine >= MIN_GROUP_COSINE else 1
    return steps


@njit
def _cone_around(directions: Array, start: int, end: int) -> Cone:
    """Return a cone around the rays from ``start`` to ``end``."""
    x = y = z = 0.0
    for i in range(start, end):
        x, y, z = x + directions[i, 0], y + directions[i, 1], z + directions[i, 2]
    size = math.sqrt(x * x + y * y + z * z)
    if size <= 1e-9 * (end - start):
        return Cone((x, y, z), math.pi)
    x, y, z = x / size, y / size, z / size
    cosine = 1.0
    for i in range(start, end):
        projection = x * directions[i, 0] + y * directions[i, 1] + z * directions[i, 2]
        cosine = min(cosine, projection)
    return Cone((x, y, z), math.acos(max(cosine, -1.0)) + 1e-6)


@njit
def _set_normal(normal: Array, t: Array, f: Array) -> None:
    """Write the unit normal of a triangle in W.

    Args:
        normal: receives the normal, (3,).
        t: the triangle, as in `Trees.triangles`, (9,).
        f: ``body_from_world``, whose transpose transforms normals, (4, 4).
    """
    nx, ny, nz = t[4] * t[8] - t[5] * t[7], t[5] * t[6] - t[3] * t[8], t[3] * t[7] - t[4] * t[6]
    for axis in range(3):
        normal[axis] = f[0, axis] * nx + f[1, axis] * ny + f[2, axis] * nz
    size = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    for axis in range(3):
        normal[axis] /= size


@njit
def _turn_against_ray(normal: Array, direction: Array) -> None:
    """Reverse a normal that points along the ray."""
    projection = normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2]
    if projection > 0.0:
        for axis in range(3):
            normal[axis] = -normal[axis]
