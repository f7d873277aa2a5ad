r"""Line-of-sight guidance along a line, for a vehicle that can move in all directions.

With the vector e from the vehicle to the nearest point of the line, its part c across the line, and
the unit vector t along it, the horizontal velocity through the water is

.. math:: u = U\, \frac{\Delta\, t + c}{\lVert \Delta\, t + c \rVert} + K_i \int c\, dt

with the speed U and the look-ahead distance :math:`\Delta` (Fossen 2021, *Handbook of Marine
Craft*, section 12.3). The integral opposes a current. The bow turns to a point of the line ahead,
at a rate that is proportional to its bearing. The vertical velocity is :math:`K_z e_z`. The axes
are those of the base, which is taken to be level.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics import elementwise
from ...base.numerics.linear import dot, length


@dataclass(frozen=True, kw_only=True)
class GuidanceGains:
    """The numbers of the guidance."""

    speed: float
    """The speed U along the line [m/s]."""
    look_ahead: float
    r"""The look-ahead distance :math:`\Delta` [m]."""
    ki: float
    """The gain of the integral [1/s^2]."""
    kz: float
    """The gain of the vertical error [1/s]."""
    turn_gain: float
    """The gain of the bearing [1/s]."""
    limit: float
    """The greatest speed of an axis, and of the integral's part [m/s]."""


class LineGuidance:
    """A guidance law with the integral of the error across the line."""

    def __init__(self, gains: GuidanceGains) -> None:
        self._gains = gains
        self._integral = 0.0  # of the error to starboard of the line [m s]

    def command(
        self, error: Array, direction: Array, target: Array, dt: float
    ) -> tuple[Array, float]:
        """Compute the velocity (3,) [m/s] and the turn rate [rad/s].

        Args:
            error: the nearest point of the line, in base axes (3,) [m].
            direction: the direction of the line, in base axes (3,) [1].
            target: a point of the line ahead, in base axes (3,) [m].
            dt: the time since the last call [s].
        """
        gains = self._gains
        level = np.array([direction[0], direction[1], 0.0])
        level = level / (length(level) or 1.0)
        starboard = np.array([-level[1], level[0], 0.0])
        cross_track = dot(error, starboard)
        bound = gains.limit / gains.ki if gains.ki > 0.0 else 0.0
        self._integral = min(bound, max(-bound, self._integral + cross_track * dt))
        aim = gains.look_ahead * level + cross_track * starboard
        velocity = gains.speed * aim / length(aim) + gains.ki * self._integral * starboard
        velocity[2] = gains.kz * error[2]
        bearing = float(elementwise.arctan2(float(target[1]), float(target[0])))
        return np.clip(velocity, -gains.limit, gains.limit), gains.turn_gain * bearing
