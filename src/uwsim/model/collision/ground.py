r"""The ground: its height and slope, and the pose of a body at rest on it.

The ground is triangles in W, z up. A body is lowered vertically until it touches the ground.
Two sheets of triangles touch first at a corner of the one above a face of the other, or where two
edges cross as seen from above; the height at which they do,

.. math:: \Delta z = \max_{(x, y)} \left( z_{ground} - z_{body} \right),

is the greatest over all such places, so that the result is exact for triangles. Only faces that
look up carry: a roof does not, nor does a wall. Not modelled: tipping over, sinking in.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.linear import length, product, pseudo_inverse, rank
from .shapes import CollisionShape

STEEPEST = 1e-6
"""A face whose normal has less of an upward part than this is a wall [1]."""
TOUCH = 1e-9
"""How far outside of a triangle a point still counts as in it, as a share of its area."""
AT_ONCE = 2_000_000
"""Pairs of edges looked at together."""
ROUND = 32
"""Corners of a circle in the shape of a ball or cylinder."""
SAMPLES = 9
"""Heights along each side of what stands on a slope, to find its steepness from."""
CUBE = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0
CUBE_FACES = np.array(
    [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
     [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]
)  # fmt: skip


class Ground:
    """The triangles of the ground.

    Args:
        triangles: counter-clockwise from where they are seen, in W, (n, 3, 3) [m].
    """

    def __init__(self, triangles: Array) -> None:
        a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
        self._doubled: Array = _cross(b[:, :2] - a[:, :2], c[:, :2] - a[:, :2])  # (n,) [m2]
        level = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        seen = np.abs(self._doubled) > STEEPEST * np.maximum(level, 1e-12)
        self._doubled = self._doubled[seen]
        self._triangles = triangles[seen]
        self._low = self._triangles.min(axis=1)  # (n, 3) [m]
        self._high = self._triangles.max(axis=1)

    def __len__(self) -> int:
        return len(self._triangles)

    def level(self, point: Array) -> float | None:
        """Height of the ground at a point's x and y; None where there is none.

        That which the point lies in or under the surface of, else the next one below it, else
        the lowest.
        """
        heights, looks_up = self._column(point[0], point[1])
        floors = heights[looks_up]
        if not len(floors):
            return None
        above = np.flatnonzero(heights > point[2])
        if len(above):
            nearest = above[np.argmin(heights[above])]
            if looks_up[nearest]:
                return float(heights[nearest])
        below = floors[floors <= point[2]]
        return float(below.max() if len(below) else floors.min())

    def covers(self, point: Array) -> bool:
        """Whether a point (3,) lies under the surface: the next face above it looks up."""
        heights, looks_up = self._column(point[0], point[1])
        above = np.flatnonzero(heights > point[2])
        return bool(len(above) and looks_up[above[np.argmin(heights[above])]])

    def rise(self, body: Array) -> float | None:
        """How far a body must be lifted to rest on the ground; None where there is none under it.

        Args:
            body: its triangles in W, (k, 3, 3) [m].
        """
        near = self._under(body)
        if near is None:
            return None
        triangles, doubled = near
        best = -np.inf
        step = max(1, AT_ONCE // max(1, 9 * len(body)))
        for i in range(0, len(triangles), step):
            some = triangles[i : i + step]
            best = max(
                best,
                _over_faces(body.reshape(-1, 3), some, doubled[i : i + step]),
                _over_faces(some.reshape(-1, 3), *_upright(body), sign=-1.0),
                _over_edges(body, some),
            )
        return None if best == -np.inf else float(best)

    def normal(self, body: Array) -> Array:
        """Normal of the plane that fits the ground under a body best, upwards, (3,).

        Args:
            body: its triangles in W, (k, 3, 3) [m].
        """
        up = np.array([0.0, 0.0, 1.0])
        near = self._under(body)
        if near is None:
            return up
        low, high = body.min(axis=(0, 1)), body.max(axis=(0, 1))
        grid = np.meshgrid(*(np.linspace(low[k], high[k], SAMPLES) for k in range(2)))
        points = np.stack([each.ravel() for each in grid], axis=1)  # (m, 2) [m]
        heights = _heights(points, *near).max(axis=1, initial=-np.inf)
        found = np.isfinite(heights)
        if found.sum() < 3:
            return up
        table = np.column_stack([points[found], np.ones(found.sum())])
        if rank(table) < 3:
            return up
        along_x, along_y, _ = product(pseudo_inverse(table, rcond=1e-13), heights[found])
        normal = np.array([-along_x, -along_y, 1.0])
        unit: Array = normal / length(normal)
        return unit

    def _column(self, x: float, y: float) -> tuple[Array, npt.NDArray[np.bool_]]:
        """Heights of all faces over and under a point of the plane, and whether they look up."""
        at = np.array([x, y])
        near = ((self._low[:, :2] <= at) & (self._high[:, :2] >= at)).all(axis=1)
        heights = _heights(at[None], self._triangles[near], self._doubled[near])[0]
        hit = np.isfinite(heights)
        return heights[hit], self._doubled[near][hit] > 0.0

    def _under(self, body: Array) -> tuple[Array, Array] | None:
        """The faces below a body, and twice their horizontal area.

        They look up, and are no higher above the ground in its middle than it is high.
        """
        low, high = body.min(axis=(0, 1)), body.max(axis=(0, 1))
        near = (
            (self._low[:, :2] <= high[:2]).all(axis=1)
            & (self._high[:, :2] >= low[:2]).all(axis=1)
            & (self._doubled > 0.0)
        )
        middle = 0.5 * (low + high)
        levels = [self.level(middle)]
        if levels[0] is None:
            levels = [self.level(corner) for corner in body.reshape(-1, 3)]
        known = [level for level in levels if level is not None]
        if not known:
            return None
        near &= self._low[:, 2] <= max(known) + (high[2] - low[2])
        return self._triangles[near], self._doubled[near]


def triangles_of(shapes: Sequence[CollisionShape], world_from_body: Pose) -> Array:
    """The surface of shapes in W, (n, 3, 3) [m]; balls and cylinders have `ROUND` corners."""
    found = [
        world_from_body.transform(
            shape.body_from_shape.transform(_surface(shape).reshape(-1, 3))
        ).reshape(-1, 3, 3)
        for shape in shapes
    ]
    return np.concatenate(found)


def _surface(shape: CollisionShape) -> Array:
    """Triangles of a shape in its own frame, (n, 3, 3) [m]; which way they turn is not said."""
    if shape.kind == "box":
        faces: Array = (CUBE * np.array(shape.size))[CUBE_FACES]
        return faces
    from scipy.spatial import ConvexHull

    if shape.corners is not None:
        corners = shape.corners
    else:
        turn = np.linspace(0.0, 2.0 * np.pi, ROUND, endpoint=False)
        circle = np.column_stack([np.cos(turn), np.sin(turn)])
        if shape.kind == "cylinder":
            rings = [(1.0, -shape.size[1]), (1.0, shape.size[1])]
        else:  # a corner at the lowest and the highest point, so that it stands as high as a ball
            lean = np.linspace(-0.5 * np.pi, 0.5 * np.pi, ROUND // 2 + 1)
            rings = [(float(np.cos(one)), shape.size[0] * float(np.sin(one))) for one in lean]
        corners = np.concatenate(
            [
                np.column_stack([share * shape.size[0] * circle, np.full(ROUND, height)])
                for share, height in rings
            ]
        )
    hull = ConvexHull(corners)
    return np.asarray(hull.points[hull.simplices], dtype=np.float64)


def _cross(a: Array, b: Array) -> Array:
    """``a x b`` of vectors of the plane, (..., 2)."""
    product: Array = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product


def _upright(triangles: Array) -> tuple[Array, Array]:
    """The triangles that are not vertical, and twice their horizontal area."""
    a, b, c = triangles[:, 0, :2], triangles[:, 1, :2], triangles[:, 2, :2]
    doubled = _cross(b - a, c - a)
    kept = np.abs(doubled) > 1e-12
    return triangles[kept], doubled[kept]


def _heights(points: Array, triangles: Array, doubled: Array) -> Array:
    """Heights of triangles (n) at points of the plane (m, 2), (m, n) [m]; -inf beside them."""
    a, b, c = (triangles[None, :, k, :2] for k in range(3))
    at = points[:, None, :]
    shares = [_cross(c - b, at - b), _cross(a - c, at - c), _cross(b - a, at - a)]
    heights = np.zeros((len(points), len(triangles)))
    inside = np.ones(heights.shape, dtype=bool)
    for k, share in enumerate(shares):
        part = share / doubled
        inside &= part >= -TOUCH
        heights += part * triangles[None, :, k, 2]
    found: Array = np.where(inside, heights, -np.inf)
    return found


def _over_faces(points: Array, triangles: Array, doubled: Array, sign: float = 1.0) -> float:
    """Greatest ``sign * (height of a face - height of a point over or under it)`` [m]; or -inf."""
    if not len(triangles):
        return -np.inf
    heights = _heights(points[:, :2], triangles, doubled)
    return float((sign * (heights - points[:, 2:]))[np.isfinite(heights)].max(initial=-np.inf))


def _over_edges(body: Array, ground: Array) -> float:
    """Greatest height of an edge of the ground over one of the body where they cross [m]."""
    a, b = (np.concatenate([body[:, k] for k in order]) for order in ((0, 1, 2), (1, 2, 0)))
    p, q = (np.concatenate([ground[:, k] for k in order]) for order in ((0, 1, 2), (1, 2, 0)))
    way, other = (b - a)[:, None], (q - p)[None]
    start = p[None] - a[:, None]
    turn = _cross(way, other)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = _cross(start, other) / turn
        across = _cross(start, way) / turn
        meets = (along >= 0.0) & (along <= 1.0) & (across >= 0.0) & (across <= 1.0)
        heights = start[..., 2] + across * other[..., 2] - along * way[..., 2]
    return float(heights[meets].max(initial=-np.inf))
