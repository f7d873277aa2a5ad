"""Decomposition of a mesh's surface into few flat convex polygons, for fixed trimeshes.

Triangles that lie in one plane and share corners are a patch. A patch as large as its convex hull
is one polygon. Any other is cut along the line of that edge of its border whose halves have the
smallest hulls, and so on with what is left; where that gives no fewer pieces than there are
triangles, the triangles stay. The union of the polygons is that of the triangles, holes and all.
"""

from __future__ import annotations

from collections import deque

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import dot, length, product

SAME = 1e-4
"""Corners nearer than this are one, and triangles lower than this are none [m]."""
LEVEL = 1e-3
"""How far the corners of a patch may lie off the plane of its first triangle [m]."""
PARALLEL = 1.0 - 1e-6
"""Least cosine between the normals of a patch."""
SPARE = 1e-3
"""Share of a convex polygon that may lie beside its triangles."""
MAX_LINES = 64
"""Lines tried for a cut: those of the longest border edges."""

Ints = npt.NDArray[np.int64]


def convex_faces(triangles: Array) -> list[Array]:
    """Join triangles to convex polygons.

    Args:
        triangles: counter-clockwise from where they are seen, (n, 3, 3) [m].

    Returns:
        The corners of each polygon, turning as its triangles do, (k, 3) [m].
    """
    normals, real = _normals(triangles)
    triangles = triangles[real]
    polygons: list[Array] = []
    for patch in _patches(triangles, normals):
        if len(patch) == 1:
            polygons.append(triangles[patch[0]])
            continue
        frame = _frame(triangles[patch[0]], normals[patch[0]])  # mesh_from_plane
        flat = product(triangles[patch], frame)  # (m, 3, 3)
        height = float(flat[0, 0, 2])
        pieces = _pieces(flat[:, :, :2], len(patch))
        if pieces is None or len(pieces) >= len(patch):
            polygons += list(triangles[patch])
            continue
        for piece in pieces:
            polygon = np.column_stack([piece, np.full(len(piece), height)])
            polygons.append(product(polygon, frame.T))
    return polygons


def _frame(triangle: Array, normal: Array) -> Array:
    """Axes whose first is the longest edge of a triangle and whose third is its normal, (3, 3)."""
    edges = np.roll(triangle, -1, axis=0) - triangle
    along = edges[int(np.argmax(np.linalg.norm(edges, axis=1)))]
    along = along / length(along)
    return np.column_stack([along, np.cross(normal, along), normal])


def numbered(corners: Array) -> Ints:
    """Number corners (n, d) so that equal ones have equal numbers, in the order of their places."""
    rounded = np.round(corners / SAME).astype(np.int64)
    order = np.lexsort(rounded.T[::-1])
    is_new = np.zeros(len(order), dtype=np.int64)
    is_new[1:] = (np.diff(rounded[order], axis=0) != 0).any(axis=1)
    numbers = np.empty(len(order), dtype=np.int64)
    numbers[order] = np.cumsum(is_new)
    return numbers


def n_patches(triangles: Array) -> int:
    """Count the flat patches of triangles (n, 3, 3) [m] that share edges.

    Where no more corners than those of edges are shared it is the number of those that
    `convex_faces` finds, in a hundredth of the time.
    """
    if not len(triangles):
        return 0
    normals, real = _normals(triangles)
    corners = _corners(triangles[real])
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
    ends.sort(axis=1)
    owners = np.repeat(np.arange(len(corners)), 3)
    order = np.lexsort(ends.T)
    meets = (np.diff(ends[order], axis=0) == 0).all(axis=1)
    one, other = owners[order[:-1][meets]], owners[order[1:][meets]]
    is_flat = (normals[one] * normals[other]).sum(axis=1) >= PARALLEL
    return len(corners) - _n_joins(one[is_flat], other[is_flat], len(corners))


