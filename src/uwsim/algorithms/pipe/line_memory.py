"""The memory of a line that is out of sight: it moves past the vehicle as the vehicle moves."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from .line_detector import DetectedLine

MIN_FORWARD = 0.2
"""The smallest forward part of a unit vector along a line that is ahead [1]."""


class LineMemory:
    """A straight line in the ground, which is carried along by the measured motion of the vehicle.

    Not modelled: the curvature of the line, roll and pitch.

    Args:
        place: the place of the camera forward of the base [m].
    """

    def __init__(self, place: float) -> None:
        self._place = place
        self._point: Array | None = None  # a point of the line, base axes, forward, starboard [m]
        self._direction = np.array([1.0, 0.0])  # a unit vector along the line
        self.distance = 0.0
        """The distance travelled since the line was seen [m]."""

    def see(self, line: DetectedLine) -> None:
        """Replace the line by one that is seen."""
        norm = math.sqrt(1.0 + line.slope * line.slope)
        self._point = np.array([self._place, line.offset])
        self._direction = np.array([1.0, line.slope]) / norm
        self.distance = 0.0

    def move(self, velocity: tuple[float, float], turn_rate: float, dt: float) -> None:
        """Move the vehicle for a time.

        Args:
            velocity: the velocity over ground, forward and to starboard [m/s].
            turn_rate: the rate of turn to starboard [rad/s].
            dt: the time [s].
        """
        if self._point is None:
            return
        x, y = self._point[0] - velocity[0] * dt, self._point[1] - velocity[1] * dt
        cos, sin = math.cos(turn_rate * dt), math.sin(turn_rate * dt)
        u, v = self._direction.tolist()
        self._point = np.array([cos * x + sin * y, cos * y - sin * x])
        self._direction = np.array([cos * u + sin * v, cos * v - sin * u])
        self.distance += math.hypot(*velocity) * dt

    @property
    def line(self) -> DetectedLine | None:
        """The line as the camera would see it; None before it was seen, and if it lies abeam."""
        if self._point is None or self._direction[0] < MIN_FORWARD:
            return None
        slope = float(self._direction[1] / self._direction[0])
        offset = float(self._point[1] + slope * (self._place - self._point[0]))
        return DetectedLine(offset, slope, 0.0)
