"""Polyline: a path of straight segments, and the point of a segment nearest to a given point."""

from __future__ import annotations

import math

from ...base.geometry import Array


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