@njit
def _n_joins(one: Ints, other: Ints, n: int) -> int:
    """Count the pairs of n numbers that join two groups which were apart before."""
    parents = np.arange(n)
    joins = 0
    for k in range(len(one)):
        a, b = one[k], other[k]
        while parents[a] != a:
            parents[a] = parents[parents[a]]
            a = parents[a]
        while parents[b] != b:
            parents[b] = parents[parents[b]]
            b = parents[b]
        if a != b:
            parents[max(a, b)] = min(a, b)
            joins += 1
    return joins


def _normals(triangles: Array) -> tuple[Array, npt.NDArray[np.bool_]]:
    """Unit normals of the triangles that have area, and which have."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    doubled = np.linalg.norm(normals, axis=1)  # (n,) [m2]
    real = doubled > SAME * _longest(triangles)
    return normals[real] / doubled[real, None], real


def _corners(points: Array) -> Ints:
    """Number the corners (n, 3, d) so that equal ones have equal numbers, (n, 3)."""
    return numbered(points.reshape(-1, points.shape[-1])).reshape(-1, 3)


def _groups(corners: Ints) -> list[list[int]]:
    """Triangles that are connected by corners, in the mesh's order."""
    everywhere = np.ones((len(corners), 1)), np.zeros((len(corners), 3, 1))
    return _grown(corners, *everywhere)


def _patches(triangles: Array, normals: Array) -> list[list[int]]:
    """Numbers of the coplanar triangles that are connected, in the mesh's order."""
    return _grown(_corners(triangles), normals, triangles)


def _grown(corners: Ints, normals: Array, points: Array) -> list[list[int]]:
    """Grow groups over shared corners, within the plane of each group's first triangle."""
    order = np.argsort(corners.ravel(), kind="stable")
    begins = np.searchsorted(corners.ravel()[order], np.arange(corners.max(initial=-1) + 2))
    groups = _group_numbers(corners, normals, points, order // 3, begins)
    members = np.argsort(groups, kind="stable")
    ends = np.cumsum(np.bincount(groups))
    return [group.tolist() for group in np.split(members, ends)[:-1]]


@njit
def _group_numbers(
    corners: Ints, normals: Array, points: Array, at_corners: Ints, begins: Ints
) -> Ints:
    """Number the groups of triangles in the order of their first triangles, (n,).

    Args:
        corners: of each triangle, (n, 3).
        normals: of each triangle, (n, d).
        points: places of its corners, (n, 3, d) [m].
        at_corners: the triangles at each corner, corner by corner.
        begins: where those of each corner begin in it, and its length.
    """
    n, n_axes = normals.shape
    numbers = np.full(n, -1)
    waiting = np.empty(n, np.int64)
    n_groups = 0
    for first in range(n):
        if numbers[first] >= 0:
            continue
        numbers[first] = n_groups
        waiting[0], done, found = first, 0, 1
        while done < found:
            here = waiting[done]
            done += 1
            for side in range(3):
                corner = corners[here, side]
                for place in range(begins[corner], begins[corner + 1]):
                    i = at_corners[place]
                    if numbers[i] >= 0:
                        continue
                    cosine = 0.0
                    for k in range(n_axes):
                        cosine += normals[i, k] * normals[first, k]
                    highest = 0.0
                    for m in range(3):
                        height = 0.0
                        for k in range(n_axes):
                            height += (points[i, m, k] - points[first, 0, k]) * normals[first, k]
                        highest = max(highest, abs(height))
                    if cosine >= PARALLEL and highest <= LEVEL:
                        numbers[i] = n_groups
                        waiting[found] = i
                        found += 1
        n_groups += 1
    return numbers


def _pieces(flat: Array, most: int) -> list[Array] | None:
    """Cut triangles of a plane (n, 3, 2) into convex polygons; None if it takes over ``most``."""
    pieces: list[Array] = []
    waiting = deque([flat])
    while waiting:
        part = waiting.popleft()
        area = float(_areas(part).sum())
        hull, hull_area = _hull(part)
        if area > hull_area * (1.0 + SPARE):
            return None  # faces lie on one another
        if hull_area - area <= SPARE * hull_area:
            pieces.append(hull)
        else:
            halves = _cut(part)
            if halves is None:
                return None
            for half in halves:
                waiting.extend(half[group] for group in _groups(_corners(half)))
        if len(pieces) + len(waiting) > most:
            return None
    return pieces


def _hull(part: Array) -> tuple[Array, float]:
    """Corners of the convex hull, counter-clockwise, (k, 2) [m], and its area [m2]."""
    from scipy.spatial import ConvexHull

    hull = ConvexHull(part.reshape(-1, 2))
    corners = hull.points[hull.vertices]
    before, after = corners - np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0) - corners
    turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    reach = np.linalg.norm(before, axis=1) + np.linalg.norm(after, axis=1)
    return corners[turn > 0.1 * SAME * reach], float(hull.volume)


