"""Where the bodies of a scene are, and which of them rays may meet, compiled.

A tree of boxes in W is over the balls of the bodies. A box has some room: a body that moves within
it changes nothing; one that leaves it has a new one, and the boxes around it are made anew, no
others. The frames of a body are computed when rays come near it, and kept while it stays.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..base.geometry import Array
from ..base.numerics.jit import njit
from ..base.numerics.linear import invert
from .packet import Bounds, enters
from .tree import build_nodes
from .triangle import Point, Whole, placed

ROOM = 0.05
"""Of a box on each side, as a share of the radius of its body."""
SURE = 1.0 + 1e-6
"""Factor of a radius, so that rounding leaves nothing out."""
FEW = 24
"""Bodies that are sorted by insertion."""


class Bodies(NamedTuple):
    """The bodies of a scene."""

    balls: Array
    """Centre and radius of a ball around each, in its frame, (b, 4) [m]."""
    engine: Whole
    """Number of the engine's body that each follows; below 0 it is placed, (b,)."""
    world_from_body: Array
    """As it was when rays came near the body last; NaN before, where it follows, (b, 4, 4) [m]."""
    body_from_world: Array
    """The inverse of that, (b, 4, 4) [m]."""
    centres: Array
    """Of each ball in W when its box was made, then its radius, (b, 4) [m]."""
    boxes: Array
    """Of both children of each node of the tree, (k, 12) [m]."""
    links: Whole
    """Of both children: their node, or their first place in the order; bodies in it, (k, 4)."""
    order: Whole
    """Number of the body at each place of the leaves, (b,)."""
    parents: Whole
    """Twice the node above each node, and one more for its second child; -1 at the root, (k,)."""
    leaves: Whole
    """The same of each body, (b,)."""


class Engine(NamedTuple):
    """Where the bodies of the engine are, now."""

    origins: Array
    """(m, 3) [m]."""
    axes: Array
    """(m, 3, 3)."""


NO_ENGINE = Engine(np.zeros((0, 3)), np.zeros((0, 3, 3)))
"""Of a scene whose bodies are placed."""


def bodies_of(balls: Array, engine: Whole, place: Engine) -> Bodies:
    """Return bodies where they are now, those that are placed in the place of W.

    Args:
        balls: centre and radius of a ball around each, in its frame, (b, 4) [m].
        engine: number of the engine's body that each follows, or below 0, (b,).
        place: where those are.
    """
    n = len(balls)
    frames = np.tile(np.eye(4), (n, 1, 1))
    frames[engine >= 0] = np.nan
    centres = np.zeros((n, 4))
    _find_centres(balls, engine, frames, place, centres)
    half = (1.0 + ROOM) * centres[:, 3:]
    tree = build_nodes(centres[:, :3] - half, centres[:, :3] + half)
    parents, leaves = np.full(len(tree.links), -1, np.int32), np.zeros(n, np.int32)
    for node, row in enumerate(tree.links.tolist()):
        for side in range(2):
            where, count = row[2 * side], row[2 * side + 1]
            if count:
                leaves[tree.order[where : where + count]] = 2 * node + side
            elif where:
                parents[where] = 2 * node + side
    return Bodies(balls, engine, frames, frames.copy(), centres, *tree, parents, leaves)


@njit
def _find_centres(
    balls: Array, engine: Whole, frames: Array, place: Engine, centres: Array
) -> None:
    for body in range(len(balls)):
        x, y, z, radius = _ball(balls[body], engine[body], frames[body], place)
        centres[body, 0], centres[body, 1], centres[body, 2] = x, y, z
        centres[body, 3] = radius


@njit
def _ball(
    ball: Array, followed: int, frame: Array, place: Engine
) -> tuple[float, float, float, float]:
    """Centre and radius of a ball in W [m]."""
    if followed < 0:
        x, y, z = placed(frame, ball[0], ball[1], ball[2], 1.0)
        stretch = 0.0
        for row in range(3):
            for column in range(3):
                stretch += frame[row, column] ** 2
        return x, y, z, ball[3] * math.sqrt(stretch)  # at least the greatest factor
    o, a = place.origins[followed], place.axes[followed]
    return (
        o[0] + a[0, 0] * ball[0] + a[0, 1] * ball[1] + a[0, 2] * ball[2],
        o[1] + a[1, 0] * ball[0] + a[1, 1] * ball[1] + a[1, 2] * ball[2],
        o[2] + a[2, 0] * ball[0] + a[2, 1] * ball[1] + a[2, 2] * ball[2],
        ball[3] * SURE,
    )


