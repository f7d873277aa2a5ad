"""The compiled traversal of a tree of triangles by a group of rays from a common origin.

The bounds of the directions decide whether any ray of the group can enter a box (`box_entry`). The
terms of the intersection with a triangle that depend only on the common origin are computed once
for all rays (A. Kensler, P. Shirley, *Optimizing ray-triangle intersection via automated search*,
IEEE Symposium on Interactive Ray Tracing, 2006). The distance to the nearest triangle is then
computed as for a single ray.
"""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .triangle import EDGE_TOLERANCE, IntArray, Point, Trees, inverse, transform_point

GROUP_SIZE = 16
"""The largest number of rays in a group."""
Bounds = tuple[Point, Point]
"""The lower and upper bounds of the inverse components of directions; see `bounds_of`."""
DX, DY, DZ, BEGIN, NEAR, HIT = (GROUP_SIZE * k for k in range(6))
"""The offsets in an array of lanes, each for `GROUP_SIZE` rays: the direction in the frame of the
body, the distances [m] from which and up to which a ray can hit, and its nearest triangle or -1."""
N_LANES = 6 * GROUP_SIZE
"""The length of an array of lanes."""


@njit
def fill_lanes(
    lanes: Array,
    frame: Array,
    directions: Array,
    rays: tuple[int, int],
    limits: tuple[Array, Array],
) -> Bounds:
    """Fill the lanes with a group of rays; return the bounds of their inverse directions.

    Args:
        lanes: receives the directions and limits, and no triangles.
        frame: ``body_from_world``, (4, 4).
        directions: the directions of all rays in W, (n, 3).
        rays: the start and the end of the group among the rays, at most `GROUP_SIZE` apart.
        limits: the distances from which and up to which each ray can hit, (n,) each [m].
    """
    starts, ends = limits
    start, end = rays
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for k in range(end - start):
        i = start + k
        dx, dy, dz = transform_point(
            frame, directions[i, 0], directions[i, 1], directions[i, 2], 0.0
        )
        lanes[DX + k], lanes[DY + k], lanes[DZ + k] = dx, dy, dz
        lanes[BEGIN + k], lanes[NEAR + k], lanes[HIT + k] = starts[i], ends[i], -1.0
        x0, y0, z0 = min(x0, dx), min(y0, dy), min(z0, dz)
        x1, y1, z1 = max(x1, dx), max(y1, dy), max(z1, dz)
    return bounds_of((x0, y0, z0), (x1, y1, z1))


@njit
def bounds_of(low: Point, high: Point) -> Bounds:
    """Return the bounds of the inverses of directions between ``low`` and ``high``.

    If the bounds of a component have different signs, the inverses of values between them lie
    outside the returned bounds; `box_entry` treats this case.
    """
    x, y, z = _inverses(low[0], high[0]), _inverses(low[1], high[1]), _inverses(low[2], high[2])
    return (x[0], y[0], z[0]), (x[1], y[1], z[1])


@njit
def _inverses(low: float, high: float) -> tuple[float, float]:
    """Return the inverses of two bounds of a component, in ascending order."""
    inverse_low, inverse_high = inverse(low), inverse(high)
    if inverse_low < inverse_high:
        return inverse_low, inverse_high
    return inverse_high, inverse_low


@njit
def find_nearest(
    trees: Trees,
    root: int,
    beam: tuple[Point, Bounds],
    lanes: Array,
    n: int,
    stack: IntArray,
    entries: Array,
) -> None:
    """Find the nearest triangle of a body on each ray of a group.

    Args:
        trees: the triangles of the bodies.
        root: the root of the body's tree.
        beam: the origin of the rays in the body's frame [m], and the bounds of their inverse
            directions.
        lanes: the lanes of the rays, which receive the triangles and distances.
        n: the number of rays.
        stack: a workspace for nodes.
        entries: a workspace for the distances at which rays enter these nodes.
    """
    origin, bounds = beam
    n_waiting, node = 0, root
    reach = _max_distance(lanes, n)
    while True:
        box = trees.boxes[node]
        first_entry = box_entry(box, 0, origin, bounds, reach)
        second_entry = box_entry(box, 6, origin, bounds, reach)
        near, far = 0, 2
        if second_entry < first_entry:
            near, far = 2, 0
            first_entry, second_entry = second_entry, first_entry
        node_after = -1
        if first_entry < reach:
            child, count = trees.links[node, near], trees.links[node, near + 1]
            if count:
                _intersect_leaf(trees, child, child + count, origin, lanes, n)
                reach = _max_distance(lanes, n)
            else:
                node_after = child
        if second_entry < reach:
            child, count = trees.links[node, far], trees.links[node, far + 1]
            if count:
                _intersect_leaf(trees, child, child + count, origin, lanes, n)
                reach = _max_distance(lanes, n)
            elif node_after < 0:
                node_after = child
            else:
                stack[n_waiting], entries[n_waiting] = child, second_entry
                n_waiting += 1
        if node_after >= 0:
            node = node_after
            continue
        while n_waiting and entries[n_waiting - 1] >= reach:
            n_waiting -= 1
        if not n_waiting:
            return
        n_waiting -= 1
        node = stack[n_waiting]


