"""The plane of the sea floor below a vehicle, from the ranges of the four beams of a DVL."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import product, solve
from ...messages import DVL

BEAM_ANGLE = math.radians(30.0)
"""From the axis of a DVL to each beam [rad]."""
MEMORY = 20
"""Pings over which the plane is averaged."""
MAX_RESIDUAL = 0.05
"""Of four points from a plane, beyond which they lie on something else [m]."""

_TURNS = [math.radians(45.0 + 90.0 * k) for k in range(4)]
BEAMS: Array = np.array(
    [
        [
            math.sin(BEAM_ANGLE) * math.cos(turn),
            math.sin(BEAM_ANGLE) * math.sin(turn),
            math.cos(BEAM_ANGLE),
        ]
        for turn in _TURNS
    ]
)
"""Directions of the beams in a DVL with the axes of the base, (4, 3)."""


class BottomPlane:
    """Depth of the bottom as ``a + b north + c east``, averaged over some pings."""

    def __init__(self) -> None:
        self._plane: Array | None = None
        self._count = 0

    @property
    def is_known(self) -> bool:
        """Whether the bottom was seen."""
        return self._plane is not None

    @property
    def slopes(self) -> tuple[float, float]:
        """Growth of the depth to the north and to the east [1]."""
        if self._plane is None:
            return 0.0, 0.0
        return float(self._plane[1]), float(self._plane[2])

    def depth_at(self, place: Array) -> float:
        """Depth of the bottom [m] at a place (at least 2,): north and east [m]."""
        if self._plane is None:
            return math.nan
        a, b, c = self._plane.tolist()
        return float(a + b * place[0] + c * place[1])

    def put(self, depth: float) -> None:
        """Know that the bottom is level, at a depth [m]."""
        self._plane = np.array([depth, 0.0, 0.0])

    def take(self, ranges: Array, navigation_from_dvl: Pose) -> None:
        """Take the ranges along the beams (4,) [m] of a ping; NaN where nothing was heard."""
        if not np.isfinite(ranges).all():
            return
        points = navigation_from_dvl.transform(ranges[:, None] * BEAMS)
        terms = np.stack([np.ones(4), points[:, 0], points[:, 1]], axis=1)
        found = solve(product(terms.T, terms), product(terms.T, points[:, 2]))
        if np.abs(product(terms, found) - points[:, 2]).max() > MAX_RESIDUAL:
            return
        if self._plane is None:
            self._plane = found
        self._count = min(self._count + 1, MEMORY)
        self._plane = self._plane + (found - self._plane) / self._count


def ranges_of(message: DVL) -> Array:
    """Ranges along the four beams [m], the first numbers of ``raw_data``; NaN where unknown."""
    try:
        numbers = [float(word) for word in message.raw_data.split()[:4]]
    except ValueError:
        numbers = []
    return np.array(numbers) if len(numbers) == 4 else np.full(4, math.nan)
