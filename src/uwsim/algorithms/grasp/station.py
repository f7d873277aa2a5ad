r"""Station keeping: a control law that computes a twist from the position and heading errors.

The commanded velocity through the water is proportional and integral in the position error e,

.. math:: u = K_p e + K_i \int e \, dt + v_g - \hat c

with the velocity of the goal :math:`v_g` and the estimated water current :math:`\hat c` as
feedforward. The vertical component of :math:`\hat c` is zero. A vehicle with the command u moves
at the velocity :math:`u_f` through the water, which is u after a first-order lag, and at v over
ground, which the navigation estimates. Therefore, with the time constant T,

.. math:: \hat c' = (v - u_f - \hat c) / T

Without integral and feedforward, a steady current c leaves the offset :math:`c / K_p`. The length
of the sum of the first two terms is limited; at the limit, the integral is held constant. The yaw
rate is proportional to the heading error, and limited to `MAX_YAW_RATE`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length, rotate_back

LAG = 0.5
"""The time constant of the vehicle's velocity in response to a command [s]."""
CURRENT_TIME_CONSTANT = 3.0
"""The time constant T of the estimate of the current [s]."""
MAX_YAW_RATE = 0.3
"""The largest commanded yaw rate [rad/s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TrackingState:
    """The errors and velocities of a vehicle that tracks its goal."""

    error: Array
    """The goal minus the position of the base, navigation axes, (3,) [m]."""
    heading_error: float
    """The goal heading minus the heading, between -pi and pi [rad]."""
    velocity: Array
    """The velocity of the base over ground, navigation axes, (3,) [m/s]."""
    rotation: Array
    """The rotation ``navigation_from_base``, (3, 3)."""
    goal_velocity: Array
    """The velocity of the goal, navigation axes, (3,) [m/s]."""


class StationLaw(Protocol):
    """A law of station keeping; see `Grasp.controller`."""

    current: Array
    """The estimate of the water current, navigation axes, (3,) [m/s]; zero if not estimated."""

    def step(self, state: TrackingState, dt: float) -> tuple[Array, float]:
        """Compute the command.

        Args:
            state: the errors and velocities of the vehicle relative to its goal.
            dt: the time since the last call [s].

        Returns:
            The velocity through the water, base axes, (3,) [m/s], and the yaw rate [rad/s].
        """


class StationController:
    """A proportional-integral control law with the water current as feedforward."""

    def __init__(
        self, *, kp: float, ki: float, feeds_forward: bool, limit: float, turn_gain: float = 0.6
    ) -> None:
        """Set the gains.

        Args:
            kp: the proportional gain [1/s].
            ki: the integral gain [1/s2].
            feeds_forward: True to estimate and compensate the current.
            limit: the largest speed due to the proportional and the integral term [m/s].
            turn_gain: the gain from the heading error to the yaw rate [1/s].
        """
        self._kp, self._ki, self._limit, self._turn_gain = kp, ki, limit, turn_gain
        self._feeds_forward = feeds_forward
        self._integral = np.zeros(3)  # of the error, navigation axes [m s]
        self._water_velocity = np.zeros(3)  # through the water, after the lag [m/s]
        self._command = np.zeros(3)  # commanded velocity, navigation axes [m/s]
        self.current = np.zeros(3)
        """The estimate of the water current, navigation axes, (3,) [m/s]."""

    def step(self, state: TrackingState, dt: float) -> tuple[Array, float]:
        """Compute the command; see `StationLaw`."""
        self._estimate(state.velocity, dt)
        integral = self._integral + state.error * dt
        correction = self._kp * state.error + self._ki * integral
        speed = length(correction)
        if speed > self._limit:
            correction = correction * (self._limit / speed)
        else:
            self._integral = integral
        command = correction + state.goal_velocity - self.current
        self._command = command
        body_velocity = rotate_back(state.rotation, command)
        yaw_rate = self._turn_gain * state.heading_error
        return body_velocity, float(np.clip(yaw_rate, -MAX_YAW_RATE, MAX_YAW_RATE))

    def _estimate(self, velocity: Array, dt: float) -> None:
        """Update the estimate of the current from the velocity over ground (3,) [m/s]."""
        gain = 1.0 - math.exp(-dt / LAG)
        self._water_velocity = self._water_velocity + gain * (self._command - self._water_velocity)
        if not self._feeds_forward:
            return
        gain = 1.0 - math.exp(-dt / CURRENT_TIME_CONSTANT)
        self.current = self.current + gain * (velocity - self._water_velocity - self.current)
        self.current[2] = 0.0


def horizontal_length(vector: Array) -> float:
    """Return the length of the horizontal part of a vector [m]."""
    return math.hypot(float(vector[0]), float(vector[1]))
