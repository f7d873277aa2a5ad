r"""Joint servos, compiled because evaluated at every step.

.. math:: \tau = k_p (q_d - q) + k_d (\dot q_d - \dot q) + \tau_{load} + k_i \int (q_d - q)\,dt,
          \qquad |\tau| \le \tau_{max}

The load is that of the engine's last step: weight, buoyancy, drag and all else that does not depend
on accelerations (computed torque; Siciliano et al., Robotics, 2009, section 8.5). The integral is
for unknown loads, as an object in the jaw. It is constant while the servo is at its greatest effort
or the joint is farther than `MAX_INTEGRAL` from its target.
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
"""An array of records of `records`."""


class EngineArrays(NamedTuple):
    """The engine's arrays that servos read, and ``ctrl``, which they set."""

    qpos: Array
    bias: Array
    passive: Array
    spring: Array
    damper: Array
    efforts: Array
    controls: Array


@njit
def clamp_targets(joints: Records, states: Records) -> None:
    """Clamp the targets to the limits, and set those of joints that mimic."""
    for i in range(len(joints)):
        if joints[i].kind == OWN_VALUE:
            aim = min(max(states[i].wanted, joints[i].lower), joints[i].upper)
            states[i].aim = aim
            states[i].wanted = aim
    for i in range(len(joints)):
        if joints[i].kind != OWN_VALUE:
            leader = joints[i].leader
            leader_position = states[leader].aim if leader >= 0 else 0.0
            if joints[i].kind == GEAR_RATIO:
                states[i].aim = leader_position * joints[i].multiplier + joints[i].offset
            else:
                sine = joints[i].offset * math.sin(leader_position)
                states[i].aim = -(leader_position + math.asin(min(max(sine, -1.0), 1.0)))


@njit
def set_targets(joints: Records, states: Records, indices: JointIndices, targets: Array) -> None:
    """Set the targets of the servos of some joints; the others continue to theirs."""
    for i in range(len(indices)):
        states[indices[i]].wanted = targets[i]
        states[indices[i]].speed = 0.0
    clamp_targets(joints, states)


@njit
def find_first_off(states: Records, indices: JointIndices) -> int:
    """Return the index of the first of some joints whose servo is off; below 0 if all are on."""
    for i in range(len(indices)):
        if states[indices[i]].is_on == 0:
            return i
    return -1


@njit
def advance_requests(dt: float, joints: Records, states: Records, qpos: Array) -> None:
    """Advance the requested positions of driven joints by ``dt`` [s]; set those of free joints."""
    has_changes = False
    for i in range(len(joints)):
        if joints[i].kind == OWN_VALUE and (states[i].speed != 0.0 or states[i].is_on == 0):
            has_changes = True
    if not has_changes:
        return
    for i in range(len(joints)):
        if joints[i].kind == OWN_VALUE:
            if states[i].is_on != 0:
                states[i].wanted = states[i].wanted + states[i].speed * dt
            else:
                states[i].wanted = qpos[joints[i].qpos_address]
    clamp_targets(joints, states)


@njit
def apply_servos(dt: float, joints: Records, states: Records, engine: EngineArrays) -> None:
    """Advance the targets by ``dt`` [s] and set the controls of the position servos."""
    for i in range(len(joints)):
        if joints[i].kind != GEAR_RATIO or joints[i].leader < 0:
            max_change = joints[i].max_speed * dt
            states[i].step = min(max(states[i].aim - states[i].target, -max_change), max_change)
            states[i].target = states[i].target + states[i].step
    for i in range(len(joints)):
        joint, state = joints[i], states[i]
        dof = joint.dof_address
        if joint.kind == GEAR_RATIO and joint.leader >= 0:  # as fast as the gear turns it
            leader = states[joint.leader]
            state.step = leader.step * joint.multiplier
            state.target = leader.target * joint.multiplier + joint.offset
        error = state.target - engine.qpos[joint.qpos_address]
        effort = engine.efforts[dof]
        is_saturated = abs(effort) >= joint.max_effort and effort * error > 0.0
        if not is_saturated and abs(error) <= MAX_INTEGRAL:
            integral = state.integral + INTEGRAL_RATE * dt * error
            state.integral = min(max(integral, -MAX_INTEGRAL), MAX_INTEGRAL)
        load = engine.bias[dof] - (engine.passive[dof] - engine.spring[dof] - engine.damper[dof])
        load += joint.damping * state.step / dt
        engine.controls[joint.ctrl_address] = state.target + load / joint.stiffness + state.integral
