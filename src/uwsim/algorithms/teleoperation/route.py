"""A route of straight legs, along which an operator drives."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot, length
from ...errors import BadSetting


class Route:
    """A route of straight legs; the progress along it never decreases.

    Args:
        points: the corners of the route, north and east in L, (n, 2) [m], at least two.
    """

    def __init__(self, points: Array) -> None:
        self._points = points
        self._leg = 0  # the index of the present leg
        self._progress = 0.0  # along the present leg [m]

    @classmethod
    def parse(cls, text: str) -> Route:
        """Return the route of a parameter: north and east of each corner [m].

        Raises:
            BadSetting: the text has no two corners.
        """
        try:
            points = np.array([float(word) for word in text.split()]).reshape(-1, 2)
        except ValueError:
            points = np.zeros((0, 2))
        if len(points) < 2:
            raise BadSetting(
                f"Parameter 'route' is {text!r}; expected two corners or more: "
                "north and east of each [m]."
            )
        return cls(points)

    @property
    def start(self) -> Array:
        """The first corner, (2,) [m]."""
        start: Array = self._points[0].copy()
        return start

    def advance(self, position: Array) -> None:
        """Move the progress on to the point of the route that is nearest to a position.

        Args:
            position: north and east, (2,) [m].
        """
        while True:
            direction, leg_length = self._describe_leg()
            distance_along = dot(position - self._points[self._leg], direction)
            self._progress = min(max(self._progress, distance_along), leg_length)
            if self._progress < leg_length or self._leg == len(self._points) - 2:
                return
            self._leg, self._progress = self._leg + 1, 0.0

    def point_ahead(self, distance: float) -> Array:
        """Return the point at a distance [m] ahead, not beyond the present leg, (2,) [m]."""
        direction, leg_length = self._describe_leg()
        point: Array = self._points[self._leg] + direction * min(
            self._progress + distance, leg_length
        )
        return point

    def _describe_leg(self) -> tuple[Array, float]:
        """Return the direction of the present leg, (2,), and its length [m]."""
        leg = self._points[self._leg + 1] - self._points[self._leg]
        leg_length = length(leg)
        return leg / leg_length, leg_length
