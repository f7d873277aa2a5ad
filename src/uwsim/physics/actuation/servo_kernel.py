r"""Joint servos, compiled because evaluated at every step.

.. math:: \tau = k_p (q_d - q) + k_d (\dot q_d - \dot q) + \tau_{load} + k_i \int (q_d - q)\,dt,
          \qquad |\tau| \le \tau_{max}

The load is what the engine found at the last step for weight, buoyancy, drag and the rest that does
not depend on accelerations (computed torque; Siciliano et al., Robotics, 2009, section 8.5). The
integral is for what the servo cannot know, a thing in the jaw; it stands still while the servo
pulls with all it has or the joint is further than `NEAR` from its target.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...geometry import Array
from ...jit import njit

INTEGRAL = 1.0
"""k_i over k_p [1/s]."""
NEAR = 0.3
"""Farther from its target a joint is on its way; the integral's bound, too [rad or m]."""

Ints = npt.NDArray[np.int64]


@njit
def pull(
    dt: float,
    addresses: Ints,
    traits: Array,
    memory: Array,
    qpos: Array,
    bias: Array,
    passive: Array,
    spring: Array,
    damper: Array,
    given: Array,
    controls: Array,
) -> None:
    """Move the targets on by ``dt`` [s] and set the controls of the engine's position servos.

    Args:
        dt: length of the step [s].
        addresses: of each joint in ``qpos``, among the degrees of freedom and in ``controls``,
            (n, 3).
        traits: stiffness, damping, greatest effort and greatest speed of each joint, (n, 4).
        memory: where the target goes, where it is [rad or m], and the integral's effort over the
            stiffness [rad or m], (n, 3); the last two are changed.
        qpos: the engine's positions.
        bias: its ``qfrc_bias``.
        passive: its ``qfrc_passive``.
        spring: the part of it from springs, those that gear joints together.
        damper: the part of it from dampers.
        given: its ``qfrc_actuator``.
        controls: its ``ctrl``, changed.
    """
    for i in range(len(addresses)):
        place, dof, control = addresses[i]
        stiffness, damping, strongest, fastest = traits[i]
        way = fastest * dt
        step = min(max(memory[i, 0] - memory[i, 1], -way), way)
        target = memory[i, 1] + step
        error = target - qpos[place]
        is_spent = abs(given[dof]) >= strongest and given[dof] * error > 0.0
        if not is_spent and abs(error) <= NEAR:
            memory[i, 2] = min(max(memory[i, 2] + INTEGRAL * dt * error, -NEAR), NEAR)
        memory[i, 1] = target
        load = bias[dof] - (passive[dof] - spring[dof] - damper[dof]) + damping * step / dt
        controls[control] = target + load / stiffness + memory[i, 2]
