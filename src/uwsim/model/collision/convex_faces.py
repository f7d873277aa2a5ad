"""Decomposition of a mesh's surface into few flat convex polygons, for fixed trimeshes.

A patch is a group of triangles that lie in one plane and share corners. A patch with the same area
as its convex hull becomes one polygon. Any other patch is cut recursively along the line of a
border edge: the edge for which the convex hulls of the two halves are smallest. If there are not
fewer pieces than triangles, the triangles are kept. The polygons cover exactly the area of the
triangles, with the same holes.
"""

from __future__ import annotations

from collections import deque

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import dot, length, product

MIN_DISTANCE = 1e-4
"""The distance below which corners count as equal, and the minimum height of a triangle [m]."""
MAX_HEIGHT = 1e-3
"""The greatest distance of a patch's corners from the plane of its first triangle [m]."""
MIN_COSINE = 1.0 - 1e-6
"""The minimum cosine between the normals of triangles in a patch [1]."""
MAX_EXCESS_SHARE = 1e-3
"""The greatest fraction of a convex polygon's area that may lie outside its triangles [1]."""
MAX_LINES = 64
"""The greatest number of lines that are tried for a cut: those of the longest border edges."""

Ints = npt.NDArray[np.int64]


def convex_faces(triangles: Array) -> list[Array]:
    """Join triangles to convex polygons.

    Args:
        triangles: the triangles, with corners counter-clockwise seen from outside, (n, 3, 3) [m].

    Returns:
        The corners of each polygon, in the same orientation, (k, 3) [m].
    """
    normals, has_area = _normals(triangles)
    triangles = triangles[has_area]
    polygons: list[Array] = []
    for patch in _patches(triangles, normals):
        if len(patch) == 1:
            polygons.append(triangles[patch[0]])
            continue
        frame = _frame(triangles[patch[0]], normals[patch[0]])  # mesh_from_plane
        plane_triangles = product(triangles[patch], frame)  # (m, 3, 3)
        height = float(plane_triangles[0, 0, 2])
        pieces = _pieces(plane_triangles[:, :, :2], len(patch))
        if pieces is None or len(pieces) >= len(patch):
            polygons += list(triangles[patch])
            continue
        for piece in pieces:
            polygon = np.column_stack([piece, np.full(len(piece), height)])
            polygons.append(product(polygon, frame.T))
    return polygons


def _frame(triangle: Array, normal: Array) -> Array:
    """Return axes as columns, (3, 3): x along a triangle's longest edge, z along ``normal``."""
    edges = np.roll(triangle, -1, axis=0) - triangle
    x_axis = edges[int(np.argmax(np.linalg.norm(edges, axis=1)))]
    x_axis = x_axis / length(x_axis)
    return np.column_stack([x_axis, np.cross(normal, x_axis), normal])


def number_corners(corners: Array) -> Ints:
    """Return a number for each corner (n, d), sorted by position; equal corners share a number."""
    cells = np.round(corners / MIN_DISTANCE).astype(np.int64)
    order = np.lexsort(cells.T[::-1])
    is_new = np.zeros(len(order), dtype=np.int64)
    is_new[1:] = (np.diff(cells[order], axis=0) != 0).any(axis=1)
    numbers = np.empty(len(order), dtype=np.int64)
    numbers[order] = np.cumsum(is_new)
    return numbers


def count_patches(triangles: Array) -> int:
    """Count the flat patches of triangles (n, 3, 3) [m] that share edges.

    If triangles share corners only along shared edges, this is the number of patches in
    `convex_faces`, computed in a hundredth of the time.
    """
    if not len(triangles):
        return 0
    normals, has_area = _normals(triangles)
    corners = _corners(triangles[has_area])
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
    ends.sort(axis=1)
    owners = np.repeat(np.arange(len(corners)), 3)
    order = np.lexsort(ends.T)
    is_shared = (np.diff(ends[order], axis=0) == 0).all(axis=1)
    left, right = owners[order[:-1][is_shared]], owners[order[1:][is_shared]]
    is_flat = (normals[left] * normals[right]).sum(axis=1) >= MIN_COSINE
    return len(corners) - _count_joins(left[is_flat], right[is_flat], len(corners))


