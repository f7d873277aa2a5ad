"""The smallest rectangle round points in an image, and the order of its corners."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array

AREA_TOLERANCE = 1e-9
"""The relative difference below which two areas are equal."""


def convex_hull(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the corners of the convex hull in cyclic order (Andrew's monotone chain)."""
    points_by_x = sorted(set(points))
    if len(points_by_x) < 3:
        return points_by_x
    halves = [_half_hull(points_by_x), _half_hull(points_by_x[::-1])]
    return halves[0][:-1] + halves[1][:-1]


def _half_hull(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    chain: list[tuple[float, float]] = []
    for x, y in points:
        while len(chain) >= 2:
            (x1, y1), (x2, y2) = chain[-2], chain[-1]
            if (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1) > 0.0:
                break
            chain.pop()
        chain.append((x, y))
    return chain


def min_area_rectangle(pixels: Array) -> Array:
    r"""Return the corners NW, NE, SE, SW of the rectangle of least area round points, (4, 2) [px].

    The points (n, 2) [px] have y down. One side of the rectangle lies along an edge of the convex
    hull (rotating calipers), so each edge is tried. Let :math:`\alpha` be the angle of the edge in
    coordinates with y up, reduced by multiples of a right angle to (-45, 45] degrees. In axes that
    are turned by :math:`\alpha`, NW is :math:`(x_{min}, y_{max})`, NE :math:`(x_{max}, y_{max})`,
    and so on; NW is thus the corner nearest to the top left of the image. Of rectangles with equal
    areas, the one with the smallest :math:`|\alpha|` is used, and of two such the positive one.
    """
    hull = convex_hull([(x, -y) for x, y in pixels.tolist()])  # y up
    boxes: list[tuple[float, float, float, float, float, float]] = []
    for (x1, y1), (x2, y2) in zip(hull, hull[1:] + hull[:1], strict=True):
        angle = math.atan2(y2 - y1, x2 - x1)
        angle -= math.pi / 2 * math.ceil(angle / (math.pi / 2) - 0.5)  # (-45, 45] degrees
        cos, sin = math.cos(angle), math.sin(angle)
        xs = [cos * x + sin * y for x, y in hull]
        ys = [cos * y - sin * x for x, y in hull]
        left, right, low, high = min(xs), max(xs), min(ys), max(ys)
        boxes.append(((right - left) * (high - low), angle, left, right, low, high))
    min_area = min(area for area, *_ in boxes)
    equal_boxes = [box for box in boxes if box[0] <= min_area * (1.0 + AREA_TOLERANCE) + 1e-12]
    _, angle, left, right, low, high = min(
        equal_boxes, key=lambda box: (round(abs(box[1]), 9), -round(box[1], 9), box)
    )
    cos, sin = math.cos(angle), math.sin(angle)
    corners = [(left, high), (right, high), (right, low), (left, low)]
    return np.array([[cos * x - sin * y, -(sin * x + cos * y)] for x, y in corners])


def match_corners(pixels: Array, targets: Array) -> tuple[list[int], Array]:
    """Order four corners so that each is near to its target.

    Both sets are shifted to a common centre. Of the eight cyclic orders, clockwise or
    anticlockwise, the one with the smallest sum of squared distances is used.

    Args:
        pixels: the corners in cyclic order, (4, 2) [px].
        targets: the targets in cyclic order, (4, 2) [px].

    Returns:
        The order as indices into ``pixels``, and the corners in that order, (4, 2) [px].
    """
    quad = pixels - pixels.mean(axis=0) + targets.mean(axis=0)
    orders = [[(start + sign * i) % 4 for i in range(4)] for sign in (1, -1) for start in range(4)]
    order = min(orders, key=lambda order: round(float(((quad[order] - targets) ** 2).sum()), 9))
    return order, pixels[order]
