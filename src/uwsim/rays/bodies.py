"""The poses of the bodies of a scene, and the compiled search for bodies near rays.

Each body has a bounding ball. A tree of boxes in the world frame W contains the balls. Each box has
a margin: while a body stays within the margin of its box, the tree is not changed. When it leaves
the box, only that box and the boxes around it are computed again. The transforms of a body are
computed when rays come near it, and remain valid until it moves.

A body either follows a body of the physics engine, or has a pose that `RayScene.place` sets.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from ..base.numerics.linear import invert
from .packet import Bounds, box_entry
from .tree import build_nodes
from .triangle import IntArray, Point, transform_point

BOX_MARGIN = 0.05
"""The margin of a box on each side, as a fraction of the radius of the body's ball."""
RADIUS_FACTOR = 1.0 + 1e-6
"""The factor by which a radius is enlarged to compensate rounding."""
MAX_INSERTION_SORT = 24
"""The largest number of bodies that are sorted by insertion."""


class Bodies(NamedTuple):
    """The b bodies of a scene, and the tree of boxes around them with k nodes."""

    balls: Array
    """The centre and radius of the bounding ball of each body, in the body's frame, (b, 4) [m]."""
    engine_body: IntArray
    """The index of the engine's body that each body follows; below 0 if its pose is set, (b,)."""
    world_from_body: Array
    """The transforms at the last update; NaN before it if a body follows the engine, (b, 4, 4)."""
    body_from_world: Array
    """The inverse transforms, (b, 4, 4)."""
    centres: Array
    """The centre in W and radius of each ball when its box was computed, (b, 4) [m]."""
    boxes: Array
    """The lower and upper corner in W of the box of each node's two children, (k, 12) [m]."""
    links: IntArray
    """The node of each child and 0; or, of a leaf, its start in `order` and its number of bodies,
    (k, 4)."""
    order: IntArray
    """The indices of the bodies in the order of the leaves, (b,)."""
    parents: IntArray
    """The parent of each node: 2 p + side, with the parent's node p and the side 0 or 1 of the
    child; -1 for the root, (k,)."""
    leaves: IntArray
    """The leaf of each body: 2 p + side, as in `parents`, (b,)."""


class EngineFrames(NamedTuple):
    """The present frames of the m bodies of the physics engine."""

    origins: Array
    """The origins in W, (m, 3) [m]."""
    axes: Array
    """The rotation matrices ``world_from_body``, (m, 3, 3)."""


NO_ENGINE_FRAMES = EngineFrames(np.zeros((0, 3)), np.zeros((0, 3, 3)))
"""The frames for a scene without a physics engine."""


def make_bodies(balls: Array, engine_body: IntArray, engine_frames: EngineFrames) -> Bodies:
    """Return bodies at their present poses; a pose that is not of the engine is the identity.

    Args:
        balls: the centre and radius of each body's bounding ball, in its frame, (b, 4) [m].
        engine_body: the index of the engine's body that each body follows, or below 0, (b,).
        engine_frames: the frames of the engine's bodies.
    """
    n = len(balls)
    frames = np.tile(np.eye(4), (n, 1, 1))
    frames[engine_body >= 0] = np.nan
    centres = np.zeros((n, 4))
    _find_centres(balls, engine_body, frames, engine_frames, centres)
    half_size = (1.0 + BOX_MARGIN) * centres[:, 3:]
    tree = build_nodes(centres[:, :3] - half_size, centres[:, :3] + half_size)
    parents, leaves = np.full(len(tree.links), -1, np.int32), np.zeros(n, np.int32)
    for node, row in enumerate(tree.links.tolist()):
        for side in range(2):
            start, count = row[2 * side], row[2 * side + 1]
            if count:
                leaves[tree.order[start : start + count]] = 2 * node + side
            elif start:
                parents[start] = 2 * node + side
    return Bodies(balls, engine_body, frames, frames.copy(), centres, *tree, parents, leaves)