@njit
def _count_joins(left: Ints, right: Ints, n: int) -> int:
    """Count the pairs that join two separate groups, when n numbers are joined pair by pair."""
    parents = np.arange(n)
    joins = 0
    for k in range(len(left)):
        a, b = left[k], right[k]
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
    """Return the unit normals of the triangles that have an area, and the mask of these."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    double_areas = np.linalg.norm(normals, axis=1)  # (n,) [m2]
    has_area = double_areas > MIN_DISTANCE * _longest_edges(triangles)
    return normals[has_area] / double_areas[has_area, None], has_area


def _corners(points: Array) -> Ints:
    """Return numbers (n, 3) of corners (n, 3, d); equal corners share a number."""
    return number_corners(points.reshape(-1, points.shape[-1])).reshape(-1, 3)


def _groups(corners: Ints) -> list[list[int]]:
    """Return groups of triangles that share corners, in the order of the mesh."""
    no_planes = np.ones((len(corners), 1)), np.zeros((len(corners), 3, 1))
    return _grow_groups(corners, *no_planes)


def _patches(triangles: Array, normals: Array) -> list[list[int]]:
    """Return groups of coplanar triangles that share corners, in the order of the mesh."""
    return _grow_groups(_corners(triangles), normals, triangles)


def _grow_groups(corners: Ints, normals: Array, points: Array) -> list[list[int]]:
    """Extend groups over shared corners, within the plane of each group's first triangle."""
    order = np.argsort(corners.ravel(), kind="stable")
    starts = np.searchsorted(corners.ravel()[order], np.arange(corners.max(initial=-1) + 2))
    groups = _group_numbers(corners, normals, points, order // 3, starts)
    members = np.argsort(groups, kind="stable")
    ends = np.cumsum(np.bincount(groups))
    return [group.tolist() for group in np.split(members, ends)[:-1]]


@njit
def _group_numbers(
    corners: Ints, normals: Array, points: Array, corner_triangles: Ints, starts: Ints
) -> Ints:
    """Return the group index of each triangle, in the order of the first triangles, (n,).

    Args:
        corners: the numbers of each triangle's corners, (n, 3).
        normals: the normal of each triangle, (n, d).
        points: the positions of each triangle's corners, (n, 3, d) [m].
        corner_triangles: the triangles at the first corner, then at the second, and so on.
        starts: the index in ``corner_triangles`` at which each corner begins, then its length.
    """
    n, n_axes = normals.shape
    numbers = np.full(n, -1)
    queue = np.empty(n, np.int64)
    n_groups = 0
    for seed in range(n):
        if numbers[seed] >= 0:
            continue
        numbers[seed] = n_groups
        queue[0], head, tail = seed, 0, 1
        while head < tail:
            triangle = queue[head]
            head += 1
            for side in range(3):
                corner = corners[triangle, side]
                for entry in range(starts[corner], starts[corner + 1]):
                    i = corner_triangles[entry]
                    if numbers[i] >= 0:
                        continue
                    cosine = 0.0
                    for k in range(n_axes):
                        cosine += normals[i, k] * normals[seed, k]
                    max_height = 0.0
                    for m in range(3):
                        height = 0.0
                        for k in range(n_axes):
                            height += (points[i, m, k] - points[seed, 0, k]) * normals[seed, k]
                        max_height = max(max_height, abs(height))
                    if cosine >= MIN_COSINE and max_height <= MAX_HEIGHT:
                        numbers[i] = n_groups
                        queue[tail] = i
                        tail += 1
        n_groups += 1
    return numbers


def _pieces(triangles: Array, max_pieces: int) -> list[Array] | None:
    """Cut triangles in a plane (n, 3, 2) [m] into convex polygons; None if more than allowed."""
    pieces: list[Array] = []
    queue = deque([triangles])
    while queue:
        part = queue.popleft()
        area = float(_areas(part).sum())
        hull, hull_area = _hull(part)
        if area > hull_area * (1.0 + MAX_EXCESS_SHARE):
            return None  # faces overlap
        if hull_area - area <= MAX_EXCESS_SHARE * hull_area:
            pieces.append(hull)
        else:
            halves = _cut(part)
            if halves is None:
                return None
            for half in halves:
                queue.extend(half[group] for group in _groups(_corners(half)))
        if len(pieces) + len(queue) > max_pieces:
            return None
    return pieces


def _hull(part: Array) -> tuple[Array, float]:
    """Return the corners of the convex hull, counter-clockwise, (k, 2) [m], and its area [m2]."""
    from scipy.spatial import ConvexHull

    hull = ConvexHull(part.reshape(-1, 2))
    corners = hull.points[hull.vertices]
    edge_in = corners - np.roll(corners, 1, axis=0)
    edge_out = np.roll(corners, -1, axis=0) - corners
    cross_products = edge_in[:, 0] * edge_out[:, 1] - edge_in[:, 1] * edge_out[:, 0]
    reach = np.linalg.norm(edge_in, axis=1) + np.linalg.norm(edge_out, axis=1)
    return corners[cross_products > 0.1 * MIN_DISTANCE * reach], float(hull.volume)


def _areas(part: Array) -> Array:
    a, b = part[:, 1] - part[:, 0], part[:, 2] - part[:, 0]
    areas: Array = 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    return areas


def _longest_edges(part: Array) -> Array:
    lengths: Array = np.linalg.norm(np.roll(part, -1, axis=1) - part, axis=2).max(axis=1)
    return lengths


def _cut(part: Array) -> tuple[Array, Array] | None:
    """Cut along the line of the border edge whose halves have the smallest hulls, if any does."""
    min_size, halves = np.inf, None
    for normal, offset in _border_lines(part):
        left, right = (_clip(part, sign * normal, sign * offset) for sign in (1.0, -1.0))
        if len(left) and len(right):
            size = _hull(left)[1] + _hull(right)[1]
            if size < min_size * (1.0 - 1e-6):
                min_size, halves = size, (left, right)
    return halves


def _border_lines(part: Array) -> list[tuple[Array, float]]:
    """Return lines ``normal @ x = offset`` of border edges (of one triangle), longest first."""
    corners = _corners(part)
    n_triangles: dict[tuple[int, int], int] = {}
    edges = [(i, k, (k + 1) % 3) for i in range(len(part)) for k in range(3)]
    keys = [(int(min(corners[i, [a, b]])), int(max(corners[i, [a, b]]))) for i, a, b in edges]
    for key in keys:
        n_triangles[key] = n_triangles.get(key, 0) + 1
    lines: dict[tuple[int, ...], tuple[float, Array, float]] = {}
    for (i, a, b), key in zip(edges, keys, strict=True):
        if n_triangles[key] > 1:
            continue
        edge = part[i, b] - part[i, a]
        size = length(edge)
        if size <= MIN_DISTANCE:
            continue
        normal = np.array([-edge[1], edge[0]]) / size
        if (normal[0], normal[1]) < (0.0, 0.0):
            normal = -normal
        offset = dot(normal, part[i, a])
        line = tuple(np.round(np.array([*normal, offset]) / MAX_HEIGHT).astype(np.int64).tolist())
        if size > lines.get(line, (0.0,))[0]:
            lines[line] = (size, normal, offset)
    sorted_lines = sorted(lines.values(), key=lambda entry: -round(entry[0] / MAX_HEIGHT))
    return [(normal, offset) for _, normal, offset in sorted_lines[:MAX_LINES]]


def _clip(part: Array, normal: Array, offset: float) -> Array:
    """Return the part of triangles (n, 3, 2) with ``normal @ x >= offset``, (m, 3, 2) [m]."""
    triangles: list[Array] = []
    heights = product(part, normal) - offset  # (n, 3)
    heights[np.abs(heights) < MIN_DISTANCE] = 0.0
    for triangle, height in zip(part, heights, strict=True):
        if height.max() <= 0.0:
            continue
        if height.min() >= 0.0:
            triangles.append(triangle)
            continue
        outline: list[Array] = []
        for k in range(3):
            h, h_next = height[k], height[(k + 1) % 3]
            if h >= 0.0:
                outline.append(triangle[k])
            if h * h_next < 0.0:
                edge = triangle[(k + 1) % 3] - triangle[k]
                outline.append(triangle[k] + h / (h - h_next) * edge)
        ends = range(1, len(outline) - 1)
        triangles += [np.array([outline[0], *outline[k : k + 2]]) for k in ends]
    if not triangles:
        return np.zeros((0, 3, 2))
    parts = np.array(triangles)
    has_area = 2.0 * _areas(parts) > MIN_DISTANCE * _longest_edges(parts)
    return np.asarray(parts[has_area])
