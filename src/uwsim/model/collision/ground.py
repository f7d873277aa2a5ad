r"""The ground as triangles: its height and slope, and the height at which a body rests on it.

The triangles are in W, z up. A body is lowered vertically until it touches the ground. The first
contact is at a corner of one of them above or below a face of the other, or where two edges cross
as seen from above. The vertical displacement to the first contact,

.. math:: \Delta z = \max_{(x, y)} \left( z_{ground} - z_{body} \right),

is the greatest over all such points, so that the result is exact for triangles. Only faces that
face up support a body, not ceilings or walls. Not modelled: tipping over, sinking into soft ground.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.linear import length, product, pseudo_inverse, rank
from ...bathymetry.height_grid import HeightGrid
from .shapes import CollisionShape

MIN_UPWARD_PART = 1e-6
"""The vertical component of a face's unit normal below which the face is a wall [1]."""
EDGE_TOLERANCE = 1e-9
"""The tolerance for a point inside a triangle, as a fraction of the triangle's area [1]."""
MAX_EDGE_PAIRS = 2_000_000
"""The greatest number of pairs of edges that are compared at once, which limits memory."""
N_CIRCLE_CORNERS = 32
"""The number of corners of a circle in the surface of a ball or cylinder."""
N_SAMPLES = 9
"""The number of sample points along each side of a body's box for fitting the slope below it."""
CUBE_CORNERS = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0
CUBE_FACES = np.array(
    [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
     [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]
)  # fmt: skip


class Ground:
    """The surface of the ground.

    Args:
        triangles: the triangles in W, corners counter-clockwise seen from outside, (n, 3, 3) [m].
        grids: charts of the sea floor in W, of which only the cells at a point or body are read.
    """

    def __init__(self, triangles: Array, grids: Sequence[HeightGrid] = ()) -> None:
        self._grids = tuple(grids)
        a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
        self._double_areas: Array = _cross(b[:, :2] - a[:, :2], c[:, :2] - a[:, :2])  # (n,) [m2]
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        is_slope = np.abs(self._double_areas) > MIN_UPWARD_PART * np.maximum(areas, 1e-12)
        self._double_areas = self._double_areas[is_slope]
        self._triangles = triangles[is_slope]
        self._low = self._triangles.min(axis=1)  # (n, 3) [m]
        self._high = self._triangles.max(axis=1)

    def __len__(self) -> int:
        return len(self._triangles) + sum(grid.heights.size for grid in self._grids)

    def _part_near(self, low: Array, high: Array) -> Ground:
        """Return the ground with the triangles of charts in a rectangle in x and y."""
        if not self._grids:
            return self
        parts = [self._triangles]
        for grid in self._grids:
            window = grid.window(low, high)
            if window is not None:
                parts.append(grid.part(*window).triangles())
        return Ground(np.concatenate(parts))

    def height_at(self, point: Array) -> float | None:
        """Return z of the ground in W at a point's x and y [m]; None if there is no ground.

        For a point below ground it is the surface above the point; otherwise it is the next surface
        below the point, or the lowest surface if all are above.
        """
        heights, faces_up = self._part_near(point, point)._column(point[0], point[1])
        floors = heights[faces_up]
        if not len(floors):
            return None
        faces_above = np.flatnonzero(heights > point[2])
        if len(faces_above):
            nearest_face = faces_above[np.argmin(heights[faces_above])]
            if faces_up[nearest_face]:
                return float(heights[nearest_face])
        floors_below = floors[floors <= point[2]]
        return float(floors_below.max() if len(floors_below) else floors.min())

    def covers(self, point: Array) -> bool:
        """Return whether a point in W (3,) is below ground: the next face above it faces up."""
        heights, faces_up = self._part_near(point, point)._column(point[0], point[1])
        faces_above = np.flatnonzero(heights > point[2])
        return bool(len(faces_above) and faces_up[faces_above[np.argmin(heights[faces_above])]])

    def rise(self, body: Array) -> float | None:
        """Compute the displacement upwards that sets a body on the ground [m]; None without ground.

        Args:
            body: the triangles of the body in W, (k, 3, 3) [m].
        """
        ground = self._part_near(body.min(axis=(0, 1)), body.max(axis=(0, 1)))
        faces = ground._faces_under(body)
        if faces is None:
            return None
        triangles, double_areas = faces
        max_rise = -np.inf
        step = max(1, MAX_EDGE_PAIRS // max(1, 9 * len(body)))
        for i in range(0, len(triangles), step):
            batch = triangles[i : i + step]
            max_rise = max(
                max_rise,
                _max_height_over_faces(body.reshape(-1, 3), batch, double_areas[i : i + step]),
                _max_height_over_faces(batch.reshape(-1, 3), *_nonvertical_faces(body), sign=-1.0),
                _max_height_over_edges(body, batch),
            )
        return None if max_rise == -np.inf else float(max_rise)

    def normal(self, body: Array) -> Array:
        """Return the upward unit normal of the plane that best fits the ground under a body, (3,).

        Args:
            body: the triangles of the body in W, (k, 3, 3) [m].
        """
        up = np.array([0.0, 0.0, 1.0])
        ground = self._part_near(body.min(axis=(0, 1)), body.max(axis=(0, 1)))
        faces = ground._faces_under(body)
        if faces is None:
            return up
        low, high = body.min(axis=(0, 1)), body.max(axis=(0, 1))
        grid = np.meshgrid(*(np.linspace(low[k], high[k], N_SAMPLES) for k in range(2)))
        points = np.stack([axis.ravel() for axis in grid], axis=1)  # (m, 2) [m]
        heights = _heights(points, *faces).max(axis=1, initial=-np.inf)
        is_ground = np.isfinite(heights)
        if is_ground.sum() < 3:
            return up
        table = np.column_stack([points[is_ground], np.ones(is_ground.sum())])
        if rank(table) < 3:
            return up
        slope_x, slope_y, _ = product(pseudo_inverse(table, rcond=1e-13), heights[is_ground])
        normal = np.array([-slope_x, -slope_y, 1.0])
        unit: Array = normal / length(normal)
        return unit

    def _column(self, x: float, y: float) -> tuple[Array, npt.NDArray[np.bool_]]:
        """Return z of all faces above and below a point [m], and whether each face faces up."""
        point = np.array([x, y])
        is_near = ((self._low[:, :2] <= point) & (self._high[:, :2] >= point)).all(axis=1)
        heights = _heights(point[None], self._triangles[is_near], self._double_areas[is_near])[0]
        is_hit = np.isfinite(heights)
        return heights[is_hit], self._double_areas[is_near][is_hit] > 0.0

    def _faces_under(self, body: Array) -> tuple[Array, Array] | None:
        """Return the faces that can support a body, and twice their horizontal areas [m2].

        These are upward faces under or beside the body, at most the height of the body above the
        ground at the centre of the body.
        """
        low, high = body.min(axis=(0, 1)), body.max(axis=(0, 1))
        is_near = (
            (self._low[:, :2] <= high[:2]).all(axis=1)
            & (self._high[:, :2] >= low[:2]).all(axis=1)
            & (self._double_areas > 0.0)
        )
        if not is_near.any():
            return None
        centre = 0.5 * (low + high)
        heights = [self.height_at(centre)]
        if heights[0] is None:
            heights = [self.height_at(corner) for corner in self._corners_above(body)]
        ground_heights = [height for height in heights if height is not None]
        if not ground_heights:
            return None
        is_near &= self._low[:, 2] <= max(ground_heights) + (high[2] - low[2])
        return self._triangles[is_near], self._double_areas[is_near]

    def _corners_above(self, body: Array) -> Array:
        """Return the different corners of a body within the horizontal bounds of the ground."""
        corners = np.unique(body.reshape(-1, 3), axis=0)
        low, high = self._low[:, :2].min(axis=0), self._high[:, :2].max(axis=0)
        is_within = ((corners[:, :2] >= low) & (corners[:, :2] <= high)).all(axis=1)
        inner_corners: Array = corners[is_within]
        return inner_corners


def triangles_of(shapes: Sequence[CollisionShape], world_from_body: Pose) -> Array:
    """Return the triangles of collision shapes in W, (n, 3, 3) [m].

    A circle is a polygon of `N_CIRCLE_CORNERS` corners.
    """
    triangles = [
        world_from_body.transform(
            shape.body_from_shape.transform(_surface(shape).reshape(-1, 3))
        ).reshape(-1, 3, 3)
        for shape in shapes
    ]
    return np.concatenate(triangles)


def _surface(shape: CollisionShape) -> Array:
    """Return the triangles of a shape in its frame, (n, 3, 3) [m], with no defined orientation."""
    if shape.kind == "box":
        faces: Array = (CUBE_CORNERS * np.array(shape.size))[CUBE_FACES]
        return faces
    from scipy.spatial import ConvexHull

    if shape.corners is not None:
        corners = shape.corners
    else:
        angles = np.linspace(0.0, 2.0 * np.pi, N_CIRCLE_CORNERS, endpoint=False)
        circle = np.column_stack([np.cos(angles), np.sin(angles)])
        if shape.kind == "cylinder":
            rings = [(1.0, -shape.size[1]), (1.0, shape.size[1])]
        else:  # corners at the lowest and highest points: the height is exact
            latitudes = np.linspace(-0.5 * np.pi, 0.5 * np.pi, N_CIRCLE_CORNERS // 2 + 1)
            radius = shape.size[0]
            rings = [(float(np.cos(angle)), radius * float(np.sin(angle))) for angle in latitudes]
        corners = np.concatenate(
            [
                np.column_stack([share * shape.size[0] * circle, np.full(N_CIRCLE_CORNERS, height)])
                for share, height in rings
            ]
        )
    hull = ConvexHull(corners)
    return np.asarray(hull.points[hull.simplices], dtype=np.float64)


def _cross(a: Array, b: Array) -> Array:
    product: Array = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product


def _nonvertical_faces(triangles: Array) -> tuple[Array, Array]:
    """Return the triangles that are not vertical, and twice their horizontal area."""
    a, b, c = triangles[:, 0, :2], triangles[:, 1, :2], triangles[:, 2, :2]
    double_areas = _cross(b - a, c - a)
    is_nonvertical = np.abs(double_areas) > 1e-12
    return triangles[is_nonvertical], double_areas[is_nonvertical]


def _heights(points: Array, triangles: Array, double_areas: Array) -> Array:
    """Return z of n triangles at horizontal positions (m, 2), (m, n) [m]; -inf outside."""
    a, b, c = (triangles[None, :, k, :2] for k in range(3))
    p = points[:, None, :]
    shares = [_cross(c - b, p - b), _cross(a - c, p - c), _cross(b - a, p - a)]
    heights = np.zeros((len(points), len(triangles)))
    is_inside = np.ones(heights.shape, dtype=bool)
    for k, share in enumerate(shares):
        part = share / double_areas
        is_inside &= part >= -EDGE_TOLERANCE
        heights += part * triangles[None, :, k, 2]
    masked_heights: Array = np.where(is_inside, heights, -np.inf)
    return masked_heights


def _max_height_over_faces(
    points: Array, triangles: Array, double_areas: Array, sign: float = 1.0
) -> float:
    """Return the greatest ``sign * (z of a face - z of a point on its vertical)`` [m], or -inf."""
    if not len(triangles):
        return -np.inf
    heights = _heights(points[:, :2], triangles, double_areas)
    return float((sign * (heights - points[:, 2:]))[np.isfinite(heights)].max(initial=-np.inf))


def _max_height_over_edges(body: Array, ground: Array) -> float:
    """Return the greatest height of a ground edge over an edge of the body that it crosses [m]."""
    a, b = (np.concatenate([body[:, k] for k in order]) for order in ((0, 1, 2), (1, 2, 0)))
    p, q = (np.concatenate([ground[:, k] for k in order]) for order in ((0, 1, 2), (1, 2, 0)))
    body_edge, ground_edge = (b - a)[:, None], (q - p)[None]
    start = p[None] - a[:, None]
    denominator = _cross(body_edge, ground_edge)
    with np.errstate(divide="ignore", invalid="ignore"):
        s = _cross(start, ground_edge) / denominator
        t = _cross(start, body_edge) / denominator
        is_crossing = (s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0)
        heights = start[..., 2] + t * ground_edge[..., 2] - s * body_edge[..., 2]
    return float(heights[is_crossing].max(initial=-np.inf))
