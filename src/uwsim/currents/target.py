"""A current that acts on one vehicle alone, as in the original's benchmarks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..base.geometry import Array
from ..world import Flow
from .current import Current, is_steady


class TargetCurrent(Current):
    """A current for its target; still water for all other bodies."""

    def __init__(self, current: Flow, target: str) -> None:
        self._current, self._target = current, target

    @property
    def is_uniform(self) -> bool:
        """Whether the other one is."""
        return self._current.is_uniform

    @property
    def is_steady(self) -> bool:
        """Whether the other one is."""
        return is_steady(self._current)

    @property
    def is_still(self) -> bool:
        """Whether the other one is."""
        return self._current.is_still

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        return self._own(self._current.velocity(points, time, vehicles), vehicles)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration of the water, in L, (n, 3) [m/s2]."""
        return self._own(self._current.acceleration(points, time, vehicles), vehicles)

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return velocity and acceleration."""
        velocity, acceleration = self._current.motion(points, time, vehicles)
        return self._own(velocity, vehicles), self._own(acceleration, vehicles)

    def _own(self, vectors: Array, vehicles: Sequence[str]) -> Array:
        """Set to 0 what is not the target's, (n, 3)."""
        if not vehicles:
            return np.zeros_like(vectors)
        is_other = [name != self._target for name in vehicles]
        if any(is_other):
            vectors[is_other] = 0.0
        return vectors
