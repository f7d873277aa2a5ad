"""A current that starts at a given time, from which its own time counts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..base.geometry import Array
from ..world import Flow
from .current import Current


class LateCurrent(Current):
    """Zero before ``began + delay``; then the current at ``offset`` plus the time since began.

    The time since ``began`` is rounded to nanoseconds, so that a level gives the same numbers
    whether it is run alone or late in a sweep.
    """

    def __init__(self, current: Flow, *, began: float, delay: float, offset: float = 0.0) -> None:
        self._current, self._began, self._delay = current, began, delay
        self._offset = offset

    @property
    def is_uniform(self) -> bool:
        """Whether the other one is."""
        return self._current.is_uniform

    @property
    def is_still(self) -> bool:
        """Whether the other one is."""
        return self._current.is_still

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        own = self._own_time(time)
        if own is None:
            return np.zeros((len(points), 3))
        return self._current.velocity(points, own, vehicles)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return its acceleration, in L, (n, 3) [m/s2]; the jump at its beginning is left out."""
        own = self._own_time(time)
        if own is None:
            return np.zeros((len(points), 3))
        return self._current.acceleration(points, own, vehicles)

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return velocity and acceleration."""
        own = self._own_time(time)
        if own is None:
            return np.zeros((len(points), 3)), np.zeros((len(points), 3))
        return self._current.motion(points, own, vehicles)

    def _own_time(self, time: float) -> float | None:
        """The time of the other one at a simulation time [s]; None before it starts."""
        elapsed = round(time - self._began, 9)
        return None if elapsed < self._delay else elapsed + self._offset
