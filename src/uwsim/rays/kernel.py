"""Ray casting against triangles, compiled: the exact first hit of each ray from one point.

A ray meets a triangle by T. Moller, B. Trumbore, *Fast, minimum storage ray-triangle intersection*,
Journal of Graphics Tools 2(1), 1997. Edges belong to both of their triangles, and a little more
(`TOUCH`): no ray passes between two triangles of one mesh.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..geometry import Array
from ..numerics.jit import njit

Whole = npt.NDArray[np.int32]
Ray = tuple[float, float, float, float, float, float, float, float, float, float]
"""Origin, direction, one over the components of the direction, and where it begins to hit [m]."""
TOUCH = 1e-9
"""How far outside of a triangle a ray still hits it, as a share of its sides."""
TINY = 1e-300
"""Takes the place of a component of a direction that is zero."""
GROUP = 8
"""Rays that begin their search at a node of their own, found for all of them."""
DEEPEST = 128
"""Nodes that can wait while the nearer child is looked at."""


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
    axis, half_angle = _cone(directions)
    for body in range(len(trees.roots)):
        if _is_missed(trees.balls[body], world_from_body[body], origin, axis, half_angle, reach):
            continue
        f = body_from_world[body]
        x, y, z = _placed(f, origin[0], origin[1], origin[2], 1.0)
        hint, entry = -1, -1
        for i in range(n):
            if i % GROUP == 0:
                entry = _entry(trees, trees.roots[body], f, (x, y, z), directions, i, reach)
            if entry < 0:
                continue
            dx, dy, dz = _placed(f, directions[i, 0], directions[i, 1], directions[i, 2], 0.0)
            ray = (x, y, z, dx, dy, dz, _inverse(dx), _inverse(dy), _inverse(dz), begins[i])
            nearest, triangle = hits.distance[i], -1
            if hint >= 0:  # rays that are neighbours often hit the same triangle
                at = _meets_triangle(trees.triangles[hint], trees.surfaces[hint, 1], ray)
                if at < nearest:
                    nearest, triangle = at, hint
            nearest, triangle = _nearest(trees, entry, ray, nearest, triangle, stack, entries)
            hint = triangle
            if triangle >= 0:
                hits.distance[i], last[i], whose[i] = nearest, triangle, body
    for i in range(n):
        if last[i] < 0:
            hits.distance[i], hits.surface[i] = np.inf, -1
            hits.normal[i] = 0.0
        else:
            hits.surface[i] = trees.surfaces[last[i], 0]
            _set_normal(hits.normal[i], trees.triangles[last[i]], body_from_world[whose[i]])
            _turn_towards(hits.normal[i], directions[i])


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
    x, y, z = _placed(frame, ball[0], ball[1], ball[2], 1.0)
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
def _placed(f: Array, x: float, y: float, z: float, w: float) -> tuple[float, float, float]:
    return (
        f[0, 0] * x + f[0, 1] * y + f[0, 2] * z + f[0, 3] * w,
        f[1, 0] * x + f[1, 1] * y + f[1, 2] * z + f[1, 3] * w,
        f[2, 0] * x + f[2, 1] * y + f[2, 2] * z + f[2, 3] * w,
    )


@njit
def _inverse(component: float) -> float:
    return 1.0 / (component if abs(component) > TINY else TINY)


@njit
def _entry(
    trees: Trees,
    root: int,
    f: Array,
    origin: tuple[float, float, float],
    directions: Array,
    first: int,
    reach: float,
) -> int:
    """The node below which is all that a group of rays can hit; -1 where that is nothing."""
    low = high = (0.0, 0.0, 0.0)
    for i in range(first, min(first + GROUP, len(directions))):
        dx, dy, dz = _placed(f, directions[i, 0], directions[i, 1], directions[i, 2], 0.0)
        x, y, z = _inverse(dx), _inverse(dy), _inverse(dz)
        if i == first:
            low = high = (x, y, z)
        low = (min(low[0], x), min(low[1], y), min(low[2], z))
        high = (max(high[0], x), max(high[1], y), max(high[2], z))
    node = root
    while True:
        is_first = _can_enter(trees.boxes[node], 0, origin, low, high, reach)
        is_second = _can_enter(trees.boxes[node], 6, origin, low, high, reach)
        if is_first and is_second:
            return node
        if not is_first and not is_second:
            return -1
        child = 0 if is_first else 2
        if trees.links[node, child + 1]:
            return node
        node = trees.links[node, child]


@njit
def _can_enter(
    box: Array,
    first: int,
    origin: tuple[float, float, float],
    low: tuple[float, float, float],
    high: tuple[float, float, float],
    reach: float,
) -> bool:
    """Whether any of several rays can enter a box, by the bounds of their inverse directions."""
    enter, leave = 0.0, reach
    for axis in range(3):
        if low[axis] < 0.0 < high[axis]:
            continue
        near, far = box[first + axis] - origin[axis], box[first + 3 + axis] - origin[axis]
        if high[axis] < 0.0:
            near, far = far, near
        enter = max(enter, min(near * low[axis], near * high[axis]))
        leave = min(leave, max(far * low[axis], far * high[axis]))
    return enter <= leave * (1.0 + 1e-12)


@njit
def _nearest(
    trees: Trees, root: int, ray: Ray, nearest: float, hit: int, stack: Whole, entries: Array
) -> tuple[float, int]:
    """The nearest triangle of a body on a ray before ``nearest``; else what was given."""
    n_waiting, node = 0, root
    while True:
        first_at = _enters(trees.boxes[node], 0, ray, nearest)
        second_at = _enters(trees.boxes[node], 6, ray, nearest)
        near, far = 0, 2
        if second_at < first_at:
            near, far = 2, 0
            first_at, second_at = second_at, first_at
        node_after = -1
        if first_at < nearest:
            where, count = trees.links[node, near], trees.links[node, near + 1]
            if count:
                nearest, hit = _in_leaf(trees, where, where + count, ray, nearest, hit)
            else:
                node_after = where
        if second_at < nearest:
            where, count = trees.links[node, far], trees.links[node, far + 1]
            if count:
                nearest, hit = _in_leaf(trees, where, where + count, ray, nearest, hit)
            elif node_after < 0:
                node_after = where
            else:
                stack[n_waiting], entries[n_waiting] = where, second_at
                n_waiting += 1
        if node_after >= 0:
            node = node_after
            continue
        while n_waiting and entries[n_waiting - 1] >= nearest:
            n_waiting -= 1
        if not n_waiting:
            return nearest, hit
        n_waiting -= 1
        node = stack[n_waiting]


@njit
def _enters(box: Array, first: int, ray: Ray, nearest: float) -> float:
    """Where a ray enters a box; infinite where it does not before ``nearest`` [m]."""
    enter, leave = 0.0, nearest
    for axis in range(3):
        a = (box[first + axis] - ray[axis]) * ray[6 + axis]
        b = (box[first + 3 + axis] - ray[axis]) * ray[6 + axis]
        if a > b:
            a, b = b, a
        enter = a if a > enter else enter
        leave = b if b < leave else leave
    return enter if enter <= leave * (1.0 + 1e-12) else np.inf


@njit
def _in_leaf(
    trees: Trees, first: int, end: int, ray: Ray, nearest: float, hit: int
) -> tuple[float, int]:
    for k in range(first, end):
        at = _meets_triangle(trees.triangles[k], trees.surfaces[k, 1], ray)
        if at < nearest:
            nearest, hit = at, k
    return nearest, hit


@njit
def _meets_triangle(t: Array, is_two_sided: int, ray: Ray) -> float:
    """Where a ray meets a triangle; infinite where it does not, or from behind [m]."""
    dx, dy, dz = ray[3], ray[4], ray[5]
    px, py, pz = dy * t[8] - dz * t[7], dz * t[6] - dx * t[8], dx * t[7] - dy * t[6]
    determinant = t[3] * px + t[4] * py + t[5] * pz
    if determinant == 0.0 or (determinant < 0.0 and not is_two_sided):
        return np.inf
    inverse = 1.0 / determinant
    sx, sy, sz = ray[0] - t[0], ray[1] - t[1], ray[2] - t[2]
    u = (sx * px + sy * py + sz * pz) * inverse
    if u < -TOUCH or u > 1.0 + TOUCH:
        return np.inf
    qx, qy, qz = sy * t[5] - sz * t[4], sz * t[3] - sx * t[5], sx * t[4] - sy * t[3]
    v = (dx * qx + dy * qy + dz * qz) * inverse
    if v < -TOUCH or u + v > 1.0 + TOUCH:
        return np.inf
    at = (t[6] * qx + t[7] * qy + t[8] * qz) * inverse
    return at if at > ray[9] else np.inf


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
