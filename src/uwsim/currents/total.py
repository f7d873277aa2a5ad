"""The sum of several currents."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..base.geometry import Array
from ..world import Flow
from .current import Current, CurrentSpec, Place, is_steady


class TotalCurrent(Current):
    """The sum of several currents; of none, still water."""

    def __init__(self, currents: Sequence[Flow]) -> None:
        self._currents = tuple(current for current in currents if not current.is_still)

    @property
    def is_uniform(self) -> bool:
        """Whether all of them are the same everywhere."""
        return all(current.is_uniform for current in self._currents)

    @property
    def is_steady(self) -> bool:
        """Whether all of them are the same at all times."""
        return all(is_steady(current) for current in self._currents)

    @property
    def is_still(self) -> bool:
        """Whether all of them are."""
        return not self._currents

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        parts = [current.velocity(points, time, vehicles) for current in self._currents]
        return _sum(parts, len(points))

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration of the water, in L, (n, 3) [m/s2]."""
        parts = [current.acceleration(points, time, vehicles) for current in self._currents]
        return _sum(parts, len(points))


def _sum(parts: list[Array], n: int) -> Array:
    """Add up vectors at n points, (n, 3); what is handed in may be changed."""
    if not parts:
        return np.zeros((n, 3))
    for part in parts[1:]:
        parts[0] += part
    return parts[0]


def bind_currents(specs: Sequence[CurrentSpec], place: Place) -> TotalCurrent:
    """Bind the currents of a scene; number i has its own random streams, ``scene/i/...``."""
    return TotalCurrent([spec.bind(_own(place, i)) for i, spec in enumerate(specs)])


def _own(place: Place, i: int) -> Place:
    return replace(place, stream=lambda name: place.stream(f"scene/{i}/{name}"))