@njit
def _find_centres(
    balls: Array, engine_body: IntArray, frames: Array, engine_frames: EngineFrames, centres: Array
) -> None:
    for body in range(len(balls)):
        x, y, z, radius = _ball(balls[body], engine_body[body], frames[body], engine_frames)
        centres[body, 0], centres[body, 1], centres[body, 2] = x, y, z
        centres[body, 3] = radius


@njit
def _ball(
    ball: Array, engine_body: int, frame: Array, engine_frames: EngineFrames
) -> tuple[float, float, float, float]:
    """Return the centre in W and the radius of a body's ball [m]."""
    if engine_body < 0:
        x, y, z = transform_point(frame, ball[0], ball[1], ball[2], 1.0)
        stretch = 0.0
        for row in range(3):
            for column in range(3):
                stretch += frame[row, column] ** 2
        return x, y, z, ball[3] * math.sqrt(stretch)  # an upper bound of the greatest scale factor
    o, a = engine_frames.origins[engine_body], engine_frames.axes[engine_body]
    return (
        o[0] + a[0, 0] * ball[0] + a[0, 1] * ball[1] + a[0, 2] * ball[2],
        o[1] + a[1, 0] * ball[0] + a[1, 1] * ball[1] + a[1, 2] * ball[2],
        o[2] + a[2, 0] * ball[0] + a[2, 1] * ball[1] + a[2, 2] * ball[2],
        ball[3] * RADIUS_FACTOR,
    )


@njit
def update_boxes(bodies: Bodies, engine_frames: EngineFrames) -> None:
    """Compute the boxes of the bodies that have left their boxes."""
    for body in range(len(bodies.balls)):
        x, y, z, radius = _ball(
            bodies.balls[body],
            bodies.engine_body[body],
            bodies.world_from_body[body],
            engine_frames,
        )
        c = bodies.centres[body]
        margin = BOX_MARGIN * c[3]
        square_distance = (x - c[0]) ** 2 + (y - c[1]) ** 2 + (z - c[2]) ** 2
        if square_distance <= margin * margin and radius == c[3]:
            continue
        c[0], c[1], c[2], c[3] = x, y, z, radius
        _update_box(bodies, bodies.leaves[body])


@njit
def _update_box(bodies: Bodies, child: int) -> None:
    """Compute the box of a leaf, then the boxes around it as long as they change.

    Args:
        bodies: the bodies, whose boxes are changed.
        child: the leaf, as in `Bodies.leaves`.
    """
    node, side = child // 2, child % 2
    start, count = bodies.links[node, 2 * side], bodies.links[node, 2 * side + 1]
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for k in range(start, start + count):
        c = bodies.centres[bodies.order[k]]
        half = (1.0 + BOX_MARGIN) * c[3]
        x0, y0, z0 = min(x0, c[0] - half), min(y0, c[1] - half), min(z0, c[2] - half)
        x1, y1, z1 = max(x1, c[0] + half), max(y1, c[1] + half), max(z1, c[2] + half)
    while _set_box(bodies.boxes, node, 6 * side, (x0, y0, z0), (x1, y1, z1)):
        parent = bodies.parents[node]
        if parent < 0:
            return
        b = bodies.boxes[node]
        x0, y0, z0 = min(b[0], b[6]), min(b[1], b[7]), min(b[2], b[8])
        x1, y1, z1 = max(b[3], b[9]), max(b[4], b[10]), max(b[5], b[11])
        node, side = parent // 2, parent % 2


@njit
def _set_box(boxes: Array, node: int, column: int, low: Point, high: Point) -> bool:
    """Set a box; return whether it has changed."""
    changes = False
    for k in range(3):
        changes |= boxes[node, column + k] != low[k] or boxes[node, column + 3 + k] != high[k]
        boxes[node, column + k], boxes[node, column + 3 + k] = low[k], high[k]
    return changes


