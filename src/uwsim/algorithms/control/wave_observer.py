r"""An observer of the water's velocity in waves: a Kalman filter with an oscillator.

The water moves with a slowly varying current c and a wave velocity x, a damped oscillator that
white noise drives (Fossen 2021, *Handbook of Marine Craft*, section 10.2.2):

.. math:: \dot c = w_c, \qquad \ddot x + 2 \lambda \omega_0 \dot x + \omega_0^2 x = w_x, \qquad
    y = c + x + v

with the angular frequency of the peak :math:`\omega_0`, the relative damping :math:`\lambda` of the
spectrum's width, and the measured velocity y. Horizontal axes are independent. Not modelled: the
peak of a spectrum that changes, and several wave systems.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import product

WAVE_STD = 0.1
"""The standard deviation of the wave velocity for which the filter is designed [m/s]."""
NOISE_STD = 0.02
"""The standard deviation of the noise of a measured velocity [m/s]."""
CURRENT_DRIFT = 0.005
"""The standard deviation of the change of the current in a second [m/s]."""
CURRENT_STD = 0.3
"""The standard deviation of the current at the start [m/s]."""
N_TERMS = 12
"""The number of terms of the series of a matrix exponential; its times are short."""


class WaveObserver:
    """An observer of a current and a wave velocity along two axes.

    Args:
        period: the period of the spectrum's peak [s].
        damping: the relative damping of the oscillator [1].
    """

    def __init__(self, *, period: float, damping: float) -> None:
        omega = 2.0 * math.pi / period
        self._rate = np.array(
            [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -(omega**2), -2.0 * damping * omega]]
        )
        drive = 4.0 * damping * omega**3 * WAVE_STD**2  # of the noise w_x [m2/s5]
        self._noise_density = np.diag([CURRENT_DRIFT**2, 0.0, drive])
        self._covariance = np.diag([CURRENT_STD**2, WAVE_STD**2, (omega * WAVE_STD) ** 2])
        self._state = np.zeros((3, 2))  # current, wave velocity [m/s], its rate [m/s2]; by axis
        self._time: float | None = None

    def update(self, velocity: Array, time: float) -> None:
        """Correct the estimate with a measured velocity of the water, (2,) [m/s]."""
        dt = 0.0 if self._time is None else time - self._time
        self._time = time
        transition = self._transition(dt)
        self._state = product(transition, self._state)
        self._covariance = product(product(transition, self._covariance), transition.T)
        self._covariance += self._noise_density * dt
        column = self._covariance[:, 0] + self._covariance[:, 1]  # of state and measurement
        gain = column / (column[0] + column[1] + NOISE_STD**2)
        innovation = velocity - self._state[0] - self._state[1]
        self._state = self._state + gain[:, None] * innovation
        self._covariance = self._covariance - gain[:, None] * column

    def predict(self, time: float) -> Array:
        """Return the velocity of the water at a time after the last measurement, (2,) [m/s]."""
        dt = 0.0 if self._time is None else time - self._time
        state = product(self._transition(dt), self._state)
        velocity: Array = state[0] + state[1]
        return velocity

    def _transition(self, dt: float) -> Array:
        """Return the matrix exponential of the rate times dt, (3, 3)."""
        term = total = np.eye(3)
        for i in range(1, N_TERMS + 1):
            term = product(term, self._rate) * (dt / i)
            total = total + term
        return total
