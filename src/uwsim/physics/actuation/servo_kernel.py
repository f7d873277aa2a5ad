r"""Joint servos, compiled for evaluation in every step.

The effort of a servo at the position q with the target :math:`q_d` is

.. math:: \tau = k_p (q_d - q) + k_d (\dot q_d - \dot q) + \tau_{load} + k_i \int (q_d - q)\,dt,
          \qquad |\tau| \le \tau_{max}

The load :math:`\tau_{load}` is that of the engine's last step: weight, buoyancy, drag and all other
forces that do not depend on accelerations (computed torque; Siciliano et al., Robotics, 2009,
section 8.5). The integral compensates unknown loads such as an object in the jaw. It is constant
while the servo is at its greatest effort :math:`\tau_{max}` in the direction of the error, or the
joint is farther than `MAX_INTEGRAL` from the target.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...vehicle import JointIndices
from .records import GEAR_RATIO, OWN_VALUE

INTEGRAL_RATE = 1.0
"""The ratio k_i / k_p [1/s]."""
MAX_INTEGRAL = 0.3
"""The greatest error at which the integral changes, and the bound of the integral [rad or m]."""

Records = Any
"""An array of records of one of the types in `records`."""


class EngineArrays(NamedTuple):
    """The engine's arrays that servos read, and ``ctrl``, which they set."""

    qpos: Array
    """The positions, ``qpos``, (nq,) [m, 1, rad]."""
    bias: Array
    """The bias forces, ``qfrc_bias``, (nv,) [N, N m]."""
    passive: Array
    """The passive forces, ``qfrc_passive``, (nv,) [N, N m]."""
    spring: Array
    """The forces of springs, ``qfrc_spring``, a part of the passive forces, (nv,) [N, N m]."""
    damper: Array
    """The forces of dampers, ``qfrc_damper``, a part of the passive forces, (nv,) [N, N m]."""
    efforts: Array
    """The forces of actuators, ``qfrc_actuator``, (nv,) [N, N m]."""
    controls: Array
    """The controls, ``ctrl``, (nu,)."""


@njit
def clamp_targets(joints: Records, states: Records) -> None:
    """Clamp the requested positions to the limits, and compute the final targets of all joints."""
    for i in range(len(joints)):
        if joints[i].kind == OWN_VALUE:
            final_target = min(max(states[i].requested_position, joints[i].lower), joints[i].upper)
            states[i].final_target = final_target
            states[i].requested_position = final_target
    for i in range(len(joints)):
        if joints[i].kind != OWN_VALUE:
            leader = joints[i].leader
            leader_position = states[leader].final_target if leader >= 0 else 0.0
            if joints[i].kind == GEAR_RATIO:
                states[i].final_target = leader_position * joints[i].multiplier + joints[i].offset
            else:  # SLIDER_CRANK; the offset is the length of the crank over that of the rod
                sine = joints[i].offset * math.sin(leader_position)
                states[i].final_target = -(leader_position + math.asin(min(max(sine, -1.0), 1.0)))


@njit
def set_targets(joints: Records, states: Records, indices: JointIndices, targets: Array) -> None:
    """Set the requested positions (n,) [rad or m] of some joints; other joints are unchanged."""
    for i in range(len(indices)):
        states[indices[i]].requested_position = targets[i]
        states[indices[i]].requested_speed = 0.0
    clamp_targets(joints, states)


@njit
def find_first_off(states: Records, indices: JointIndices) -> int:
    """Return the first position in ``indices`` of a joint whose servo is off; -1 if all are on."""
    for i in range(len(indices)):
        if states[indices[i]].is_on == 0:
            return i
    return -1


@njit
def advance_requests(dt: float, joints: Records, states: Records, qpos: Array) -> None:
    """Advance the requested positions by ``dt`` [s]; joints whose servo is off keep theirs current.

    The requested position of a joint whose servo is off is its present position.
    """
    has_changes = False
    for i in range(len(joints)):
        if joints[i].kind == OWN_VALUE and (
            states[i].requested_speed != 0.0 or states[i].is_on == 0
        ):
            has_changes = True
    if not has_changes:
        return
    for i in range(len(joints)):
        if joints[i].kind == OWN_VALUE:
            if states[i].is_on != 0:
                states[i].requested_position = (
                    states[i].requested_position + states[i].requested_speed * dt
                )
            else:
                states[i].requested_position = qpos[joints[i].qpos_address]
    clamp_targets(joints, states)


@njit
def apply_servos(dt: float, joints: Records, states: Records, engine: EngineArrays) -> None:
    """Advance the targets by ``dt`` [s], and set the controls of the servos."""
    for i in range(len(joints)):
        if joints[i].kind != GEAR_RATIO or joints[i].leader < 0:
            max_change = joints[i].max_speed * dt
            states[i].target_change = min(
                max(states[i].final_target - states[i].target, -max_change), max_change
            )
            states[i].target = states[i].target + states[i].target_change
    for i in range(len(joints)):
        joint, state = joints[i], states[i]
        dof = joint.dof_address
        if joint.kind == GEAR_RATIO and joint.leader >= 0:  # follows the leader's target exactly
            leader = states[joint.leader]
            state.target_change = leader.target_change * joint.multiplier
            state.target = leader.target * joint.multiplier + joint.offset
        error = state.target - engine.qpos[joint.qpos_address]
        effort = engine.efforts[dof]
        is_saturated = abs(effort) >= joint.max_effort and effort * error > 0.0
        if not is_saturated and abs(error) <= MAX_INTEGRAL:
            integral = state.integral + INTEGRAL_RATE * dt * error
            state.integral = min(max(integral, -MAX_INTEGRAL), MAX_INTEGRAL)
        load = engine.bias[dof] - (engine.passive[dof] - engine.spring[dof] - engine.damper[dof])
        load += joint.damping * state.target_change / dt
        engine.controls[joint.ctrl_address] = state.target + load / joint.stiffness + state.integral
