r"""``position-lqr``: a linear-quadratic regulator of position with integral and feed-forward.

It reads ``positionError`` e, ``linearVelocity`` v and, if the environment has it,
``referenceVelocity`` r of an observation, and commands a velocity through the water. On each axis
of the vehicle, the model is the vehicle's velocity loop, a lag of time constant T:

.. math::

    \dot s = e, \qquad \dot e = r - v, \qquad \dot v = (u - v) / T

and, with the deviations :math:`\tilde v = v - r` and :math:`\tilde u = u - r - T \dot r`, the gains
minimise

.. math:: \sum_k \left( q_s s_k^2 + e_k^2 + r_u \tilde u_k^2 \right)

for steps of the period of the observations. They are those of the discrete Riccati equation (Astrom
and Wittenmark, Computer-Controlled Systems, 1997, chapter 11), found by iteration. The integral s
of an axis is held while its command is at the limit. Not modelled: the coupling of the axes, the
turning of the vehicle, and the current, which the integral removes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting
from .control.observation_controller import ObservationController

N_ITERATIONS = 4000
"""The number of iterations of the Riccati equation."""


class PositionLQR(ObservationController):
    """A linear-quadratic regulator of position: integral, feed-forward, gains from a model."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "lag": 0.25,
        "integral_weight": 0.3,
        "input_weight": 0.2,
        "limit": 0.6,
        **ObservationController.PARAMETERS,
    }
    """The time constant ``lag`` of the velocity loops [s], the weights of integral [1/s^2] and
    input [s^2], the speed ``limit`` of an axis [m/s], and the topic of the commands."""
    CHANNELS: ClassVar[tuple[str, ...]] = ("positionError", "linearVelocity")
    """The parts of the observation that are needed."""

    def __init__(self) -> None:
        super().__init__()
        self._integral = np.zeros(3)  # [m s]
        self._reference: Array | None = None  # the last reference velocity (3,) [m/s]
        self._gains: tuple[float, float, float] | None = None

    @staticmethod
    def check_parameters(parameters: Mapping[str, float | str]) -> None:
        """Raise BadSetting for a lag or weight that is not positive."""
        for name in ("lag", "integral_weight", "input_weight", "limit"):
            if name in parameters and not float(parameters[name]) > 0.0:
                raise BadSetting(f"algorithm.{name} is {parameters[name]}; expected more than 0.")

    def command(self, parts: Mapping[str, Array], dt: float) -> tuple[Array, float]:
        """Return the commanded velocity and no turn rate; see `ObservationController`."""
        reference = parts.get("referenceVelocity", np.zeros(3))
        velocity = self._velocity(parts["positionError"], parts["linearVelocity"], reference, dt)
        return velocity, 0.0

    def _velocity(self, error: Array, velocity: Array, reference: Array, dt: float) -> Array:
        """Return the commanded velocity in the axes of the vehicle, (3,) [m/s]."""
        lag, limit = self._number("lag"), self._number("limit")
        feedforward = reference
        if dt > 0.0 and self._reference is not None:
            if self._gains is None:
                weights = [self._number(f"{name}_weight") for name in WEIGHTS]
                self._gains = compute_gains(lag, dt, *weights)
            feedforward = reference + lag * (reference - self._reference) / dt
        self._reference = reference
        if self._gains is None:
            return np.clip(feedforward, -limit, limit)
        k_integral, k_error, k_velocity = self._gains
        integral = self._integral + error * dt
        proportional = feedforward + k_error * error - k_velocity * (velocity - reference)
        speeds = proportional + k_integral * integral
        is_winding_up = (np.abs(speeds) > limit) & (speeds * error > 0.0)
        self._integral = np.where(is_winding_up, self._integral, integral)
        command: Array = np.clip(proportional + k_integral * self._integral, -limit, limit)
        return command


WEIGHTS = ("integral", "input")
"""The names of the weights."""


def compute_gains(
    lag: float, dt: float, integral_weight: float, input_weight: float
) -> tuple[float, float, float]:
    r"""Compute the gains of integral, error and velocity.

    The command is :math:`\tilde u = k_s s + k_e e - k_v \tilde v`.

    Args:
        lag: the time constant of the velocity loop [s].
        dt: the period of the observations [s].
        integral_weight: the weight of the squared integral, relative to that of the error [1/s^2].
        input_weight: the weight of the squared command [s^2].
    """
    decay = math.exp(-dt / lag)
    a = np.array([[1.0, dt, 0.0], [0.0, 1.0, -lag * (1.0 - decay)], [0.0, 0.0, decay]])
    b = np.array([0.0, -(dt - lag * (1.0 - decay)), 1.0 - decay])
    cost = np.diag([integral_weight, 1.0, 0.0])
    p = cost.copy()
    gain = np.zeros(3)
    for _ in range(N_ITERATIONS):
        pb = _product(p, b[:, None])[:, 0]
        gain = _product(pb[None, :], a)[0] / (input_weight + float(np.sum(b * pb)))
        closed_loop = a - b[:, None] * gain
        p = cost + _product(_product(a.T, p), closed_loop)
    integral, error, velocity = (-gain).tolist()
    return integral, error, -velocity


def _product(left: Array, right: Array) -> Array:
    """Return the matrix product, with sums whose order does not depend on the processor."""
    result: Array = (left[:, :, None] * right[None, :, :]).sum(axis=1)
    return result
