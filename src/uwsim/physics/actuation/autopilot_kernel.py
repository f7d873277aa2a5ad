"""Control loops and thrust allocation of an autopilot, compiled (`autopilot`)."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...geometry import Array
from ...jit import njit

Axes = npt.NDArray[np.int64]
DEPTH, POSITION, HEADING, VELOCITY, INTEGRAL = range(5)
"""Places of the gains, as `loops` takes them."""
MAX_SPEED = 0.5
"""Greatest speed that position hold commands [m/s]."""
MAX_CLIMB_RATE = 0.3
"""What depth hold wishes for at most [m/s]."""
STEEPEST_DIVE = 0.35
"""Angle at which a vehicle without heave goes up and down at most [rad]."""
SLOW = 0.3
"""Speed below which it hardly can [m/s]."""
LEVEL, STEEP = 0.4363, 0.7854
"""Lean from which on, and up to which, surge fades out where pitch is not driven: 25 and 45 degrees
[rad]."""


@njit
def loops(
    dt: float,
    lag: float,
    goes: bool,
    gains: Array,
    position: Array,
    rotation: Array,
    velocity: Array,
    commanded: Array,
    target: Array,
    heading: Array,
    mass: Array,
    added: Array,
    linear: Array,
    quadratic: Array,
    reference: Array,
    axes: Axes,
    share: Array,
    reached: Array,
    least: Array,
    greatest: Array,
    drives: Array,
    most: Array,
    model: Array,
    integral: Array,
) -> Array:
    """Return the thrusts that the velocity, depth, heading and position loops command, (n,) [N].

    Args:
        dt: time since the last call [s].
        lag: with which ``model`` goes after what is wanted [s].
        goes: whether it goes to ``target`` in the plane, too.
        gains: (5,), see `DEPTH` and those that follow.
        position: of the base in W, (3,) [m].
        rotation: ``world_from_base``, (3, 3).
        velocity: of the base, base axes, (6,) [m/s, rad/s].
        commanded: the twist asked for, base axes, (6,) [m/s, rad/s].
        target: where to be, in W, (3,) [m]; the height moves on as commanded.
        heading: ``world_from_base`` whose yaw is wanted, (3, 3); turns on as commanded.
        mass: and added mass along the axes, (6,) [kg, kg m2].
        added: the added mass of it, (6,) [kg, kg m2].
        linear: damping along the axes, (6,).
        quadratic: damping along the axes, (6,).
        reference: what forces and velocities are about, base axes, (3,) [m].
        axes: which of the six forces and moments the thrusters are to give, (k,).
        share: thrusts from those, (n, k).
        reached: the other way, (k, n).
        least: thrusts, (n,) [N].
        greatest: thrusts, (n,) [N].
        drives: 1 for each axis that the thrusters drive, 0 for the others, (6,).
        most: force of an axis at most, lest the hull leans, (6,) [N].
        model: the velocity that is followed, (6,) [m/s, rad/s]; goes after the wanted one.
        integral: of the error, (6,) [m, rad]; moves on unless thrusters are at their limits.
    """
    wanted = commanded.copy()
    if goes:
        ahead, aside = 0.0, 0.0  # [m]
        for k in range(3):
            ahead += rotation[k, 0] * (target[k] - position[k])
            aside += rotation[k, 1] * (target[k] - position[k])
        size = gains[POSITION] * math.hypot(ahead, aside)
        slowed = gains[POSITION] * min(1.0, MAX_SPEED / max(size, 1e-9))
        wanted[0] += slowed * ahead
        wanted[1] += slowed * aside
    up = rotation[2, 2]  # how much of W's z lies along the base's z: +-1 when level
    target[2] += commanded[2] * up * dt
    climb = gains[DEPTH] * (target[2] - position[2])
    wanted[2] += min(max(climb, -MAX_CLIMB_RATE), MAX_CLIMB_RATE) * up
    cosine, sine = math.cos(commanded[5] * dt), math.sin(commanded[5] * dt)
    across = along = 0.0  # of the wanted x axis, in the base
    for k in range(3):
        x, y = heading[k, 0], heading[k, 1]
        heading[k, 0], heading[k, 1] = cosine * x + sine * y, cosine * y - sine * x
        along += rotation[k, 0] * heading[k, 0]
        across += rotation[k, 1] * heading[k, 0]
    wanted[5] += gains[HEADING] * math.atan2(across, along)
    # W's z in base axes; of a base whose z points down it is the other way round
    side = 1.0 if up >= 0.0 else -1.0
    x, y, z = side * rotation[2, 0], side * rotation[2, 1], side * rotation[2, 2]
    lean = math.atan2(-x, z)  # about the base's y
    dive = 0.0  # the lean wished for
    if drives[4] == 0.0:
        wanted[0] *= min(max((STEEP - abs(lean)) / (STEEP - LEVEL), 0.0), 1.0)
    elif drives[2] == 0.0:
        ahead_speed = velocity[0]
        slope = min(max(climb, -MAX_CLIMB_RATE), MAX_CLIMB_RATE) + commanded[2] * up
        slope *= ahead_speed / (ahead_speed * ahead_speed + SLOW * SLOW)
        dive = -side * min(max(slope, -STEEPEST_DIVE), STEEPEST_DIVE)
    speeding = (wanted - model) / max(lag, dt)
    model += speeding * dt
    error = model - velocity
    a, b, c = velocity[3], velocity[4], velocity[5]
    error[0] -= b * reference[2] - c * reference[1]
    error[1] -= c * reference[0] - a * reference[2]
    error[2] -= a * reference[1] - b * reference[0]
    error[3], error[4] = -a, -b
    before = integral.copy()
    integral += error * dt
    integral[3] = integral[4] = 0.0
    for i in range(6):
        if drives[i] == 0.0:
            integral[i] = 0.0
    tau = mass * (speeding + gains[VELOCITY] * error + gains[INTEGRAL] * integral)
    tau += linear * model + quadratic * np.abs(model) * model
    u, v, w = velocity[0], velocity[1], velocity[2]
    tau[3] += (added[2] - added[1]) * v * w  # the Munk moment v x A v, which turns hulls broadside
    tau[4] += (added[0] - added[2]) * w * u
    tau[5] += (added[1] - added[0]) * u * v
    tau[3] -= mass[3] * gains[INTEGRAL] * math.atan2(y, z)
    tau[4] -= mass[4] * gains[INTEGRAL] * (lean - dive)
    for i in range(3):
        held = min(max(tau[i], -most[i]), most[i])
        if (tau[i] - held) * error[i] > 0.0:
            integral[i] = before[i]
        tau[i] = held
    asked = shared(tau, axes, share)
    forces = within_reach(tau, asked, axes, share, least, greatest)
    for i in range(len(axes)):
        lacking = 0.0  # force or moment beyond the thrusters' limits
        for k in range(len(forces)):
            excess = asked[k] - min(max(forces[k], least[k]), greatest[k])
            lacking += reached[i, k] * excess
        place = axes[i]
        if lacking * error[place] > 0.0:
            integral[place] = before[place]
    return forces


@njit
def within_reach(
    tau: Array, asked: Array, axes: Axes, share: Array, least: Array, greatest: Array
) -> Array:
    """Return the thrusts with surge and sway reduced to what the other axes leave, (n,) [N].

    Who cannot do all keeps upright first, and depth and heading: a pull that is cut off thruster
    by thruster would turn the vehicle over.
    """
    still = tau.copy()
    still[0] = still[1] = 0.0
    rest = shared(still, axes, share)
    part = 1.0
    for k in range(len(rest)):
        way = asked[k] - rest[k]
        end = greatest[k] if way > 0.0 else least[k]
        if way != 0.0:
            part = min(part, max((end - rest[k]) / way, 0.0))
    return rest + part * (asked - rest)


@njit
def shared(tau: Array, axes: Axes, share: Array) -> Array:
    """Return the thrusts that come nearest to a force and moment (6,), beyond limits too, (n,)."""
    forces = np.zeros(len(share))
    for k in range(len(share)):
        for i in range(len(axes)):
            forces[k] += share[k, i] * tau[axes[i]]
    return forces


@njit
def commands(forces: Array, thrusts: Array, given_by: Array) -> Array:
    """Return the thrusters' commands for these thrusts, as far as they reach, (n,) [1].

    Args:
        forces: the thrusts, (n,) [N].
        thrusts: points of each thruster's curve, rising, (n, k) [N].
        given_by: the command at each point, (n, k) [1].
    """
    found = np.empty(len(forces))
    for k in range(len(forces)):
        x, y = thrusts[k], given_by[k]
        j = np.searchsorted(x, forces[k], side="right") - 1
        if j < 0:
            found[k] = y[0]
        elif j >= len(x) - 1:
            found[k] = y[-1]
        else:
            found[k] = y[j] + (y[j + 1] - y[j]) * (forces[k] - x[j]) / (x[j + 1] - x[j])
    return found
