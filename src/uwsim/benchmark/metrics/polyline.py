"""Polyline: a path of straight segments, and where along it a point is."""

from __future__ import annotations

import math

from ...base.geometry import Array


class Polyline:
    """Points joined by straight segments, counted from 0; a single point is one of length 0."""

    def __init__(self, points: Array) -> None:
        """Join ``points`` (n, 3) [m], n >= 1."""
        ends = points.tolist()
        self._points: list[list[float]] = ends if len(ends) > 1 else ends * 2
        self._before = [0.0]  # length of the path before each point [m]
        for first, second in zip(self._points, self._points[1:], strict=False):
            self._before.append(self._before[-1] + math.dist(first, second))

    @property
    def n_segments(self) -> int:
        """How many segments there are, at least 1."""
        return len(self._points) - 1

    @property
    def length(self) -> float:
        """Length of the whole path [m]."""
        return self._before[-1]

    def nearest(self, segment: int, point: Array) -> tuple[float, float]:
        """Look from ``point`` (3,) [m] to the nearest place on a segment, its ends included.

        Returns:
            How far that is, and the length of the path up to there [m].
        """
        ax, ay, az = self._points[segment]
        bx, by, bz = self._points[segment + 1]
        px, py, pz = point.tolist()
        dx, dy, dz = bx - ax, by - ay, bz - az
        square = dx * dx + dy * dy + dz * dz
        share = 0.0
        if square > 0.0:
            share = ((px - ax) * dx + (py - ay) * dy + (pz - az) * dz) / square
            share = min(1.0, max(0.0, share))
        foot = (ax + share * dx, ay + share * dy, az + share * dz)
        along = self._before[segment]
        return math.dist((px, py, pz), foot), along + share * (self._before[segment + 1] - along)
