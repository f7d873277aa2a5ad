"""Some rays from one point at once, compiled: they go down a tree together, or one alone.

Whether any of them can enter a box is asked by the bounds of their directions, as in `entry`. A
triangle is tried for all of them with what they have in common, the origin (A. Kensler, P. Shirley,
*Optimizing ray-triangle intersection via automated search*, IEEE Symposium on Interactive Ray
Tracing, 2006); the distance of the triangle found is then computed as for a single ray.
"""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .triangle import TOUCH, Point, Trees, Whole, inverse, placed

GROUP = 16
"""Rays that go together at most."""
Bounds = tuple[Point, Point]
"""Lower and upper bounds of one over the components of directions; see `bounds_of`."""
DX, DY, DZ, BEGIN, NEAR, HIT = (GROUP * k for k in range(6))
"""Where the directions, the limits and the triangles of the rays are in an array of lanes."""
LANES = 6 * GROUP


@njit
def fill_lanes(
    lanes: Array,
    frame: Array,
    directions: Array,
    rays: tuple[int, int],
    limits: tuple[Array, Array],
) -> Bounds:
    """Take some rays; return the bounds of one over their directions, lower and upper.

    Args:
        lanes: set to directions and limits, without a triangle.
        frame: ``body_from_world``, (4, 4).
        directions: of all rays in W, (n, 3).
        rays: the first one and beyond the last, `GROUP` at most.
        limits: from where on and before where each ray hits, (n,) each [m].
    """
    begins, nearest = limits
    first, end = rays
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for k in range(end - first):
        i = first + k
        dx, dy, dz = placed(frame, directions[i, 0], directions[i, 1], directions[i, 2], 0.0)
        lanes[DX + k], lanes[DY + k], lanes[DZ + k] = dx, dy, dz
        lanes[BEGIN + k], lanes[NEAR + k], lanes[HIT + k] = begins[i], nearest[i], -1.0
        x0, y0, z0 = min(x0, dx), min(y0, dy), min(z0, dz)
        x1, y1, z1 = max(x1, dx), max(y1, dy), max(z1, dz)
    return bounds_of((x0, y0, z0), (x1, y1, z1))


@njit
def bounds_of(low: Point, high: Point) -> Bounds:
    """Bounds of one over directions between bounds; of both signs where these are."""
    x, y, z = _inverses(low[0], high[0]), _inverses(low[1], high[1]), _inverses(low[2], high[2])
    return (x[0], y[0], z[0]), (x[1], y[1], z[1])


@njit
def _inverses(low: float, high: float) -> tuple[float, float]:
    """Bounds of one over components between bounds; of both signs where these are."""
    of_low, of_high = inverse(low), inverse(high)
    return (of_low, of_high) if of_low < of_high else (of_high, of_low)


@njit
def find_nearest(
    trees: Trees,
    root: int,
    beam: tuple[Point, Bounds],
    lanes: Array,
    n: int,
    stack: Whole,
    entries: Array,
) -> None:
    """Set the nearest triangle of a body on each ray.

    Args:
        trees: of the bodies.
        root: of this body.
        beam: origin of the rays; bounds of one over their directions.
        lanes: of the rays.
        n: how many they are.
        stack: for nodes that wait.
        entries: for where rays enter those.
    """
    origin, bounds = beam
    n_waiting, node = 0, root
    reach = _farthest(lanes, n)
    while True:
        box = trees.boxes[node]
        first_at = enters(box, 0, origin, bounds, reach)
        second_at = enters(box, 6, origin, bounds, reach)
        near, far = 0, 2
        if second_at < first_at:
            near, far = 2, 0
            first_at, second_at = second_at, first_at
        node_after = -1
        if first_at < reach:
            where, count = trees.links[node, near], trees.links[node, near + 1]
            if count:
                _try_leaf(trees, where, where + count, origin, lanes, n)
                reach = _farthest(lanes, n)
            else:
                node_after = where
        if second_at < reach:
            where, count = trees.links[node, far], trees.links[node, far + 1]
            if count:
                _try_leaf(trees, where, where + count, origin, lanes, n)
                reach = _farthest(lanes, n)
            elif node_after < 0:
                node_after = where
            else:
                stack[n_waiting], entries[n_waiting] = where, second_at
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
def _farthest(lanes: Array, n: int) -> float:
    """How far a triangle can be and yet be the nearest of one of the rays [m]."""
    farthest: float = lanes[NEAR]
    for k in range(1, n):
        farthest = max(farthest, lanes[NEAR + k])
    return farthest


@njit
def enters(box: Array, first: int, origin: Point, bounds: Bounds, reach: float) -> float:
    """Before where no ray enters a box; infinite where none enters it before ``reach`` [m]."""
    low, high = bounds
    enter, leave = 0.0, reach
    for axis in range(3):
        near, far = box[first + axis] - origin[axis], box[first + 3 + axis] - origin[axis]
        if low[axis] < 0.0 < high[axis]:  # to both sides: a box beside the origin is reached late
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
def _try_leaf(trees: Trees, first: int, end: int, origin: Point, lanes: Array, n: int) -> None:
    """Try the triangles of a leaf for all rays."""
    for triangle in range(first, end):
        t = trees.triangles[triangle]
        sx, sy, sz = origin[0] - t[0], origin[1] - t[1], origin[2] - t[2]
        nx, ny, nz = t[5] * t[7] - t[4] * t[8], t[3] * t[8] - t[5] * t[6], t[4] * t[6] - t[3] * t[7]
        ux, uy, uz = t[7] * sz - t[8] * sy, t[8] * sx - t[6] * sz, t[6] * sy - t[7] * sx
        vx, vy, vz = sy * t[5] - sz * t[4], sz * t[3] - sx * t[5], sx * t[4] - sy * t[3]
        along = t[6] * vx + t[7] * vy + t[8] * vz
        least = -np.inf if trees.surfaces[triangle, 1] else 0.0
        number = float(triangle)
        for k in range(n):
            dx, dy, dz = lanes[DX + k], lanes[DY + k], lanes[DZ + k]
            determinant = dx * nx + dy * ny + dz * nz
            inverse_of = 1.0 / (determinant if determinant != 0.0 else np.nan)
            u = (dx * ux + dy * uy + dz * uz) * inverse_of
            v = (dx * vx + dy * vy + dz * vz) * inverse_of
            at = along * inverse_of
            is_hit = (
                (determinant > least)
                & (u >= -TOUCH)
                & (v >= -TOUCH)
                & (u + v <= 1.0 + TOUCH)
                & (at > lanes[BEGIN + k])
                & (at < lanes[NEAR + k])
            )
            lanes[NEAR + k] = at if is_hit else lanes[NEAR + k]
            lanes[HIT + k] = number if is_hit else lanes[HIT + k]
