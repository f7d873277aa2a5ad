"""Triangulation of polygons, of concave ones by ear clipping.

A fan from the first corner covers the notches of a concave polygon. An ear is a corner whose
triangle is inside and contains no other corner; one is cut off after the other (Meisters,
"Polygons have ears", 1975). A hole that an edge connects with the outline is left open.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

Points = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]

MAX_CORNERS = 1000
"""The number of corners beyond which a polygon is cut as a fan; the time grows as the square."""
TURN_TOLERANCE = 1e-9
"""The turn of a corner of a convex polygon the other way, relative to the squared size."""


def triangulate(points: Points, counts: Indices) -> Indices:
    """Return the triangles of polygons, in their order.

    Args:
        points: the corners of all polygons, one polygon after the other, (n, 3).
        counts: the number of corners of each polygon, (m,).

    Returns:
        The indices of corners, (k, 3).
    """
    counts = np.asarray(counts, dtype=np.int64)
    starts = np.cumsum(counts) - counts
    triangles = _fans(starts, counts)
    firsts = np.cumsum(np.maximum(counts - 2, 0)) - np.maximum(counts - 2, 0)
    for i in concave_polygons(np.asarray(points, dtype=np.float64), starts, counts):
        start, n, k = int(starts[i]), int(counts[i]), int(firsts[i])
        triangles[k : k + n - 2] = start + cut_ears(points[start : start + n])
    return triangles


def _fans(starts: Indices, counts: Indices) -> Indices:
    n = np.maximum(counts - 2, 0)
    owner = np.repeat(np.arange(len(counts)), n)
    fan_index = np.arange(n.sum()) - np.repeat(np.cumsum(n) - n, n)
    apex = starts[owner]
    return np.stack([apex, apex + fan_index + 1, apex + fan_index + 2], axis=-1)


def concave_polygons(points: Points, starts: Indices, counts: Indices) -> Iterator[int]:
    """Yield the indices of polygons with a corner that turns the other way, (n, 3), (m,), (m,)."""
    polygons = np.flatnonzero((counts > 3) & (counts <= MAX_CORNERS))
    for n in np.unique(counts[polygons]):
        group = polygons[counts[polygons] == n]
        corners = points[starts[group, None] + np.arange(n)]  # (polygons, n, 3)
        corners = corners - corners[:, :1]
        to_next = np.roll(corners, -1, axis=1) - corners
        turns = np.cross(np.roll(to_next, 1, axis=1), to_next)
        normals = np.cross(corners, np.roll(corners, -1, axis=1)).sum(axis=1)
        lengths = np.linalg.norm(normals, axis=-1)
        turns_along = (turns * normals[:, None]).sum(axis=-1)
        size = np.abs(corners).max(axis=(1, 2)) ** 2
        yield from group[
            (turns_along < -TURN_TOLERANCE * (size * lengths)[:, None]).any(axis=1)
        ].tolist()


def cut_ears(points: Points) -> Indices:
    """Return the triangles of one polygon, (n - 2, 3); the rest as a fan where it has no ear."""
    outline = _project_to_plane(np.asarray(points, dtype=np.float64))
    corners = list(range(len(outline)))
    triangles: list[tuple[int, int, int]] = []
    while len(corners) > 3:
        ear = next((k for k in range(len(corners)) if _is_ear(outline, corners, k)), None)
        if ear is None:  # it crosses itself
            break
        triangles.append((corners[ear - 1], corners[ear], corners[(ear + 1) % len(corners)]))
        del corners[ear]
    triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
    return np.array(triangles, dtype=np.int64).reshape(-1, 3)


def _project_to_plane(points: Points) -> Points:
    """Project the corners along the normal, counter-clockwise, (n, 2)."""
    corners = points - points[0]
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    u, v = (axis + 1) % 3, (axis + 2) % 3
    outline: Points = corners[:, [u, v] if normal[axis] >= 0.0 else [v, u]]
    return outline


def _is_ear(outline: Points, corners: list[int], k: int) -> bool:
    """Return whether a corner of the remaining polygon can be cut off."""
    a, b, c = outline[corners[k - 1]], outline[corners[k]], outline[corners[(k + 1) % len(corners)]]
    if _cross_product(a, b, c) <= 0.0:
        return False
    points = outline[corners]
    is_inside = np.ones(len(corners), dtype=bool)
    for p, q in ((a, b), (b, c), (c, a)):
        is_inside &= _cross_product(p, q, points.T) >= 0.0
    for p in (a, b, c):  # corners at the same point belong to an edge to a hole
        is_inside &= (points != p).any(axis=1)
    return not is_inside.any()


def _cross_product(a: Points, b: Points, c: Points) -> npt.NDArray[np.float64]:
    """Return the cross product of (b - a) and (c - a): positive where c is to the left."""
    product: npt.NDArray[np.float64] = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return product