@njit
def _max_distance(lanes: Array, n: int) -> float:
    """Return the largest distance at which a triangle can still be the first hit of a ray [m]."""
    max_distance: float = lanes[NEAR]
    for k in range(1, n):
        max_distance = max(max_distance, lanes[NEAR + k])
    return max_distance


@njit
def box_entry(box: Array, column: int, origin: Point, bounds: Bounds, reach: float) -> float:
    """Return a lower bound of the distance of rays to a box; infinite if above ``reach`` [m].

    Args:
        box: the boxes of both children of a node, (12,) [m].
        column: the first column of the box, 0 or 6.
        origin: the origin of the rays in the frame of the box [m].
        bounds: the bounds of the inverse directions.
        reach: the length of the rays [m].
    """
    low, high = bounds
    enter, leave = 0.0, reach
    for axis in range(3):
        near, far = box[column + axis] - origin[axis], box[column + 3 + axis] - origin[axis]
        if low[axis] < 0.0 < high[axis]:  # rays to both sides: the steepest enters first
            if near > 0.0:
                enter = max(enter, near * high[axis])
            elif far < 0.0:
                enter = max(enter, far * low[axis])
            continue
        if high[axis] < 0.0:
            near, far = far, near
        enter = max(enter, min(near * low[axis], near * high[axis]))
        leave = min(leave, max(far * low[axis], far * high[axis]))
    return enter if enter <= leave * (1.0 + 1e-12) else np.inf


@njit
def _intersect_leaf(
    trees: Trees, start: int, end: int, origin: Point, lanes: Array, n: int
) -> None:
    """Intersect the triangles of a leaf with all rays."""
    for triangle in range(start, end):
        t = trees.triangles[triangle]
        sx, sy, sz = origin[0] - t[0], origin[1] - t[1], origin[2] - t[2]
        nx, ny, nz = t[5] * t[7] - t[4] * t[8], t[3] * t[8] - t[5] * t[6], t[4] * t[6] - t[3] * t[7]
        ux, uy, uz = t[7] * sz - t[8] * sy, t[8] * sx - t[6] * sz, t[6] * sy - t[7] * sx
        vx, vy, vz = sy * t[5] - sz * t[4], sz * t[3] - sx * t[5], sx * t[4] - sy * t[3]
        numerator = t[6] * vx + t[7] * vy + t[8] * vz
        min_determinant = -np.inf if trees.surfaces[triangle, 1] else 0.0
        number = float(triangle)
        for k in range(n):
            dx, dy, dz = lanes[DX + k], lanes[DY + k], lanes[DZ + k]
            determinant = dx * nx + dy * ny + dz * nz
            inverse_of = 1.0 / (determinant if determinant != 0.0 else np.nan)
            u = (dx * ux + dy * uy + dz * uz) * inverse_of
            v = (dx * vx + dy * vy + dz * vz) * inverse_of
            distance = numerator * inverse_of
            is_hit = (
                (determinant > min_determinant)
                & (u >= -EDGE_TOLERANCE)
                & (v >= -EDGE_TOLERANCE)
                & (u + v <= 1.0 + EDGE_TOLERANCE)
                & (distance > lanes[BEGIN + k])
                & (distance < lanes[NEAR + k])
            )
            lanes[NEAR + k] = distance if is_hit else lanes[NEAR + k]
            lanes[HIT + k] = number if is_hit else lanes[HIT + k]
