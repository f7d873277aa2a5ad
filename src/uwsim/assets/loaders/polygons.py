"""Cuts polygons into triangles, those that are not convex by their ears.

A fan from the first corner covers the notches of a polygon that is not convex. An ear is a corner
whose triangle lies inside and holds no other corner; one is cut off after the other (Meisters,
"Polygons have ears", 1975). A hole that an edge connects with the outline is left open.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

Points = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]

MAX_CORNERS = 1000
"""Corners of a polygon beyond which it is cut as a fan: the time grows with their square."""
FLAT = 1e-9
"""How far a corner may turn the other way in a convex polygon, relative to the squared size."""


def cut(points: Points, counts: Indices) -> Indices:
    """Return the triangles of polygons, in their order.

    Args:
        points: the corners of all polygons, one polygon after the other, (n, 3).
        counts: how many corners each has, (m,).

    Returns:
        Numbers of corners, (k, 3).
    """
    counts = np.asarray(counts, dtype=np.int64)
    starts = np.cumsum(counts) - counts
    triangles = _fans(starts, counts)
    firsts = np.cumsum(np.maximum(counts - 2, 0)) - np.maximum(counts - 2, 0)
    for i in not_convex(np.asarray(points, dtype=np.float64), starts, counts):
        start, n, first = int(starts[i]), int(counts[i]), int(firsts[i])
        triangles[first : first + n - 2] = start + ears(points[start : start + n])
    return triangles


def _fans(starts: Indices, counts: Indices) -> Indices:
    """The triangles of each polygon from its first corner."""
    n = np.maximum(counts - 2, 0)
    owner = np.repeat(np.arange(len(counts)), n)
    within = np.arange(n.sum()) - np.repeat(np.cumsum(n) - n, n)
    first = starts[owner]
    return np.stack([first, first + within + 1, first + within + 2], axis=-1)


def not_convex(points: Points, starts: Indices, counts: Indices) -> Iterator[int]:
    """Give the numbers of polygons with a corner that turns the other way, (n, 3), (m,), (m,)."""
    chosen = np.flatnonzero((counts > 3) & (counts <= MAX_CORNERS))
    for n in np.unique(counts[chosen]):
        which = chosen[counts[chosen] == n]
        corners = points[starts[which, None] + np.arange(n)]  # (polygons, n, 3)
        corners = corners - corners[:, :1]
        to_next = np.roll(corners, -1, axis=1) - corners
        turns = np.cross(np.roll(to_next, 1, axis=1), to_next)
        normals = np.cross(corners, np.roll(corners, -1, axis=1)).sum(axis=1)
        lengths = np.linalg.norm(normals, axis=-1)
        along = (turns * normals[:, None]).sum(axis=-1)
        size = np.abs(corners).max(axis=(1, 2)) ** 2
        yield from which[(along < -FLAT * (size * lengths)[:, None]).any(axis=1)].tolist()


def ears(points: Points) -> Indices:
    """Return the triangles of one polygon, (n - 2, 3); the rest as a fan where it has no ear."""
    flat = _in_its_plane(np.asarray(points, dtype=np.float64))
    left = list(range(len(flat)))
    found: list[tuple[int, int, int]] = []
    while len(left) > 3:
        place = next((k for k in range(len(left)) if _is_ear(flat, left, k)), None)
        if place is None:  # it crosses itself
            break
        found.append((left[place - 1], left[place], left[(place + 1) % len(left)]))
        del left[place]
    found += [(left[0], left[k], left[k + 1]) for k in range(1, len(left) - 1)]
    return np.array(found, dtype=np.int64).reshape(-1, 3)


def _in_its_plane(points: Points) -> Points:
    """The corners seen along the normal, counter-clockwise, (n, 2)."""
    corners = points - points[0]
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    u, v = (axis + 1) % 3, (axis + 2) % 3
    flat: Points = corners[:, [u, v] if normal[axis] >= 0.0 else [v, u]]
    return flat


def _is_ear(flat: Points, left: list[int], k: int) -> bool:
    """Whether a corner of what is left can be cut off."""
    a, b, c = flat[left[k - 1]], flat[left[k]], flat[left[(k + 1) % len(left)]]
    if _turn(a, b, c) <= 0.0:
        return False
    others = flat[left]
    is_inside = np.ones(len(left), dtype=bool)
    for p, q in ((a, b), (b, c), (c, a)):
        is_inside &= _turn(p, q, others.T) >= 0.0
    for p in (a, b, c):  # corners at the same place are those of an edge to a hole
        is_inside &= (others != p).any(axis=1)
    return not is_inside.any()


def _turn(a: Points, b: Points, c: Points) -> npt.NDArray[np.float64]:
    """How far c is to the left of the line from a to b, times its length."""
    turn: npt.NDArray[np.float64] = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return turn
