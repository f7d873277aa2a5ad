"""Polylines: paths of straight segments, and paths whose corners are rounded by arcs."""

from __future__ import annotations

import bisect
import math

import numpy as np

from ..geometry import Array
from .linear import cross, dot, length

MIN_TURN = 1e-9
"""The angle below which a corner is straight [rad]."""


class Polyline:
    """A path of points joined by straight segments; a single point is a segment of length 0."""

    def __init__(self, points: Array) -> None:
        """Join n >= 1 points (n, 3) [m] by segments."""
        positions = points.tolist()
        self._points: list[list[float]] = positions if len(positions) > 1 else positions * 2
        self._lengths = [0.0]  # length of the path before each point [m]
        for start, end in zip(self._points, self._points[1:], strict=False):
            self._lengths.append(self._lengths[-1] + math.dist(start, end))

    @property
    def n_segments(self) -> int:
        """The number of segments, at least 1."""
        return len(self._points) - 1

    @property
    def length(self) -> float:
        """The length of the whole path [m]."""
        return self._lengths[-1]

    def find_nearest(self, segment: int, point: Array) -> tuple[float, float]:
        """Find the point of a segment, its ends included, that is nearest to ``point`` (3,) [m].

        Returns:
            The distance of the nearest point from ``point`` [m], and the length of the path from
            its start to the nearest point [m].
        """
        x1, y1, z1 = self._points[segment]
        x2, y2, z2 = self._points[segment + 1]
        px, py, pz = point.tolist()
        dx, dy, dz = x2 - x1, y2 - y1, z2 - z1
        square = dx * dx + dy * dy + dz * dz
        fraction = 0.0
        if square > 0.0:
            fraction = ((px - x1) * dx + (py - y1) * dy + (pz - z1) * dz) / square
            fraction = min(1.0, max(0.0, fraction))
        foot = (x1 + fraction * dx, y1 + fraction * dy, z1 + fraction * dz)
        begin, end = self._lengths[segment : segment + 2]
        return math.dist((px, py, pz), foot), begin + fraction * (end - begin)

    def follow(self, segment: int, point: Array) -> tuple[int, float, float]:
        """Find the nearest point of a segment, or of the next one if that is nearer.

        Returns:
            The segment of the nearest point, and the distance and the path's length as
            `find_nearest` returns them.
        """
        place = self.find_nearest(segment, point)
        if segment + 1 < self.n_segments:
            next_place = self.find_nearest(segment + 1, point)
            if next_place[0] < place[0]:
                return segment + 1, *next_place
        return segment, *place

    def position(self, path_length: float) -> Array:
        """Return the point at a length from the start, limited to the path's ends, (3,) [m]."""
        i = min(max(bisect.bisect_right(self._lengths, path_length) - 1, 0), self.n_segments - 1)
        begin, end = self._lengths[i : i + 2]
        fraction = (path_length - begin) / (end - begin) if end > begin else 0.0
        start, stop = np.array(self._points[i]), np.array(self._points[i + 1])
        point: Array = start + min(1.0, max(0.0, fraction)) * (stop - start)
        return point

    def direction(self, segment: int) -> Array:
        """Return the unit vector along a segment, (3,) [1]; 0 for a segment of length 0."""
        step = np.array(self._points[segment + 1]) - np.array(self._points[segment])
        unit_vector: Array = step / (length(step) or 1.0)
        return unit_vector


def round_corners(points: Array, radius: float, spacing: float) -> Array:
    r"""Return the points of a path whose corners are rounded by arcs, (m, 3) [m].

    With the angle :math:`\theta` by which the path turns at a corner, the arc of radius r begins
    and ends :math:`r \tan(\theta / 2)` from the corner. Where that is more than half of one of the
    two segments, the radius is as much smaller. A corner at which the path turns back stays.

    Args:
        points: the corners, without repetitions (n, 3) [m].
        radius: the radius of the arcs [m]; 0: the corners stay.
        spacing: the greatest length of arc between two points [m].
    """
    if radius <= 0.0:
        return points
    parts = [points[:1]]
    for start, corner, end in zip(points, points[1:], points[2:], strict=False):
        parts.append(_round_corner(start, corner, end, radius, spacing))
    return np.concatenate([*parts, points[-1:]]) if len(points) > 1 else points


def _round_corner(start: Array, corner: Array, end: Array, radius: float, spacing: float) -> Array:
    """Return the points of the arc at a corner, (n, 3) [m]; the corner alone if there is none."""
    sides = corner - start, end - corner
    side_lengths = length(sides[0]), length(sides[1])
    first_direction, last_direction = sides[0] / side_lengths[0], sides[1] / side_lengths[1]
    cosine = dot(first_direction, last_direction)
    sine = length(cross(first_direction, last_direction))
    turn = math.atan2(sine, cosine)
    if turn < MIN_TURN or math.pi - turn < MIN_TURN:
        return corner[None]
    tangent = min(radius * math.tan(turn / 2.0), min(side_lengths) / 2.0)
    arc_radius = tangent / math.tan(turn / 2.0)
    n = max(1, math.ceil(arc_radius * turn / spacing))
    angles = np.linspace(0.0, turn, n + 1)[:, None]
    normal = (last_direction - cosine * first_direction) / sine
    arc_start = corner - tangent * first_direction
    arc: Array = arc_start + arc_radius * (
        first_direction * np.sin(angles) + normal * (1.0 - np.cos(angles))
    )
    return arc
