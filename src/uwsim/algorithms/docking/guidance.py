r"""The law of guidance along the axis of a dock, for a vehicle that can move in all directions.

With the axis d of the dock, the vector e to the place in the dock has a part :math:`a = e \cdot d`
along it and a part :math:`c = e - a d` across. The vehicle turns its bow to the axis, removes c by
proportional and integral action, and moves along the axis by the share :math:`\sigma` that it is on
it. Otherwise it holds the distance :math:`a_1` before the dock:

.. math::

    u = K_p c + K_i \int c \, dt + d \left( \sigma K_p a + (1 - \sigma) K_p (a - a_1) \right), \quad
    \sigma = \max(0, 1 - |c| / w(a)), \quad w(a) = w_0 + \alpha \max(0, a - a_0)

with the half width :math:`w_0` of the lane inside the dock and the slope :math:`\alpha` of the
funnel before it. The speed along the axis is limited. The base is taken to be level.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length

GAINS: Mapping[str, float | str] = {
    "kp": 0.8,
    "ki": 0.1,
    "turn_gain": 0.8,
    "speed": 0.25,
    "width": 0.12,
    "funnel_slope": 0.4,
    "funnel_start": 1.0,
    "waiting_distance": 1.7,
    "limit": 0.5,
}
"""The numbers of `DockingGains` for a BlueROV2 in the dock of `docking`."""
GIRONA_GAINS: Mapping[str, float | str] = {
    **GAINS,
    "funnel_slope": 0.21,
    "funnel_start": 1.3,
    "waiting_distance": 2.4,
}
"""The numbers of `DockingGains` for a Girona 500 in the dock of `docking-girona`."""


@dataclass(frozen=True, kw_only=True)
class DockingGains:
    """The numbers of the guidance."""

    kp: float
    """The proportional gain [1/s]."""
    ki: float
    """The integral gain [1/s^2]."""
    turn_gain: float
    """The gain of the heading [1/s]."""
    speed: float
    """The greatest speed along the axis [m/s]."""
    width: float
    """The half width of the lane in the dock [m]."""
    funnel_slope: float
    """The slope of the funnel's walls [1]."""
    funnel_start: float
    """The distance from the place in the dock at which the funnel begins for the bow [m]."""
    waiting_distance: float
    """The distance from that place at which the vehicle comes onto the axis [m]."""
    limit: float
    """The greatest speed of an axis [m/s]."""


class DockingGuidance:
    """The guidance, with its integral of the error across the axis."""

    def __init__(self, gains: DockingGains) -> None:
        self._gains = gains
        self._integral = np.zeros(3)  # [m s]

    def command(self, error: Array, turn: float, dt: float) -> tuple[Array, float]:
        """Compute the velocity (3,) [m/s] and the turn rate [rad/s], in base axes.

        Args:
            error: the vector to the place in the dock, in base axes (3,) [m].
            turn: the angle from the bow to the axis of the dock [rad].
            dt: the time since the last call [s].
        """
        turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi) + 0.5)
        return self._velocity(error, turn, dt), self._gains.turn_gain * turn

    def _velocity(self, error: Array, turn: float, dt: float) -> Array:
        gains = self._gains
        axis = np.array([math.cos(turn), math.sin(turn), 0.0])
        distance = float(np.sum(error * axis))
        cross_track = error - distance * axis
        if length(cross_track) < 2.0 * gains.width:
            self._integral = self._integral + cross_track * dt
        width = gains.width + gains.funnel_slope * max(0.0, distance - gains.funnel_start)
        share = max(0.0, 1.0 - length(cross_track) / width)
        speed = gains.kp * (share * distance + (1.0 - share) * (distance - gains.waiting_distance))
        speed = min(gains.speed, max(-gains.speed, speed))
        command = gains.kp * cross_track + gains.ki * self._integral + speed * axis
        limited_command: Array = np.clip(command, -gains.limit, gains.limit)
        return limited_command
