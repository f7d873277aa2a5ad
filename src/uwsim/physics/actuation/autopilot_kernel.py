"""The compiled control loops and thrust allocation of an autopilot; see `autopilot`."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .records import POSITION, THRUSTERS, WRENCH

MAX_SPEED = 0.5
"""The greatest speed that position hold commands [m/s]."""
MAX_CLIMB_RATE = 0.3
"""The greatest climb rate that depth hold commands [m/s]."""
MAX_PITCH = 0.35
"""The greatest pitch with which a vehicle without driven heave changes its depth [rad]."""
PITCH_SPEED = 0.3
"""The speed u_0, below which pitch hardly changes the depth [m/s]."""
FADE_START, FADE_END = 0.4363, 0.7854
"""The tilts between which the desired surge decreases to 0 if pitch is not driven: 25 and 45
degrees [rad]."""

Record = Any
"""A record of one of the types in `records`, or an array of records."""


class Base(NamedTuple):
    """The motion of the base of a vehicle; W is the world frame."""

    position: Array
    """The position in W, (3,) [m]."""
    rotation: Array
    """The rotation matrix ``world_from_base``, (3, 3)."""
    velocity: Array
    """The twist through the water or over ground, in base axes, (6,) [m/s, rad/s]."""


@njit
def steer(
    dt: float,
    autopilot: Record,
    state: Record,
    thrusters: Record,
    thruster_commands: Array,
    base: Base,
    ctrl: Array,
) -> None:
    """Compute the commands of the thrusters.

    Args:
        dt: the time since the last call [s].
        autopilot: a record of `records.AUTOPILOT`.
        state: a record of `records.AUTOPILOT_STATE`, which is advanced by ``dt``.
        thrusters: records of `records.THRUSTER`, (n,).
        thruster_commands: the commands for the mode ``THRUSTERS``, (n,) [1].
        base: the motion of the base.
        ctrl: the engine's ``ctrl``, which receives the commands.
    """
    state.has_new_command = 0
    if state.mode == THRUSTERS:
        for k in range(len(thrusters)):
            ctrl[thrusters[k].ctrl_address] = thruster_commands[k]
        return
    if state.mode == WRENCH:
        thrusts = distribute_wrench(autopilot, state, thrusters)
    else:
        if state.needs_setpoints != 0:
            set_setpoints(state, base)
        thrusts = run_loops(dt, autopilot, state, thrusters, base)
    for k in range(len(thrusters)):
        ctrl[thrusters[k].ctrl_address] = thruster_command(thrusters[k], thrusts[k])


@njit
def set_setpoints(state: Record, base: Base) -> None:
    """Take the present depth, heading and velocity of the vehicle as setpoints."""
    state.needs_setpoints = 0
    for i in range(6):
        state.reference_twist[i] = base.velocity[i]
    state.position_setpoint[2] = base.position[2]
    for i in range(3):
        for k in range(3):
            state.heading_setpoint[i, k] = base.rotation[i, k]


@njit
def run_loops(dt: float, autopilot: Record, state: Record, thrusters: Record, base: Base) -> Array:
    """Return the thrusts that the velocity, depth, heading and position loops command, (n,) [N].

    See `steer` for the arguments. The state advances: the setpoints of depth and heading, the
    reference model, and the integral of the error unless thrusters are at their limits.
    """
    nu_d, climb_rate = desired_twist(dt, autopilot, state, base)
    rotation = base.rotation
    up = rotation[2, 2]
    # the z axis of W in base axes, reversed for a base whose z axis points down
    side = 1.0 if up >= 0.0 else -1.0
    x, y, z = side * rotation[2, 0], side * rotation[2, 1], side * rotation[2, 2]
    pitch = math.atan2(-x, z)  # about the y axis of the base
    desired_pitch = 0.0
    if autopilot.driven_mask[4] == 0.0:
        nu_d[0] *= min(max((FADE_END - abs(pitch)) / (FADE_END - FADE_START), 0.0), 1.0)
    elif autopilot.driven_mask[2] == 0.0:
        desired_pitch = -side * climb_pitch(
            climb_rate, state.commanded_twist[2] * up, base.velocity[0]
        )
    nu_r_dot = (nu_d - state.reference_twist) / max(autopilot.time_constant, dt)
    nu_r = state.reference_twist
    nu_r += nu_r_dot * dt
    error = nu_r - base.velocity
    p, q, r = base.velocity[3], base.velocity[4], base.velocity[5]
    error[0] -= q * autopilot.reference_point[2] - r * autopilot.reference_point[1]
    error[1] -= r * autopilot.reference_point[0] - p * autopilot.reference_point[2]
    error[2] -= p * autopilot.reference_point[1] - q * autopilot.reference_point[0]
    error[3], error[4] = -p, -q
    start = state.integral.copy()
    integral = state.integral
    integral += error * dt
    integral[3] = integral[4] = 0.0
    for i in range(6):
        if autopilot.driven_mask[i] == 0.0:
            integral[i] = 0.0
    tau = control_force(autopilot, nu_r_dot, error, integral, nu_r, base.velocity)
    tau[3] -= autopilot.mass[3] * autopilot.integral_gain * math.atan2(y, z)
    tau[4] -= autopilot.mass[4] * autopilot.integral_gain * (pitch - desired_pitch)
    return allocate_thrusts(autopilot, thrusters, tau, error, start, integral)


@njit
def desired_twist(dt: float, autopilot: Record, state: Record, base: Base) -> tuple[Array, float]:
    """Return the desired twist in base axes, (6,) [m/s, rad/s], and the desired climb rate [m/s].

    The setpoints of depth and heading advance by the commanded twist over ``dt``.
    """
    rotation, position = base.rotation, base.position
    nu_c, target, heading = state.commanded_twist, state.position_setpoint, state.heading_setpoint
    nu_d = nu_c.copy()
    if state.mode == POSITION:
        x_error, y_error = 0.0, 0.0  # [m]
        for k in range(3):
            x_error += rotation[k, 0] * (target[k] - position[k])
            y_error += rotation[k, 1] * (target[k] - position[k])
        speed = autopilot.position_gain * math.hypot(x_error, y_error)
        gain = autopilot.position_gain * min(1.0, MAX_SPEED / max(speed, 1e-9))
        nu_d[0] += gain * x_error
        nu_d[1] += gain * y_error
    up = rotation[2, 2]  # the cosine between the z axes of W and of the base: +-1 when level
    target[2] += nu_c[2] * up * dt
    climb_rate = autopilot.depth_gain * (target[2] - position[2])
    nu_d[2] += min(max(climb_rate, -MAX_CLIMB_RATE), MAX_CLIMB_RATE) * up
    cosine, sine = math.cos(nu_c[5] * dt), math.sin(nu_c[5] * dt)
    heading_y = heading_x = 0.0  # of the desired x axis, in base axes
    for k in range(3):
        x, y = heading[k, 0], heading[k, 1]
        heading[k, 0], heading[k, 1] = cosine * x + sine * y, cosine * y - sine * x
        heading_x += rotation[k, 0] * heading[k, 0]
        heading_y += rotation[k, 1] * heading[k, 0]
    nu_d[5] += autopilot.heading_gain * math.atan2(heading_y, heading_x)
    return nu_d, climb_rate


@njit
def climb_pitch(climb_rate: float, commanded_rate: float, u: float) -> float:
    """Return the pitch for a desired climb rate of a vehicle without driven heave [rad].

    Args:
        climb_rate: the climb rate that the depth loop desires [m/s].
        commanded_rate: the commanded climb rate [m/s].
        u: the surge velocity [m/s].
    """
    gamma = min(max(climb_rate, -MAX_CLIMB_RATE), MAX_CLIMB_RATE) + commanded_rate
    gamma *= u / (u * u + PITCH_SPEED * PITCH_SPEED)
    return min(max(gamma, -MAX_PITCH), MAX_PITCH)


@njit
def control_force(
    autopilot: Record, nu_r_dot: Array, error: Array, integral: Array, nu_r: Array, nu: Array
) -> Array:
    """Return the force and moment that the velocity loops command, (6,) [N, N m].

    Args:
        autopilot: a record of `records.AUTOPILOT`.
        nu_r_dot: the rate of the reference twist, (6,) [m/s2, rad/s2].
        error: the reference twist minus the twist, (6,) [m/s, rad/s].
        integral: the integral of the error, (6,) [m, rad].
        nu_r: the reference twist, (6,) [m/s, rad/s].
        nu: the twist, (6,) [m/s, rad/s].
    """
    tau: Array = autopilot.mass * (
        nu_r_dot + autopilot.velocity_gain * error + autopilot.integral_gain * integral
    )
    tau += autopilot.linear_damping * nu_r + autopilot.quadratic_damping * np.abs(nu_r) * nu_r
    u, v, w = nu[0], nu[1], nu[2]
    m_a = autopilot.added_mass
    tau[3] += (m_a[2] - m_a[1]) * v * w  # the Munk moment v x A v, which turns hulls broadside
    tau[4] += (m_a[0] - m_a[2]) * w * u
    tau[5] += (m_a[1] - m_a[0]) * u * v
    return tau


@njit
def allocate_thrusts(
    autopilot: Record, thrusters: Record, tau: Array, error: Array, start: Array, integral: Array
) -> Array:
    """Return the thrusts for a force and moment, (n,) [N], and prevent windup of the integrals.

    Args:
        autopilot: a record of `records.AUTOPILOT`.
        thrusters: records of `records.THRUSTER`, (n,).
        tau: the desired force and moment, which is limited here, (6,) [N, N m].
        error: the error of each axis, (6,).
        start: the integrals before this call of the autopilot, (6,).
        integral: the integrals, which are reset to ``start`` along saturated axes, (6,).
    """
    for i in range(3):
        limited_force = min(max(tau[i], -autopilot.max_forces[i]), autopilot.max_forces[i])
        if (tau[i] - limited_force) * error[i] > 0.0:
            integral[i] = start[i]
        tau[i] = limited_force
    optimum = distribute_force(autopilot, thrusters, tau)
    thrusts = reduce_surge_sway(autopilot, thrusters, tau, optimum)
    for i in range(autopilot.n_axes):
        shortfall = 0.0  # the desired force or moment beyond the limits of the thrusters
        for k in range(len(thrusts)):
            thruster = thrusters[k]
            excess = optimum[k] - min(max(thrusts[k], thruster.min_thrust), thruster.max_thrust)
            shortfall += thruster.wrench[i] * excess
        axis = autopilot.axes[i]
        if shortfall * error[axis] > 0.0:
            integral[axis] = start[axis]
    return thrusts


@njit
def reduce_surge_sway(autopilot: Record, thrusters: Record, tau: Array, optimum: Array) -> Array:
    """Return thrusts with surge and sway reduced until no thruster exceeds its limit, (n,) [N].

    The forces along the other axes are kept: if each thruster were limited separately, the vehicle
    would lose attitude, depth and heading.
    """
    other_axes = tau.copy()
    other_axes[0] = other_axes[1] = 0.0
    other_thrusts = distribute_force(autopilot, thrusters, other_axes)
    share = 1.0
    for k in range(len(other_thrusts)):
        difference = optimum[k] - other_thrusts[k]
        limit = thrusters[k].max_thrust if difference > 0.0 else thrusters[k].min_thrust
        if difference != 0.0:
            share = min(share, max((limit - other_thrusts[k]) / difference, 0.0))
    return other_thrusts + share * (optimum - other_thrusts)


@njit
def distribute_force(autopilot: Record, thrusters: Record, tau: Array) -> Array:
    """Return the least-squares thrusts for a force and moment (6,), without limits, (n,) [N]."""
    thrusts = np.zeros(len(thrusters))
    for k in range(len(thrusters)):
        for i in range(autopilot.n_axes):
            thrusts[k] += thrusters[k].allocation[i] * tau[autopilot.axes[i]]
    return thrusts


@njit
def distribute_wrench(autopilot: Record, state: Record, thrusters: Record) -> Array:
    """Return the least-squares thrusts for the commanded wrench, without limits, (n,) [N]."""
    thrusts = np.zeros(len(thrusters))
    for k in range(len(thrusters)):
        for i in range(autopilot.n_wrench_axes):
            thrusts[k] += (
                thrusters[k].wrench_allocation[i] * state.commanded_wrench[autopilot.wrench_axes[i]]
            )
    return thrusts


@njit
def thruster_command(thruster: Record, force: float) -> float:
    """Return the command of a thruster for a thrust [N], within the thruster's limits [1]."""
    x, y = thruster.thrusts, thruster.commands
    j, end = -1, len(x)  # bisection for the last point whose thrust is not above the force
    while end - j > 1:
        middle = (j + end) // 2
        if x[middle] > force:
            end = middle
        else:
            j = middle
    command: float = y[min(max(j, 0), len(y) - 1)]
    if 0 <= j < len(x) - 1:
        command = y[j] + (y[j + 1] - y[j]) * (force - x[j]) / (x[j + 1] - x[j])
    return command
