"""The smallest rectangle round points of an image, and the names of its corners."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array

SAME_AREA = 1e-9
"""Areas nearer to each other than this, relative to the smallest, are a tie."""


def convex_hull(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the convex hull, once around, without points on its edges (Andrew's chain)."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered
    halves = [_half(ordered), _half(ordered[::-1])]
    return halves[0][:-1] + halves[1][:-1]


def _half(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    chain: list[tuple[float, float]] = []
    for x, y in points:
        while len(chain) >= 2:
            (ax, ay), (bx, by) = chain[-2], chain[-1]
            if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0.0:
                break
            chain.pop()
        chain.append((x, y))
    return chain


def rectangle(pixels: Array) -> Array:
    r"""Return NW, NE, SE, SW of the smallest-area rectangle round points (n, 2) [px], (4, 2) [px].

    One side of that rectangle lies along an edge of the convex hull (rotating calipers), so each
    edge is tried. In coordinates with y up, turned back by the edge's angle :math:`\alpha`,
    NW is :math:`(x_{min}, y_{max})`, NE :math:`(x_{max}, y_{max})`, and so on. :math:`\alpha` is
    taken modulo a right angle into (-45, 45] degrees, so NW is the corner nearest to the top left.
    Where areas tie the smallest :math:`|\alpha|` wins, then the positive one.
    """
    hull = convex_hull([(x, -y) for x, y in pixels.tolist()])  # y up
    tried: list[tuple[float, float, float, float, float, float]] = []
    for (ax, ay), (bx, by) in zip(hull, hull[1:] + hull[:1], strict=True):
        angle = math.atan2(by - ay, bx - ax)
        angle -= math.pi / 2 * math.ceil(angle / (math.pi / 2) - 0.5)  # (-45, 45] degrees
        cos, sin = math.cos(angle), math.sin(angle)
        across = [cos * x + sin * y for x, y in hull]
        along = [cos * y - sin * x for x, y in hull]
        left, right, low, high = min(across), max(across), min(along), max(along)
        tried.append(((right - left) * (high - low), angle, left, right, low, high))
    smallest = min(area for area, *_ in tried)
    tied = [box for box in tried if box[0] <= smallest * (1.0 + SAME_AREA) + 1e-12]
    _, angle, left, right, low, high = min(
        tied, key=lambda box: (round(abs(box[1]), 9), -round(box[1], 9), box)
    )
    cos, sin = math.cos(angle), math.sin(angle)
    named = [(left, high), (right, high), (right, low), (left, low)]
    return np.array([[cos * x - sin * y, -(sin * x + cos * y)] for x, y in named])


def like_rectangle(pixels: Array, named: Array) -> tuple[list[int], Array]:
    """Order four corners (4, 2) [px], given once around, to lie nearest to named ones (4, 2) [px].

    Returns the order as indices into ``pixels``, and the corners in that order. Of the eight
    orders once around, that with the smallest sum of squared distances is taken, the centres
    laid on each other first.
    """
    moved = pixels - pixels.mean(axis=0) + named.mean(axis=0)
    orders = [[(start + way * i) % 4 for i in range(4)] for way in (1, -1) for start in range(4)]
    order = min(orders, key=lambda order: round(float(((moved[order] - named) ** 2).sum()), 9))
    return order, pixels[order]