@njit
def update_frames(bodies: Bodies, engine_frames: EngineFrames, body: int) -> None:
    """Compute the transforms of a body that follows the engine, if it has moved."""
    engine_body = bodies.engine_body[body]
    if engine_body < 0:
        return
    o, a, frame = (
        engine_frames.origins[engine_body],
        engine_frames.axes[engine_body],
        bodies.world_from_body[body],
    )
    is_same = True
    for i in range(3):
        is_same &= frame[i, 3] == o[i]
        for j in range(3):
            is_same &= frame[i, j] == a[i, j]
    if is_same:
        return
    for i in range(3):
        frame[i, 3], frame[3, i] = o[i], 0.0
        for j in range(3):
            frame[i, j] = a[i, j]
    frame[3, 3] = 1.0
    invert(frame, bodies.body_from_world[body])


@njit
def update_all_frames(bodies: Bodies, engine_frames: EngineFrames) -> None:
    """Compute the transforms of all bodies that have moved."""
    for body in range(len(bodies.balls)):
        update_frames(bodies, engine_frames, body)


@njit
def find_near_bodies(
    bodies: Bodies,
    engine_frames: EngineFrames,
    origin: Point,
    beam: tuple[Bounds, Cone],
    reach: float,
    stack: IntArray,
    near_bodies: IntArray,
) -> int:
    """Find the bodies that some rays may hit, sorted by index.

    Args:
        bodies: the bodies of the scene.
        engine_frames: the frames of the engine's bodies.
        origin: the origin of the rays in W [m].
        beam: the bounds of the inverse directions in W, and a cone around the rays.
        reach: the length of the rays [m].
        stack: a workspace for nodes, (k,).
        near_bodies: receives the indices of the bodies, (b,).

    Returns:
        The number of bodies found.
    """
    bounds, cone = beam
    n, n_waiting, node = 0, 0, 0
    while True:
        for side in range(2):
            if box_entry(bodies.boxes[node], 6 * side, origin, bounds, reach) == np.inf:
                continue
            start, count = bodies.links[node, 2 * side], bodies.links[node, 2 * side + 1]
            if count == 0:
                stack[n_waiting] = start
                n_waiting += 1
            for k in range(start, start + count):
                body = bodies.order[k]
                if not is_missed(bodies, engine_frames, body, origin, cone, reach):
                    near_bodies[n] = body
                    n += 1
        if n_waiting == 0:
            break
        n_waiting -= 1
        node = stack[n_waiting]
    if n <= MAX_INSERTION_SORT:
        for i in range(1, n):
            number, j = near_bodies[i], i
            while j > 0 and near_bodies[j - 1] > number:
                near_bodies[j] = near_bodies[j - 1]
                j -= 1
            near_bodies[j] = number
    else:
        near_bodies[:n].sort()
    return n


class Cone(NamedTuple):
    """A cone around rays from one point."""

    axis: Point
    """The unit vector along the axis in W; about zero if the rays have no common direction."""
    half_angle: float
    """The angle between the axis and the surface of the cone [rad]."""


@njit
def is_missed(
    bodies: Bodies, engine_frames: EngineFrames, body: int, origin: Point, cone: Cone, reach: float
) -> bool:
    """Return whether no ray of a cone can hit the ball of a body within ``reach`` [m]."""
    x, y, z, radius = _ball(
        bodies.balls[body], bodies.engine_body[body], bodies.world_from_body[body], engine_frames
    )
    x, y, z = x - origin[0], y - origin[1], z - origin[2]
    distance = math.sqrt(x * x + y * y + z * z)
    if distance <= radius:
        return False
    if distance - radius > reach:
        return True
    ax, ay, az = cone.axis
    cosine = (x * ax + y * ay + z * az) / distance
    angle = math.acos(min(max(cosine, -1.0), 1.0))
    return angle > cone.half_angle + math.asin(radius / distance)