@njit
def follow(bodies: Bodies, place: Engine) -> None:
    """Give each body that has left its box a new one."""
    for body in range(len(bodies.balls)):
        x, y, z, radius = _ball(
            bodies.balls[body], bodies.engine[body], bodies.world_from_body[body], place
        )
        c = bodies.centres[body]
        room = ROOM * c[3]
        away = (x - c[0]) ** 2 + (y - c[1]) ** 2 + (z - c[2]) ** 2
        if away <= room * room and radius == c[3]:
            continue
        c[0], c[1], c[2], c[3] = x, y, z, radius
        _renew(bodies, bodies.leaves[body])


@njit
def _renew(bodies: Bodies, child: int) -> None:
    """Make the box of a leaf anew, and those that it is in as long as they change."""
    node, side = child // 2, child % 2
    first, count = bodies.links[node, 2 * side], bodies.links[node, 2 * side + 1]
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for k in range(first, first + count):
        c = bodies.centres[bodies.order[k]]
        half = (1.0 + ROOM) * c[3]
        x0, y0, z0 = min(x0, c[0] - half), min(y0, c[1] - half), min(z0, c[2] - half)
        x1, y1, z1 = max(x1, c[0] + half), max(y1, c[1] + half), max(z1, c[2] + half)
    while _set_box(bodies.boxes, node, 6 * side, (x0, y0, z0), (x1, y1, z1)):
        above = bodies.parents[node]
        if above < 0:
            return
        b = bodies.boxes[node]
        x0, y0, z0 = min(b[0], b[6]), min(b[1], b[7]), min(b[2], b[8])
        x1, y1, z1 = max(b[3], b[9]), max(b[4], b[10]), max(b[5], b[11])
        node, side = above // 2, above % 2


@njit
def _set_box(boxes: Array, node: int, at: int, low: Point, high: Point) -> bool:
    """Set a box; whether it was another."""
    changes = False
    for k in range(3):
        changes |= boxes[node, at + k] != low[k] or boxes[node, at + 3 + k] != high[k]
        boxes[node, at + k], boxes[node, at + 3 + k] = low[k], high[k]
    return changes


@njit
def renew_frames(bodies: Bodies, place: Engine, body: int) -> None:
    """Compute the frames of a body that follows one of the engine, if that has moved."""
    followed = bodies.engine[body]
    if followed < 0:
        return
    o, a, frame = place.origins[followed], place.axes[followed], bodies.world_from_body[body]
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
def renew_all_frames(bodies: Bodies, place: Engine) -> None:
    """Compute the frames of all bodies that have moved."""
    for body in range(len(bodies.balls)):
        renew_frames(bodies, place, body)


@njit
def find_near(
    bodies: Bodies,
    place: Engine,
    origin: Point,
    beam: tuple[Bounds, Cone],
    reach: float,
    stack: Whole,
    found: Whole,
) -> int:
    """Find the bodies that some rays may meet, by their numbers.

    Args:
        bodies: of the scene.
        place: where those of the engine are.
        origin: of the rays, in W [m].
        beam: bounds of one over the directions in W, and a cone around them.
        reach: how far the rays go [m].
        stack: for nodes that wait, (k,).
        found: for the result, (b,).

    Returns:
        How many they are.
    """
    bounds, cone = beam
    n, n_waiting, node = 0, 0, 0
    while True:
        for side in range(2):
            if enters(bodies.boxes[node], 6 * side, origin, bounds, reach) == np.inf:
                continue
            where, count = bodies.links[node, 2 * side], bodies.links[node, 2 * side + 1]
            if count == 0:
                stack[n_waiting] = where
                n_waiting += 1
            for k in range(where, where + count):
                body = bodies.order[k]
                if not is_missed(bodies, place, body, origin, cone, reach):
                    found[n] = body
                    n += 1
        if n_waiting == 0:
            break
        n_waiting -= 1
        node = stack[n_waiting]
    if n <= FEW:
        for i in range(1, n):
            each, j = found[i], i
            while j > 0 and found[j - 1] > each:
                found[j] = found[j - 1]
                j -= 1
            found[j] = each
    else:
        found[:n].sort()
    return n


class Cone(NamedTuple):
    """A cone around rays."""

    axis: Point
    """Its axis; zero where the rays go all around."""
    half_angle: float
    """[rad]."""


@njit
def is_missed(
    bodies: Bodies, place: Engine, body: int, origin: Point, cone: Cone, reach: float
) -> bool:
    """Whether no ray of a cone comes near a body within ``reach`` [m]."""
    x, y, z, radius = _ball(
        bodies.balls[body], bodies.engine[body], bodies.world_from_body[body], place
    )
    x, y, z = x - origin[0], y - origin[1], z - origin[2]
    distance = math.sqrt(x * x + y * y + z * z)
    if distance <= radius:
        return False
    if distance - radius > reach:
        return True
    ax, ay, az = cone.axis
    along = (x * ax + y * ay + z * az) / distance
    between = math.acos(min(max(along, -1.0), 1.0))
    return between > cone.half_angle + math.asin(radius / distance)
