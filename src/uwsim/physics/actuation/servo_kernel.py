r"""Joint servos, compiled because evaluated at every step.

.. math:: \tau = k_p (q_d - q) + k_d (\dot q_d - \dot q) + \tau_{load} + k_i \int (q_d - q)\,dt,
          \qquad |\tau| \le \tau_{max}

The load is what the engine found at the last step for weight, buoyancy, drag and the rest that does
not depend on accelerations (computed torque; Siciliano et al., Robotics, 2009, section 8.5). The
integral is for what the servo cannot know, a thing in the jaw; it stands still while the servo
pulls with all it has or the joint is further than `NEAR` from its target.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...vehicle import JointIndices
from .records import GEARED, OWN

INTEGRAL = 1.0
"""k_i over k_p [1/s]."""
NEAR = 0.3
"""Farther from its target a joint is on its way; the integral's bound, too [rad or m]."""

Records = Any
"""An array of one of `records`."""


class Forces(NamedTuple):
    """The engine's arrays that servos read, and ``ctrl``, which they set."""

    qpos: Array
    bias: Array
    passive: Array
    spring: Array
    damper: Array
    given: Array
    controls: Array


@njit
def take_aim(joints: Records, states: Records) -> None:
    """Clamp the targets to the limits, and set those of joints that mimic."""
    for i in range(len(joints)):
        if joints[i].kind == OWN:
            aim = min(max(states[i].wanted, joints[i].lower), joints[i].upper)
            states[i].aim = aim
            states[i].wanted = aim
    for i in range(len(joints)):
        if joints[i].kind != OWN:
            leader = joints[i].leader
            source = states[leader].aim if leader >= 0 else 0.0
            if joints[i].kind == GEARED:
                states[i].aim = source * joints[i].multiplier + joints[i].offset
            else:
                reach = joints[i].offset * math.sin(source)
                states[i].aim = -(source + math.asin(min(max(reach, -1.0), 1.0)))


@njit
def aim_at(joints: Records, states: Records, places: JointIndices, targets: Array) -> None:
    """Let the servos of some joints go to targets, and all others on to theirs."""
    for i in range(len(places)):
        states[places[i]].wanted = targets[i]
        states[places[i]].speed = 0.0
    take_aim(joints, states)


@njit
def first_off(states: Records, places: JointIndices) -> int:
    """Which of some joints is the first whose servo is off; below 0 all are on."""
    for i in range(len(places)):
        if states[places[i]].is_on == 0:
            return i
    return -1


@njit
def move_on(dt: float, joints: Records, states: Records, qpos: Array) -> None:
    """Move on by ``dt`` [s] what is wanted of joints that are driven; one that is off is let go."""
    moves = False
    for i in range(len(joints)):
        if joints[i].kind == OWN and (states[i].speed != 0.0 or states[i].is_on == 0):
            moves = True
    if not moves:
        return
    for i in range(len(joints)):
        if joints[i].kind == OWN:
            if states[i].is_on != 0:
                states[i].wanted = states[i].wanted + states[i].speed * dt
            else:
                states[i].wanted = qpos[joints[i].place]
    take_aim(joints, states)


@njit
def pull(dt: float, joints: Records, states: Records, engine: Forces) -> None:
    """Advance the targets by ``dt`` [s] and set the controls of the position servos."""
    for i in range(len(joints)):
        if joints[i].kind != GEARED or joints[i].leader < 0:
            way = joints[i].max_speed * dt
            states[i].step = min(max(states[i].aim - states[i].target, -way), way)
            states[i].target = states[i].target + states[i].step
    for i in range(len(joints)):
        joint, state = joints[i], states[i]
        dof = joint.dof
        if joint.kind == GEARED and joint.leader >= 0:  # as fast as the gear turns it
            leader = states[joint.leader]
            state.step = leader.step * joint.multiplier
            state.target = leader.target * joint.multiplier + joint.offset
        error = state.target - engine.qpos[joint.place]
        given = engine.given[dof]
        is_spent = abs(given) >= joint.max_effort and given * error > 0.0
        if not is_spent and abs(error) <= NEAR:
            state.integral = min(max(state.integral + INTEGRAL * dt * error, -NEAR), NEAR)
        load = engine.bias[dof] - (engine.passive[dof] - engine.spring[dof] - engine.damper[dof])
        load += joint.damping * state.step / dt
        engine.controls[joint.control] = state.target + load / joint.stiffness + state.integral