def _areas(part: Array) -> Array:
    a, b = part[:, 1] - part[:, 0], part[:, 2] - part[:, 0]
    areas: Array = 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    return areas


def _longest(part: Array) -> Array:
    """Longest edge of each triangle (n, 3, d), (n,) [m]."""
    longest: Array = np.linalg.norm(np.roll(part, -1, axis=1) - part, axis=2).max(axis=1)
    return longest


def _cut(part: Array) -> tuple[Array, Array] | None:
    """Cut along the border line whose halves have the smallest hulls; None if no line cuts."""
    best, halves = np.inf, None
    for normal, offset in _border_lines(part):
        left, right = (_clipped(part, sign * normal, sign * offset) for sign in (1.0, -1.0))
        if len(left) and len(right):
            size = _hull(left)[1] + _hull(right)[1]
            if size < best * (1.0 - 1e-6):
                best, halves = size, (left, right)
    return halves


def _border_lines(part: Array) -> list[tuple[Array, float]]:
    """Lines ``normal @ x = offset`` of the edges that one triangle has alone, longest first."""
    corners = _corners(part)
    n_triangles: dict[tuple[int, int], int] = {}
    edges = [(i, k, (k + 1) % 3) for i in range(len(part)) for k in range(3)]
    keys = [(int(min(corners[i, [a, b]])), int(max(corners[i, [a, b]]))) for i, a, b in edges]
    for key in keys:
        n_triangles[key] = n_triangles.get(key, 0) + 1
    found: dict[tuple[int, ...], tuple[float, Array, float]] = {}
    for (i, a, b), key in zip(edges, keys, strict=True):
        if n_triangles[key] > 1:
            continue
        way = part[i, b] - part[i, a]
        size = length(way)
        if size <= SAME:
            continue
        normal = np.array([-way[1], way[0]]) / size
        if (normal[0], normal[1]) < (0.0, 0.0):
            normal = -normal
        offset = dot(normal, part[i, a])
        line = tuple(np.round(np.array([*normal, offset]) / LEVEL).astype(np.int64).tolist())
        if size > found.get(line, (0.0,))[0]:
            found[line] = (size, normal, offset)
    ranked = sorted(found.values(), key=lambda one: -round(one[0] / LEVEL))
    return [(normal, offset) for _, normal, offset in ranked[:MAX_LINES]]


def _clipped(part: Array, normal: Array, offset: float) -> Array:
    """What of the triangles (n, 3, 2) lies where ``normal @ x >= offset``, (m, 3, 2)."""
    kept: list[Array] = []
    heights = product(part, normal) - offset  # (n, 3)
    heights[np.abs(heights) < SAME] = 0.0
    for triangle, height in zip(part, heights, strict=True):
        if height.max() <= 0.0:
            continue
        if height.min() >= 0.0:
            kept.append(triangle)
            continue
        outline: list[Array] = []
        for k in range(3):
            here, there = height[k], height[(k + 1) % 3]
            if here >= 0.0:
                outline.append(triangle[k])
            if here * there < 0.0:
                way = triangle[(k + 1) % 3] - triangle[k]
                outline.append(triangle[k] + here / (here - there) * way)
        kept += [np.array([outline[0], *outline[k : k + 2]]) for k in range(1, len(outline) - 1)]
    if not kept:
        return np.zeros((0, 3, 2))
    found = np.array(kept)
    real: Array = found[2.0 * _areas(found) > SAME * _longest(found)]
    return real
