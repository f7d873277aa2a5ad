r"""A plan of forces that keeps three independent axes near a moving place.

On each axis, with the error e, the velocity v, the velocity of the place r and the force f, the
model for steps of h is

.. math::

    e^+ = e + h (r - v^+), \qquad
    m (v^+ - v) / h = f + d - (a + 2 b |v_0|) v + b |v_0| v_0

with the drag :math:`a v + b |v| v` linearised at the present velocity :math:`v_0`. The plan
minimises

.. math:: \sum_k \left( e_k^2 + \rho^2 (f_k / m)^2 + \sigma^2 ((f_k - f_{k-1}) / m)^2 \right),
    \qquad |f_k| \le f_{max}

It is the solution of a quadratic programme in the forces alone (condensed; Rawlings, Mayne and
Diehl, Model Predictive Control, 2017, section 8.8.4), by a fixed number of steps of the accelerated
projected gradient (Beck and Teboulle, SIAM J. Imaging Sci. 2, 2009), from the plan before. Not
modelled: the coupling of the axes, and a place that changes its velocity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array

N_STEPS = 20
"""The number of steps of a plan."""
STEP = 0.1
"""The length of a step of a plan [s]."""
N_ITERATIONS = 60
"""The number of iterations of the projected gradient."""


@dataclass(frozen=True, kw_only=True)
class AxisModel:
    """The model of three axes: surge, sway and heave."""

    mass: Array
    """The mass with the added mass, (3,) [kg]."""
    linear: Array
    """The linear drag, (3,) [N s/m]."""
    quadratic: Array
    """The quadratic drag, (3,) [N s2/m2]."""
    limit: Array
    """The greatest force, (3,) [N]."""

    def acceleration(self, velocity: Array, force: Array) -> Array:
        """Return the acceleration, (3,) [m/s2], by a force that includes disturbances, (3,) [N]."""
        drag = (self.linear + self.quadratic * np.abs(velocity)) * velocity
        result: Array = (force - drag) / self.mass
        return result


class Planner:
    """The plan, which each call improves.

    Args:
        model: the model of the axes.
        force_weight: the weight rho of the accelerations by the forces [s2].
        change_weight: the weight sigma of their changes [s2].
    """

    def __init__(self, model: AxisModel, *, force_weight: float, change_weight: float) -> None:
        self._model = model
        self._force_weight = force_weight / model.mass
        self._change_weight = change_weight / model.mass
        self._plan = np.zeros((3, N_STEPS))  # [N]
        self._last_force = np.zeros(3)  # [N]

    def improve(self, error: Array, velocity: Array, reference: Array, known_force: Array) -> Array:
        """Return the first forces of the improved plan, (3,) [N].

        Args:
            error: from the vehicle to the place, (3,) [m].
            velocity: the velocity of the vehicle, (3,) [m/s].
            reference: the velocity of the place, (3,) [m/s].
            known_force: the force of weight and disturbances, (3,) [N].
        """
        free_errors, response = self._predict(error, velocity, reference, known_force)
        hessian, gradient = self._condense(free_errors, response)
        self._plan = self._minimise(hessian, gradient)
        self._last_force = self._plan[:, 0].copy()
        return self._last_force

    def _predict(
        self, error: Array, velocity: Array, reference: Array, known_force: Array
    ) -> tuple[Array, Array]:
        """Return the errors without forces (3, n), and those after a unit force (3, n)."""
        model, speed = self._model, np.abs(velocity)
        decay = 1.0 - STEP * (model.linear + 2.0 * model.quadratic * speed) / model.mass
        push = STEP * (known_force + model.quadratic * speed * velocity) / model.mass
        errors, response = np.empty((3, N_STEPS)), np.empty((3, N_STEPS))
        pulse, shift = STEP / model.mass, np.zeros(3)
        for k in range(N_STEPS):
            velocity = decay * velocity + push
            error = error + STEP * (reference - velocity)
            shift = shift - STEP * pulse
            pulse = decay * pulse
            errors[:, k], response[:, k] = error, shift
        return errors, response

    def _condense(self, errors: Array, response: Array) -> tuple[Array, Array]:
        """Return the Hessian (3, n, n) and the gradient at no force (3, n) of half the cost."""
        delay = np.subtract.outer(np.arange(N_STEPS), np.arange(N_STEPS))
        effect = np.where(delay >= 0, response[:, np.maximum(delay, 0)], 0.0)  # error k, force j
        hessian = (effect[:, :, :, np.newaxis] * effect[:, :, np.newaxis, :]).sum(axis=1)
        gradient = (effect * errors[:, :, np.newaxis]).sum(axis=1)
        change = np.eye(N_STEPS) - np.eye(N_STEPS, k=-1)
        changes = (change[:, :, np.newaxis] * change[:, np.newaxis, :]).sum(axis=0)
        weight, change_weight = self._force_weight**2, self._change_weight**2
        hessian += weight[:, None, None] * np.eye(N_STEPS) + change_weight[:, None, None] * changes
        gradient[:, 0] -= change_weight * self._last_force
        return hessian, gradient

    def _minimise(self, hessian: Array, gradient: Array) -> Array:
        """Return the forces within their limits, (3, n) [N], from the last plan."""
        limit = self._model.limit[:, np.newaxis]
        curvature = np.abs(hessian).sum(axis=2).max(axis=1)[:, np.newaxis]  # at least the greatest
        plan = np.concatenate([self._plan[:, 1:], self._plan[:, -1:]], axis=1)
        point, momentum = plan, 1.0
        for _ in range(N_ITERATIONS):
            slope = (hessian * point[:, np.newaxis, :]).sum(axis=2) + gradient
            next_plan = np.clip(point - slope / curvature, -limit, limit)
            next_momentum = 0.5 * (1.0 + math.sqrt(1.0 + 4.0 * momentum * momentum))
            point = next_plan + (momentum - 1.0) / next_momentum * (next_plan - plan)
            plan, momentum = next_plan, next_momentum
        return plan
