r"""The engine's bounding volume tree over the fixed shapes, rebuilt by the surface area heuristic.

MuJoCo splits nodes of the tree at the median. The shapes of a tank or a wreck are large plates
around a free volume, where the vehicles are; the boxes of both halves then overlap in this volume.
Here a node is split where the cost of the surface area heuristic is least,

.. math:: A_{left}\,n_{left} + A_{right}\,n_{right}

with the surface area A of the box of each half, and its number of shapes n (MacDonald and Booth,
Heuristics for ray tracing using space subdivision, The Visual Computer 6, 1990). The tree has the
same shapes, and a query visits fewer boxes.

Fixed shapes are placed only once: see `place_fixed_shapes`.
"""

from __future__ import annotations

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array

WORLD = 0
"""The MuJoCo ID of the world's body, which has all fixed shapes."""
N_LISTED_SHAPES = 2
"""The number of fixed shapes that the engine lists; with one shape it would not use the tree."""
MAX_DEPTH = 40
"""The depth below which nodes are halved at the median; the engine allows 50."""

Ints = npt.NDArray[np.int64]


def rebuild_world_tree(model: mujoco.MjModel) -> None:
    """Replace the engine's tree over the shapes of the world's body."""
    start, count = int(model.body_bvhadr[WORLD]), int(model.body_bvhnum[WORLD])
    rows = slice(start, start + count)
    leaves = np.flatnonzero(model.bvh_nodeid[rows] >= 0)
    if len(leaves) < 3:
        return
    shapes = model.bvh_nodeid[rows][leaves].copy()
    boxes = model.bvh_aabb[rows][leaves].copy()  # (n, 6): middle, half edges [m]
    low, high = boxes[:, :3] - boxes[:, 3:], boxes[:, :3] + boxes[:, 3:]
    tree_boxes, children = model.bvh_aabb[rows], model.bvh_child[rows]
    depths, numbers = model.bvh_depth[rows], model.bvh_nodeid[rows]
    node = 0
    stack: list[tuple[Ints, int, int, int]] = [(np.arange(len(leaves)), -1, 0, 0)]
    while stack:
        members, parent, side, depth = stack.pop()
        lower, upper = low[members].min(axis=0), high[members].max(axis=0)
        tree_boxes[node, :3], tree_boxes[node, 3:] = 0.5 * (lower + upper), 0.5 * (upper - lower)
        depths[node], children[node] = depth, -1
        numbers[node] = shapes[members[0]] if len(members) == 1 else -1
        if parent >= 0:
            children[parent, side] = node
        if len(members) > 1:
            left, right = _split(members, low, high, depth)
            stack += [(right, node, 1, depth + 1), (left, node, 0, depth + 1)]
        node += 1


def place_fixed_shapes(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Compute the poses of the world's shapes once, and list only a few shapes in the engine.

    In every step, the engine reads the collision bits of all listed shapes for each body, and
    computes their poses unless sleeping is enabled. The tree, in which the engine searches for
    contacts, still has all shapes. Only ``data`` and its copies have the poses of the shapes:
    another ``mjData`` of this model finds no contacts with them, nor does ``data`` after a reset.
    """
    start, count = int(model.body_geomadr[WORLD]), int(model.body_geomnum[WORLD])
    if count <= N_LISTED_SHAPES or model.body_bvhnum[WORLD] == 0:
        return
    shapes = slice(start, start + count)
    if any(
        len(np.unique(bits[shapes])) > 1 for bits in (model.geom_contype, model.geom_conaffinity)
    ):
        return
    mujoco.mj_kinematics(model, data)
    model.body_geomnum[WORLD] = N_LISTED_SHAPES


def _split(members: Ints, low: Array, high: Array, depth: int) -> tuple[Ints, Ints]:
    centres = low[members] + high[members]
    orders = members[np.argsort(centres, axis=0, kind="stable").T]  # (3, n): along each axis
    if len(members) == 2:
        return orders[0, :1], orders[0, 1:]
    if depth >= MAX_DEPTH:
        order = orders[int(np.argmax(np.ptp(centres, axis=0)))]
        half = len(order) // 2
        return order[:half], order[half:]
    lows, highs = low[orders], high[orders]  # (3, n, 3)
    left = _areas(lows, highs)[:, :-1]
    right = _areas(lows[:, ::-1], highs[:, ::-1])[:, -2::-1]
    counts = np.arange(1, len(members))
    axis, cut = divmod(int(np.argmin(left * counts + right * counts[::-1])), len(counts))
    return orders[axis, : cut + 1], orders[axis, cut + 1 :]


def _areas(lows: Array, highs: Array) -> Array:
    """Return half the surface area of the boxes around the first 1, 2, ... n rows, (3, n) [m2]."""
    edges = np.maximum.accumulate(highs, axis=1) - np.minimum.accumulate(lows, axis=1)
    x, y, z = edges[..., 0], edges[..., 1], edges[..., 2]
    areas: Array = x * y + y * z + z * x
    return areas
