"""Estimation of the plane of the seabed below a vehicle from the four beams of a DVL.

Positions are in the navigation frame (north, east, down), whose origin is at the water surface.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import product, solve
from ...messages import DVL

BEAM_ANGLE = math.radians(30.0)
"""The angle from the axis of a DVL to each beam [rad]."""
N_AVERAGED_PINGS = 20
"""The number of pings over which the plane is averaged."""
MAX_RESIDUAL = 0.05
"""The largest vertical distance of the end of a beam from the plane of an accepted ping [m]."""

_BEAM_AZIMUTHS = [math.radians(45.0 + 90.0 * k) for k in range(4)]
"""The directions of the beams about the axis of the DVL, from x towards y [rad]."""
BEAMS: Array = np.array(
    [
        [
            math.sin(BEAM_ANGLE) * math.cos(azimuth),
            math.sin(BEAM_ANGLE) * math.sin(azimuth),
            math.cos(BEAM_ANGLE),
        ]
        for azimuth in _BEAM_AZIMUTHS
    ]
)
"""The unit vectors of the beams in the frame of the DVL, (4, 3); its axes are parallel to those of
the base."""


class BottomPlane:
    """The depth of the seabed as ``a + b north + c east``, averaged over several pings."""

    def __init__(self) -> None:
        self._plane: Array | None = None  # a [m], b [1], c [1], (3,)
        self._n_pings = 0  # the number of pings in the average

    @property
    def is_known(self) -> bool:
        """True if the depth of the seabed is known."""
        return self._plane is not None

    @property
    def slopes(self) -> tuple[float, float]:
        """The slopes of the depth to the north and to the east [1]."""
        if self._plane is None:
            return 0.0, 0.0
        return float(self._plane[1]), float(self._plane[2])

    def depth_at(self, position: Array) -> float:
        """Return the depth of the seabed [m] at a position; NaN if it is not known.

        ``position`` begins with the north and east coordinates [m].
        """
        if self._plane is None:
            return math.nan
        a, b, c = self._plane.tolist()
        return float(a + b * position[0] + c * position[1])

    def set_depth(self, depth: float) -> None:
        """Set the plane to a level seabed at a depth [m]."""
        self._plane = np.array([depth, 0.0, 0.0])

    def update(self, ranges: Array, navigation_from_dvl: Pose) -> None:
        """Add the plane through the points of a ping to the average, if it is flat.

        Args:
            ranges: the ranges along the beams, (4,) [m]; NaN for a beam without an echo.
            navigation_from_dvl: the pose of the DVL in the navigation frame.
        """
        if not np.isfinite(ranges).all():
            return
        points = navigation_from_dvl.transform(ranges[:, None] * BEAMS)
        terms = np.stack([np.ones(4), points[:, 0], points[:, 1]], axis=1)
        plane = solve(product(terms.T, terms), product(terms.T, points[:, 2]))
        if np.abs(product(terms, plane) - points[:, 2]).max() > MAX_RESIDUAL:
            return
        if self._plane is None:
            self._plane = plane
        self._n_pings = min(self._n_pings + 1, N_AVERAGED_PINGS)
        self._plane = self._plane + (plane - self._plane) / self._n_pings


def parse_ranges(message: DVL) -> Array:
    """Return the ranges of the four beams, the first numbers in ``raw_data``, (4,) [m]; or NaN."""
    try:
        numbers = [float(word) for word in message.raw_data.split()[:4]]
    except ValueError:
        numbers = []
    return np.array(numbers) if len(numbers) == 4 else np.full(4, math.nan)
