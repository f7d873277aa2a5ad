r"""``docking``: guidance along the axis of a dock.

It reads ``positionError`` e and ``heading`` of an observation and commands a twist. With the axis d
of the dock, the error has a part :math:`a = e \cdot d` along it and a part :math:`c = e - a d`
across. The vehicle turns its bow to the axis, removes c by proportional and integral action, and
moves along the axis by the share :math:`\sigma` that it is on it. Otherwise it holds the distance
:math:`a_1` before the dock:

.. math::

    u = K_p c + K_i \int c \, dt + d \left( \sigma K_p a + (1 - \sigma) K_p (a - a_1) \right), \quad
    \sigma = \max(0, 1 - |c| / w(a)), \quad w(a) = w_0 + \alpha \max(0, a - a_0)

with the half width :math:`w_0` of the lane inside the dock and the slope :math:`\alpha` of the
funnel before it. The speed along the axis is limited. The base is taken to be level.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.numerics import elementwise
from ..base.numerics.linear import length
from .control.observation_controller import ObservationController

FUNNEL_SLOPE, FUNNEL_START = 0.4, 1.0
"""The slope of the funnel [1], and the distance from the goal at which it begins [m]."""
WAITING_DISTANCE = 1.7
"""The distance from the goal at which the vehicle comes onto the axis [m]."""


class Docking(ObservationController):
    """A guidance into a dock: turns to its axis, comes onto it, and moves along it."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "axis": 0.0,
        "kp": 0.8,
        "ki": 0.1,
        "turn_gain": 0.8,
        "speed": 0.25,
        "width": 0.12,
        "limit": 0.5,
        **ObservationController.PARAMETERS,
    }
    """The heading of the dock's ``axis`` [rad], the gains ``kp`` [1/s], ``ki`` [1/s^2] and
    ``turn_gain`` [1/s], the ``speed`` along the axis [m/s], the half ``width`` of the lane in the
    dock [m], the speed ``limit`` of an axis [m/s], and the topic of the commands."""
    CHANNELS: ClassVar[tuple[str, ...]] = ("positionError", "heading")
    """The parts of the observation that are needed."""
    KIND: ClassVar[str] = "guidance"
    """The kind of the algorithm in messages."""

    def __init__(self) -> None:
        super().__init__()
        self._integral = np.zeros(3)  # [m s]

    def command(self, parts: Mapping[str, Array], dt: float) -> tuple[Array, float]:
        """Return the commanded velocity and the turn rate; see `ObservationController`."""
        bow_x, bow_y = parts["heading"].tolist()
        turn = self._number("axis") - float(elementwise.arctan2(bow_y, bow_x))
        turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi) + 0.5)
        return self._velocity(parts["positionError"], turn, dt), self._number("turn_gain") * turn

    def _velocity(self, error: Array, turn: float, dt: float) -> Array:
        """Return the commanded velocity in the axes of the vehicle, (3,) [m/s]."""
        kp, limit = self._number("kp"), self._number("limit")
        axis = np.array([math.cos(turn), math.sin(turn), 0.0])
        distance = float(np.sum(error * axis))
        cross_track = error - distance * axis
        if length(cross_track) < 2.0 * self._number("width"):
            self._integral = self._integral + cross_track * dt
        width = self._number("width") + FUNNEL_SLOPE * max(0.0, distance - FUNNEL_START)
        share = max(0.0, 1.0 - length(cross_track) / width)
        top_speed = self._number("speed")
        speed = kp * (share * distance + (1.0 - share) * (distance - WAITING_DISTANCE))
        speed = min(top_speed, max(-top_speed, speed))
        command = kp * cross_track + self._number("ki") * self._integral + speed * axis
        limited_command: Array = np.clip(command, -limit, limit)
        return limited_command
