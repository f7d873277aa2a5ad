r"""Station keeping: the control law from the error of position to a twist in the water.

The law is proportional and integral on the error of position e, in the vehicle's axes,

.. math:: u = K_p e + K_i \int e \, dt - \hat c

with the current :math:`\hat c` as feedforward. It is estimated from the command and the navigation:
a vehicle with the command u moves at :math:`u_f` (u after a lag) through the water and at v over
ground, so that

.. math:: \hat c' = (v - u_f - \hat c) / T

Without integral and feedforward, a steady current c leaves the offset :math:`c / K_p`. The
correction is limited to `limit`; the integral is constant there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length, rotate_back

LAG = 0.5
"""The time constant of the vehicle's velocity after a command [s]."""
CURRENT_TIME_CONSTANT = 3.0
"""The time constant of the estimate of the current [s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """The motion of a vehicle relative to its goal."""

    error: Array
    """The goal minus the position, navigation axes, (3,) [m]."""
    heading_error: float
    """The goal heading minus the heading, between -pi and pi [rad]."""
    velocity: Array
    """The velocity over ground, navigation axes, (3,) [m/s]."""
    rotation: Array
    """The axes of the base in the navigation frame, (3, 3)."""
    goal_velocity: Array
    """The velocity of the goal, navigation axes, (3,) [m/s]."""


class StationLaw(Protocol):
    """A law of station keeping; see `Grasp.controller`."""

    current: Array
    """The estimate of the current, navigation axes, (3,) [m/s]; zero without one."""

    def step(self, motion: Motion, dt: float) -> tuple[Array, float]:
        """Compute the velocity in the water (3,) [m/s] and the yaw rate [rad/s], base axes.

        ``dt`` is the time since the last call [s].
        """


class Station:
    """A proportional-integral law with the current as feedforward."""

    def __init__(
        self, *, kp: float, ki: float, feeds_forward: bool, limit: float, turn_gain: float = 0.6
    ) -> None:
        """Set the gains.

        Args:
            kp: the proportional gain [1/s].
            ki: the integral gain [1/s2].
            feeds_forward: True to estimate and compensate the current.
            limit: the largest correction [m/s].
            turn_gain: the gain of the heading [1/s].
        """
        self._kp, self._ki, self._limit, self._turn_gain = kp, ki, limit, turn_gain
        self._feeds_forward = feeds_forward
        self._integral = np.zeros(3)
        self._response = np.zeros(3)
        self._command = np.zeros(3)
        self.current = np.zeros(3)
        """The estimate of the current, navigation axes, (3,) [m/s]."""

    def step(self, motion: Motion, dt: float) -> tuple[Array, float]:
        """Compute the velocity in the water (3,) [m/s] and the yaw rate [rad/s], base axes."""
        self._estimate(motion.velocity, dt)
        integral = self._integral + motion.error * dt
        correction = self._kp * motion.error + self._ki * integral
        speed = length(correction)
        if speed > self._limit:
            correction = correction * (self._limit / speed)
        else:
            self._integral = integral
        command = correction + motion.goal_velocity - self.current
        self._command = command
        body_velocity = rotate_back(motion.rotation, command)
        return body_velocity, float(np.clip(self._turn_gain * motion.heading_error, -0.3, 0.3))

    def _estimate(self, velocity: Array, dt: float) -> None:
        share = 1.0 - math.exp(-dt / LAG)
        self._response = self._response + share * (self._command - self._response)
        if not self._feeds_forward:
            return
        share = 1.0 - math.exp(-dt / CURRENT_TIME_CONSTANT)
        self.current = self.current + share * (velocity - self._response - self.current)
        self.current[2] = 0.0


def horizontal_length(vector: Array) -> float:
    """Return the length of the horizontal part of a vector [m]."""
    return math.hypot(float(vector[0]), float(vector[1]))
