"""A bounding volume tree over triangles, for finding the first hit of a ray.

Boxes are halved where the surface area heuristic expects the fewest tests (J. Goldsmith, J. Salmon,
*Automatic creation of object hierarchies for ray tracing*, IEEE CG&A 7(5), 1987), with the centres
of the triangles in `BINS` bins (I. Wald, *On fast construction of SAH-based bounding volume
hierarchies*, IEEE Symposium on Interactive Ray Tracing, 2007).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit

Whole = npt.NDArray[np.int32]
BINS = 16
MAX_IN_LEAF = 4
"""Triangles of a leaf."""
DEEPEST_BINNED = 64
"""Below it nodes are halved by number, so that no tree grows deeper than 96 nodes."""


class Tree(NamedTuple):
    """Inner nodes from the root on, each with the boxes of its two children."""

    boxes: Array
    """Lower and upper corner of the first child, then of the second, (k, 12) [m]; infinite where
    there is no child: no ray meets that."""
    links: Whole
    """Of each child: its node, or the first triangle of a leaf; triangles in it, (k, 4)."""
    order: Whole
    """Number of the triangle at each place of the leaves, (n,)."""


def build_tree(triangles: Array) -> Tree:
    """Build the tree of triangles (n, 3, 3) [m]."""
    low, high = (np.ascontiguousarray(f(triangles, axis=1)) for f in (np.min, np.max))
    return build_nodes(low, high)


def build_nodes(low: Array, high: Array) -> Tree:
    """Build the tree of boxes with a lower and an upper corner, (n, 3) each [m]."""
    n = len(low)
    order = np.arange(n, dtype=np.int32)
    boxes = np.full((max(n, 1), 12), np.inf)
    links = np.zeros((max(n, 1), 4), dtype=np.int32)
    if n == 0:
        return Tree(boxes, links, order)
    bins, costs = np.empty((BINS, 7)), np.empty(BINS)
    n_nodes = _build(low, high, order, boxes, links, bins, costs)
    return Tree(boxes[:n_nodes], links[:n_nodes], order)


@njit
def _build(
    low: Array, high: Array, order: Whole, boxes: Array, links: Whole, bins: Array, costs: Array
) -> int:
    """Fill in a tree; how many nodes it has."""
    stack = np.empty((len(boxes), 4), dtype=np.int32)  # node, depth, first, beyond the last
    stack[0, 0], stack[0, 1], stack[0, 2], stack[0, 3] = 0, 0, 0, len(order)
    n_nodes, n_stacked = 1, 1
    while n_stacked:
        n_stacked -= 1
        node, depth = stack[n_stacked, 0], stack[n_stacked, 1]
        first, end = stack[n_stacked, 2], stack[n_stacked, 3]
        middle = first + (end - first) // 2
        if depth < DEEPEST_BINNED:
            middle = _split(order, low, high, first, end, bins, costs)
        for side in range(2):
            begin, beyond = (first, middle) if side == 0 else (middle, end)
            if beyond == begin:
                continue
            _bound(boxes, node, 6 * side, low, high, order, begin, beyond)
            where, count = begin, beyond - begin
            if count > MAX_IN_LEAF:
                where, count = n_nodes, 0
                stack[n_stacked, 0], stack[n_stacked, 1] = n_nodes, depth + 1
                stack[n_stacked, 2], stack[n_stacked, 3] = begin, beyond
                n_stacked += 1
                n_nodes += 1
            links[node, 2 * side], links[node, 2 * side + 1] = where, count
    return n_nodes


@njit
def _bound(
    boxes: Array, node: int, place: int, low: Array, high: Array, order: Whole, begin: int, end: int
) -> None:
    """Set the box around some triangles."""
    for axis in range(3):
        lowest, highest = np.inf, -np.inf
        for k in range(begin, end):
            lowest = min(lowest, low[order[k], axis])
            highest = max(highest, high[order[k], axis])
        boxes[node, place + axis], boxes[node, place + 3 + axis] = lowest, highest


@njit
def _split(
    order: Whole, low: Array, high: Array, first: int, end: int, bins: Array, costs: Array
) -> int:
    """Put the triangles of the first child before those of the second; where the second begins."""
    axis, least, width = _longest_axis(order, low, high, first, end)
    half = first + (end - first) // 2
    if width <= 0.0:
        return half
    _fill_bins(bins, order, low, high, first, end, axis, least, width)
    cut = _cheapest_cut(bins, costs)
    i, j = first, end - 1
    while i <= j:
        each = order[i]
        if _bin(low[each, axis] + high[each, axis], least, width) < cut:
            i += 1
        else:
            order[i], order[j] = order[j], order[i]
            j -= 1
    return i if first < i < end else half


@njit
def _longest_axis(
    order: Whole, low: Array, high: Array, first: int, end: int
) -> tuple[int, float, float]:
    """Along which the doubled centres spread most, from where and how far [m]."""
    best, least, width = 0, 0.0, -1.0
    for axis in range(3):
        lowest, highest = np.inf, -np.inf
        for k in range(first, end):
            centre = low[order[k], axis] + high[order[k], axis]
            lowest, highest = min(lowest, centre), max(highest, centre)
        if highest - lowest > width:
            best, least, width = axis, lowest, highest - lowest
    return best, least, width


@njit
def _bin(centre: float, least: float, width: float) -> int:
    return min(BINS - 1, int(BINS * ((centre - least) / width)))


@njit
def _fill_bins(
    bins: Array,
    order: Whole,
    low: Array,
    high: Array,
    first: int,
    end: int,
    axis: int,
    least: float,
    width: float,
) -> None:
    """Count the triangles of each bin, and bound them: lower corner, upper corner, number."""
    for place in range(BINS):
        for k in range(3):
            bins[place, k], bins[place, 3 + k] = np.inf, -np.inf
        bins[place, 6] = 0.0
    for i in range(first, end):
        each = order[i]
        place = _bin(low[each, axis] + high[each, axis], least, width)
        for k in range(3):
            bins[place, k] = min(bins[place, k], low[each, k])
            bins[place, 3 + k] = max(bins[place, 3 + k], high[each, k])
        bins[place, 6] += 1.0


@njit
def _cheapest_cut(bins: Array, costs: Array) -> int:
    """The bin with which the second child begins: least sum of number times area of the boxes."""
    for cut in range(BINS):
        costs[cut] = 0.0
    for is_first in range(2):
        x0 = y0 = z0 = np.inf
        x1 = y1 = z1 = -np.inf
        number = 0.0
        for step in range(BINS - 1):
            place = step if is_first else BINS - 1 - step
            x0, x1 = min(x0, bins[place, 0]), max(x1, bins[place, 3])
            y0, y1 = min(y0, bins[place, 1]), max(y1, bins[place, 4])
            z0, z1 = min(z0, bins[place, 2]), max(z1, bins[place, 5])
            number += bins[place, 6]
            if number > 0.0:
                x, y, z = x1 - x0, y1 - y0, z1 - z0
                costs[place + 1 if is_first else place] += number * (x * y + y * z + z * x)
    best = 1
    for cut in range(2, BINS):
        if costs[cut] < costs[best]:
            best = cut
    return best
