r"""The engine's bounding volume tree over the fixed shapes, rebuilt by the surface area heuristic.

MuJoCo halves its shapes at the median. The shapes of a tank or a wreck are large plates around a
hollow, and halves of them overlap in the hollow, just where the vehicles are. Here a node is cut
where the surface area heuristic is least,

.. math:: A_{left}\,n_{left} + A_{right}\,n_{right}

with A the area of a half's box and n its number of shapes (MacDonald and Booth, Heuristics for
ray tracing using space subdivision, The Visual Computer 6, 1990). The tree holds the same shapes;
only fewer of its boxes are looked into.

What never moves is placed once: see `place_fixed_shapes`.
"""

from __future__ import annotations

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array

WORLD = 0
"""The engine's number of the body of fixed shapes."""
PLACED = 2
"""Fixed shapes that the engine goes through at every step; with one it would not use the tree."""
MAX_DEPTH = 40
"""Nodes below this are halved at the median; the engine allows 50."""

Ints = npt.NDArray[np.int64]


def rebuild_world_tree(model: mujoco.MjModel) -> None:
    """Rebuild the tree over the shapes of the world's body, in the place of the engine's."""
    first, count = int(model.body_bvhadr[WORLD]), int(model.body_bvhnum[WORLD])
    rows = slice(first, first + count)
    leaves = np.flatnonzero(model.bvh_nodeid[rows] >= 0)
    if len(leaves) < 3:
        return
    shapes = model.bvh_nodeid[rows][leaves].copy()
    boxes = model.bvh_aabb[rows][leaves].copy()  # (n, 6): middle, half edges [m]
    low, high = boxes[:, :3] - boxes[:, 3:], boxes[:, :3] + boxes[:, 3:]
    tree_boxes, children = model.bvh_aabb[rows], model.bvh_child[rows]
    depths, numbers = model.bvh_depth[rows], model.bvh_nodeid[rows]
    node = 0
    waiting: list[tuple[Ints, int, int, int]] = [(np.arange(len(leaves)), -1, 0, 0)]
    while waiting:
        members, parent, side, depth = waiting.pop()
        lower, upper = low[members].min(axis=0), high[members].max(axis=0)
        tree_boxes[node, :3], tree_boxes[node, 3:] = 0.5 * (lower + upper), 0.5 * (upper - lower)
        depths[node], children[node] = depth, -1
        numbers[node] = shapes[members[0]] if len(members) == 1 else -1
        if parent >= 0:
            children[parent, side] = node
        if len(members) > 1:
            left, right = _cut(members, low, high, depth)
            waiting += [(right, node, 1, depth + 1), (left, node, 0, depth + 1)]
        node += 1


def place_fixed_shapes(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Place the shapes of the world's body for good, and tell the engine of only a few of them.

    The engine goes through all of them to learn which kinds of shapes the world's body may touch,
    for each body at every step, and, unless sleeping is enabled, to place them anew. The tree,
    through which contacts are found, keeps them all. Only ``data`` and its copies know where they
    are: other data of this model find no contacts with them, nor does ``data`` after a reset.
    """
    first, count = int(model.body_geomadr[WORLD]), int(model.body_geomnum[WORLD])
    if count <= PLACED or model.body_bvhnum[WORLD] == 0:
        return
    shapes = slice(first, first + count)
    if any(
        len(np.unique(bits[shapes])) > 1 for bits in (model.geom_contype, model.geom_conaffinity)
    ):
        return
    mujoco.mj_kinematics(model, data)
    model.body_geomnum[WORLD] = PLACED


def _cut(members: Ints, low: Array, high: Array, depth: int) -> tuple[Ints, Ints]:
    """Split the shapes of a node."""
    middles = low[members] + high[members]
    orders = members[np.argsort(middles, axis=0, kind="stable").T]  # (3, n): along each axis
    if len(members) == 2:
        return orders[0, :1], orders[0, 1:]
    if depth >= MAX_DEPTH:
        order = orders[int(np.argmax(np.ptp(middles, axis=0)))]
        half = len(order) // 2
        return order[:half], order[half:]
    lows, highs = low[orders], high[orders]  # (3, n, 3)
    below = _areas(lows, highs)[:, :-1]
    above = _areas(lows[:, ::-1], highs[:, ::-1])[:, -2::-1]
    counts = np.arange(1, len(members))
    axis, place = divmod(int(np.argmin(below * counts + above * counts[::-1])), len(counts))
    return orders[axis, : place + 1], orders[axis, place + 1 :]


def _areas(lows: Array, highs: Array) -> Array:
    """Half the surface of the box around the first 1, 2, ... of some rows of boxes, (3, n) [m2]."""
    edges = np.maximum.accumulate(highs, axis=1) - np.minimum.accumulate(lows, axis=1)
    x, y, z = edges[..., 0], edges[..., 1], edges[..., 2]
    areas: Array = x * y + y * z + z * x
    return areas
