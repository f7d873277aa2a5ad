r"""Station keeping: from where the vehicle is and should be to a twist through the water.

The law is proportional and integral on the error of position e, in the vehicle's axes,

.. math:: u = K_p e + K_i \int e \, dt - \hat c

and the current :math:`\hat c` is fed forward. It is estimated from what is commanded and what the
navigation sees: a vehicle that is told u goes at :math:`u_f` (u after its lag) through the water
and at v over ground, so that

.. math:: \hat c' = (v - u_f - \hat c) / T

`P` has neither integral nor feed-forward: a steady current c leaves the offset
:math:`c / K_p`. Corrections are limited to `limit`, the integral stands still there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length, rotate_back

LAG = 0.5
"""Of the velocity of the vehicle behind the command [s]."""
MEMORY = 3.0
"""Time constant of the estimate of the current [s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """Where the vehicle is, and where it should be."""

    error: Array
    """Goal minus position, navigation axes, (3,) [m]."""
    turn: float
    """Heading wanted minus heading, between -pi and pi [rad]."""
    velocity: Array
    """Over ground, navigation axes, (3,) [m/s]."""
    rotation: Array
    """Axes of the base in the navigation frame, (3, 3)."""
    wanted: Array
    """Velocity of the goal, navigation axes, (3,) [m/s]."""


class StationLaw(Protocol):
    """Keeps a station; one of your own goes to `Grasp.controller`."""

    current: Array
    """What it knows of the current, navigation axes, (3,) [m/s]; zero if nothing."""

    def step(self, motion: Motion, dt: float) -> tuple[Array, float]:
        """Return velocity through the water (3,) [m/s] and yaw rate [rad/s], base axes.

        ``dt`` is the time since the last call [s].
        """


class Station:
    """Proportional and integral law with the current fed forward."""

    def __init__(
        self, *, kp: float, ki: float, feeds_forward: bool, limit: float, turn_gain: float = 0.6
    ) -> None:
        """Set the gains.

        Args:
            kp: proportional gain [1/s].
            ki: integral gain [1/s2].
            feeds_forward: whether the current is estimated and compensated.
            limit: largest correction [m/s].
            turn_gain: of the heading [1/s].
        """
        self._kp, self._ki, self._limit, self._turn_gain = kp, ki, limit, turn_gain
        self._feeds_forward = feeds_forward
        self._integral = np.zeros(3)
        self._lagged = np.zeros(3)
        self._command = np.zeros(3)
        self.current = np.zeros(3)
        """Estimate of the current, navigation axes, (3,) [m/s]."""

    def step(self, motion: Motion, dt: float) -> tuple[Array, float]:
        """Return velocity through the water (3,) [m/s] and yaw rate [rad/s], base axes."""
        self._estimate(motion.velocity, dt)
        integral = self._integral + motion.error * dt
        correction = self._kp * motion.error + self._ki * integral
        size = length(correction)
        if size > self._limit:
            correction = correction * (self._limit / size)
        else:
            self._integral = integral
        command = correction + motion.wanted - self.current
        self._command = command
        level = rotate_back(motion.rotation, command)
        return level, float(np.clip(self._turn_gain * motion.turn, -0.3, 0.3))

    def _estimate(self, velocity: Array, dt: float) -> None:
        self._lagged = self._lagged + (1.0 - math.exp(-dt / LAG)) * (self._command - self._lagged)
        if not self._feeds_forward:
            return
        share = 1.0 - math.exp(-dt / MEMORY)
        self.current = self.current + share * (velocity - self._lagged - self.current)
        self.current[2] = 0.0


def horizontal(vector: Array) -> float:
    """Length of a vector without its z [m]."""
    return math.hypot(float(vector[0]), float(vector[1]))
