"""The construction of a bounding volume tree over triangles, with which rays find their first hit.

A node is split where the surface area heuristic expects the fewest tests (J. Goldsmith, J. Salmon,
*Automatic creation of object hierarchies for ray tracing*, IEEE CG&A 7(5), 1987), with the centres
of the triangles in `N_BINS` bins (I. Wald, *On fast construction of SAH-based bounding volume
hierarchies*, IEEE Symposium on Interactive Ray Tracing, 2007).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit

IntArray = npt.NDArray[np.int32]
N_BINS = 16
"""The number of bins along the split axis."""
MAX_IN_LEAF = 4
"""The largest number of triangles in a leaf."""
MAX_BINNED_DEPTH = 64
"""The depth below which the triangles of a node are halved by number. This limits the depth of the
tree to 96 nodes."""


class Tree(NamedTuple):
    """A binary tree of k inner nodes over n triangles; node 0 is the root."""

    boxes: Array
    """The lower and upper corner of the box of each node's first child, then of its second child,
    (k, 12) [m]; infinite without a child, so that no ray hits it."""
    links: IntArray
    """The node of each child and 0; or, of a leaf, its start in `order` and its number of
    triangles, (k, 4)."""
    order: IntArray
    """The indices of the triangles in the order of the leaves, (n,)."""


def build_tree(triangles: Array) -> Tree:
    """Build the tree of triangles (n, 3, 3) [m]."""
    low, high = (np.ascontiguousarray(f(triangles, axis=1)) for f in (np.min, np.max))
    return build_nodes(low, high)


def build_nodes(low: Array, high: Array) -> Tree:
    """Build the tree of boxes from their lower and upper corners, (n, 3) each [m]."""
    n = len(low)
    order = np.arange(n, dtype=np.int32)
    boxes = np.full((max(n, 1), 12), np.inf)
    links = np.zeros((max(n, 1), 4), dtype=np.int32)
    if n == 0:
        return Tree(boxes, links, order)
    bins, costs = np.empty((N_BINS, 7)), np.empty(N_BINS)
    n_nodes = _build(low, high, order, boxes, links, bins, costs)
    return Tree(boxes[:n_nodes], links[:n_nodes], order)


@njit
def _build(
    low: Array,
    high: Array,
    order: IntArray,
    boxes: Array,
    links: IntArray,
    bins: Array,
    costs: Array,
) -> int:
    """Fill the arrays of a tree, and return its number of nodes.

    Args:
        low: the lower corners of the boxes of the triangles, (n, 3) [m].
        high: the upper corners, (n, 3) [m].
        order: the indices of the triangles, which are sorted, (n,).
        boxes: receives the boxes, as in `Tree`.
        links: receives the links, as in `Tree`.
        bins: a workspace, (`N_BINS`, 7).
        costs: a workspace, (`N_BINS`,).
    """
    stack = np.empty((len(boxes), 4), dtype=np.int32)  # node, depth, start, stop
    stack[0, 0], stack[0, 1], stack[0, 2], stack[0, 3] = 0, 0, 0, len(order)
    n_nodes, n_stacked = 1, 1
    while n_stacked:
        n_stacked -= 1
        node, depth = stack[n_stacked, 0], stack[n_stacked, 1]
        start, end = stack[n_stacked, 2], stack[n_stacked, 3]
        middle = start + (end - start) // 2
        if depth < MAX_BINNED_DEPTH:
            middle = _split(order, low, high, start, end, bins, costs)
        for side in range(2):
            begin, stop = (start, middle) if side == 0 else (middle, end)
            if stop == begin:
                continue
            _set_bounds(boxes, node, 6 * side, low, high, order, begin, stop)
            child, count = begin, stop - begin
            if count > MAX_IN_LEAF:
                child, count = n_nodes, 0
                stack[n_stacked, 0], stack[n_stacked, 1] = n_nodes, depth + 1
                stack[n_stacked, 2], stack[n_stacked, 3] = begin, stop
                n_stacked += 1
                n_nodes += 1
            links[node, 2 * side], links[node, 2 * side + 1] = child, count
    return n_nodes


@njit
def _set_bounds(
    boxes: Array,
    node: int,
    column: int,
    low: Array,
    high: Array,
    order: IntArray,
    begin: int,
    end: int,
) -> None:
    """Set the box around the triangles from ``begin`` to ``end``."""
    for axis in range(3):
        minimum, maximum = np.inf, -np.inf
        for k in range(begin, end):
            minimum = min(minimum, low[order[k], axis])
            maximum = max(maximum, high[order[k], axis])
        boxes[node, column + axis], boxes[node, column + 3 + axis] = minimum, maximum


@njit
def _split(
    order: IntArray, low: Array, high: Array, start: int, end: int, bins: Array, costs: Array
) -> int:
    """Sort the triangles of the first child before those of the second; return where it begins."""
    axis, origin, width = _longest_axis(order, low, high, start, end)
    half = start + (end - start) // 2
    if width <= 0.0:
        return half
    _fill_bins(bins, order, low, high, start, end, axis, origin, width)
    cut = _cheapest_cut(bins, costs)
    i, j = start, end - 1
    while i <= j:
        triangle = order[i]
        if _bin_of(low[triangle, axis] + high[triangle, axis], origin, width) < cut:
            i += 1
        else:
            order[i], order[j] = order[j], order[i]
            j -= 1
    return i if start < i < end else half


@njit
def _longest_axis(
    order: IntArray, low: Array, high: Array, start: int, end: int
) -> tuple[int, float, float]:
    """Return the axis along which the boxes' centres spread most, and their minimum and spread.

    Minimum and spread are those of doubled centres (the sum of both corners) [m].
    """
    longest_axis, origin, width = 0, 0.0, -1.0
    for axis in range(3):
        minimum, maximum = np.inf, -np.inf
        for k in range(start, end):
            centre = low[order[k], axis] + high[order[k], axis]
            minimum, maximum = min(minimum, centre), max(maximum, centre)
        if maximum - minimum > width:
            longest_axis, origin, width = axis, minimum, maximum - minimum
    return longest_axis, origin, width


@njit
def _bin_of(centre: float, origin: float, width: float) -> int:
    return min(N_BINS - 1, int(N_BINS * ((centre - origin) / width)))


@njit
def _fill_bins(
    bins: Array,
    order: IntArray,
    low: Array,
    high: Array,
    start: int,
    end: int,
    axis: int,
    origin: float,
    width: float,
) -> None:
    """Write the lower corner, the upper corner and the number of the triangles in each bin."""
    for index in range(N_BINS):
        for k in range(3):
            bins[index, k], bins[index, 3 + k] = np.inf, -np.inf
        bins[index, 6] = 0.0
    for i in range(start, end):
        triangle = order[i]
        index = _bin_of(low[triangle, axis] + high[triangle, axis], origin, width)
        for k in range(3):
            bins[index, k] = min(bins[index, k], low[triangle, k])
            bins[index, 3 + k] = max(bins[index, 3 + k], high[triangle, k])
        bins[index, 6] += 1.0


@njit
def _cheapest_cut(bins: Array, costs: Array) -> int:
    """Return the first bin of the second child for the minimum sum of triangles times box area."""
    for cut in range(N_BINS):
        costs[cut] = 0.0
    for is_first in range(2):
        x0 = y0 = z0 = np.inf
        x1 = y1 = z1 = -np.inf
        number = 0.0
        for step in range(N_BINS - 1):
            index = step if is_first else N_BINS - 1 - step
            x0, x1 = min(x0, bins[index, 0]), max(x1, bins[index, 3])
            y0, y1 = min(y0, bins[index, 1]), max(y1, bins[index, 4])
            z0, z1 = min(z0, bins[index, 2]), max(z1, bins[index, 5])
            number += bins[index, 6]
            if number > 0.0:
                x, y, z = x1 - x0, y1 - y0, z1 - z0
                costs[index + 1 if is_first else index] += number * (x * y + y * z + z * x)
    cheapest_cut = 1
    for cut in range(2, N_BINS):
        if costs[cut] < costs[cheapest_cut]:
            cheapest_cut = cut
    return cheapest_cut
