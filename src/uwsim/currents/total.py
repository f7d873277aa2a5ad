"""Several currents at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..world import Flow
from .current import Array, Current, CurrentSpec, Place


class TotalCurrent(Current):
    """The sum of several currents; of none, still water."""

    def __init__(self, currents: Sequence[Flow]) -> None:
        self._currents = tuple(currents)

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        total = np.zeros((len(points), 3))
        for current in self._currents:
            total += current.velocity(points, time, vehicles)
        return total

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration of the water, in L, (n, 3) [m/s2]."""
        total = np.zeros((len(points), 3))
        for current in self._currents:
            total += current.acceleration(points, time, vehicles)
        return total


def bind_currents(specs: Sequence[CurrentSpec], place: Place) -> TotalCurrent:
    """Bind the currents of a scene; number i has its own random streams, ``scene/i/...``."""
    return TotalCurrent([spec.bind(_own(place, i)) for i, spec in enumerate(specs)])


def _own(place: Place, i: int) -> Place:
    return replace(place, stream=lambda name: place.stream(f"scene/{i}/{name}"))
