r"""The motion that an operator expects of a vehicle over a link with a delay.

The vehicle takes the commanded velocity u through the water after a first-order lag T, and drifts
with the current c. With the delay d in each direction, a command sent at t has an effect at t + d.
The displacement M of the commands is therefore integrated over the time at which they are sent:

.. math:: \dot{M} = w, \qquad \dot{w} = (u - w) / T .

A report of the time s shows the velocity v and the position p. A command that is sent now, at t,
has its effect at t + d. Until then the vehicle is at

.. math:: \hat p(t + d) = p + M(t) - M(s - d) + \hat c \, (t + d - s),

which is a Smith predictor. The current is estimated from :math:`\hat c' = (v - w(s - d) - \hat c)
/ T_c`. Not modelled: waves, the tether, and losses of commands.
"""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from ...base.geometry import Array

CURRENT_TIME_CONSTANT = 3.0
"""The time constant of the estimate of the current [s]."""
MEMORY = 60.0
"""The time for which sent commands are remembered [s]."""


class MotionModel:
    """The motion that follows from the commands sent so far.

    Args:
        lag: the time constant of the vehicle's velocity in response to a command [s].
    """

    def __init__(self, lag: float) -> None:
        self._lag = lag
        self._velocity, self._displacement = np.zeros(3), np.zeros(3)
        self._history: deque[tuple[float, Array, Array]] = deque()
        self.current = np.zeros(3)
        """The estimate of the current, navigation axes, (3,) [m/s]; its down component is 0."""

    def add_command(self, time: float, velocity: Array, dt: float) -> None:
        """Add a command that is sent at ``time`` [s] and holds for ``dt`` [s].

        Args:
            time: the time at which it is sent [s].
            velocity: the velocity through the water, navigation axes, (3,) [m/s].
            dt: the time until the next command [s].
        """
        change = (1.0 - math.exp(-dt / self._lag)) * (velocity - self._velocity)
        self._velocity = self._velocity + change
        self._displacement = self._displacement + self._velocity * dt
        self._history.append((time + dt, self._velocity, self._displacement))
        while self._history[0][0] < time - MEMORY:
            self._history.popleft()

    def update_current(self, velocity: Array, sent_time: float, dt: float) -> None:
        """Correct the estimate of the current by a reported velocity over ground.

        Args:
            velocity: the velocity over ground, navigation axes, (3,) [m/s].
            sent_time: the time at which the commands were sent that then had their effect [s].
            dt: the time since the last correction [s].
        """
        error = velocity - self._find(sent_time)[0] - self.current
        self.current = self.current + (1.0 - math.exp(-dt / CURRENT_TIME_CONSTANT)) * error
        self.current[2] = 0.0

    def displacement_since(self, sent_time: float, duration: float) -> Array:
        """Return the displacement by all commands sent since a time, and by the current.

        Args:
            sent_time: the time [s].
            duration: the time for which the current acts [s].

        Returns:
            The displacement over ground, navigation axes, (3,) [m].
        """
        displacement: Array = self._displacement - self._find(sent_time)[1]
        return displacement + self.current * duration

    def _find(self, time: float) -> tuple[Array, Array]:
        """Return the velocity [m/s] and the displacement [m] of the model at a time, (3,) each."""
        for entry_time, velocity, displacement in reversed(self._history):
            if entry_time <= time + 1e-9:
                return velocity, displacement
        return np.zeros(3), np.zeros(3)
