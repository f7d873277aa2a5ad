"""Control loops and thrust allocation of an autopilot, compiled (`autopilot`)."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .records import POSITION, THRUSTERS, WRENCH

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

Record = Any
"""One of `records`."""


class Seen(NamedTuple):
    """The base as its autopilot sees it."""

    position: Array
    """In W, (3,) [m]."""
    rotation: Array
    """``world_from_base``, (3, 3)."""
    velocity: Array
    """Relative to water or ground, base axes, (6,) [m/s, rad/s]."""


@njit
def steer(
    dt: float,
    autopilot: Record,
    state: Record,
    thrusters: Record,
    own: Array,
    seen: Seen,
    ctrl: Array,
) -> None:
    """Set the commands of the thrusters.

    Args:
        dt: time since the last call [s].
        autopilot: of `records.AUTOPILOT`.
        state: of `records.AUTOPILOT_STATE`; moves on.
        thrusters: of `records.THRUSTER`, (n,).
        own: commands of the thrusters that somebody gave, (n,) [1].
        seen: the base.
        ctrl: the engine's, changed.
    """
    state.has_news = 0
    if state.mode == THRUSTERS:
        for k in range(len(thrusters)):
            ctrl[thrusters[k].control] = own[k]
        return
    if state.mode == WRENCH:
        forces = nearest(autopilot, state, thrusters)
    else:
        if state.takes_over != 0:
            take_over(state, seen)
        forces = loops(dt, autopilot, state, thrusters, seen)
    for k in range(len(thrusters)):
        ctrl[thrusters[k].control] = command(thrusters[k], forces[k])


@njit
def take_over(state: Record, seen: Seen) -> None:
    """Hold depth and heading where the vehicle is, and go on from its velocity."""
    state.takes_over = 0
    for i in range(6):
        state.model[i] = seen.velocity[i]
    state.target[2] = seen.position[2]
    for i in range(3):
        for k in range(3):
            state.heading[i, k] = seen.rotation[i, k]


@njit
def loops(dt: float, autopilot: Record, state: Record, thrusters: Record, seen: Seen) -> Array:
    """Return the thrusts that the velocity, depth, heading and position loops command, (n,) [N].

    The arguments are those of `steer`. What follows depth and heading moves on, and the integral of
    the error, unless thrusters are at their limits.
    """
    wanted, climb = wishes(dt, autopilot, state, seen)
    rotation = seen.rotation
    up = rotation[2, 2]
    # W's z in base axes; of a base whose z points down it is the other way round
    side = 1.0 if up >= 0.0 else -1.0
    x, y, z = side * rotation[2, 0], side * rotation[2, 1], side * rotation[2, 2]
    lean = math.atan2(-x, z)  # about the base's y
    dive = 0.0  # the lean wished for
    if autopilot.drives[4] == 0.0:
        wanted[0] *= min(max((STEEP - abs(lean)) / (STEEP - LEVEL), 0.0), 1.0)
    elif autopilot.drives[2] == 0.0:
        dive = -side * dive_angle(climb, state.wanted[2] * up, seen.velocity[0])
    speeding = (wanted - state.model) / max(autopilot.lag, dt)
    model = state.model
    model += speeding * dt
    error = model - seen.velocity
    a, b, c = seen.velocity[3], seen.velocity[4], seen.velocity[5]
    error[0] -= b * autopilot.reference[2] - c * autopilot.reference[1]
    error[1] -= c * autopilot.reference[0] - a * autopilot.reference[2]
    error[2] -= a * autopilot.reference[1] - b * autopilot.reference[0]
    error[3], error[4] = -a, -b
    before = state.integral.copy()
    integral = state.integral
    integral += error * dt
    integral[3] = integral[4] = 0.0
    for i in range(6):
        if autopilot.drives[i] == 0.0:
            integral[i] = 0.0
    tau = efforts(autopilot, speeding, error, integral, model, seen.velocity)
    tau[3] -= autopilot.mass[3] * autopilot.integral * math.atan2(y, z)
    tau[4] -= autopilot.mass[4] * autopilot.integral * (lean - dive)
    return given(autopilot, thrusters, tau, error, before, integral)


@njit
def wishes(dt: float, autopilot: Record, state: Record, seen: Seen) -> tuple[Array, float]:
    """Return the desired twist in base axes, (6,) [m/s, rad/s], and the desired climb rate [m/s].

    Depth and heading to hold move on as commanded.
    """
    rotation, position = seen.rotation, seen.position
    commanded, target, heading = state.wanted, state.target, state.heading
    wanted = commanded.copy()
    if state.mode == POSITION:
        ahead, aside = 0.0, 0.0  # [m]
        for k in range(3):
            ahead += rotation[k, 0] * (target[k] - position[k])
            aside += rotation[k, 1] * (target[k] - position[k])
        size = autopilot.position * math.hypot(ahead, aside)
        slowed = autopilot.position * min(1.0, MAX_SPEED / max(size, 1e-9))
        wanted[0] += slowed * ahead
        wanted[1] += slowed * aside
    up = rotation[2, 2]  # how much of W's z lies along the base's z: +-1 when level
    target[2] += commanded[2] * up * dt
    climb = autopilot.depth * (target[2] - position[2])
    wanted[2] += min(max(climb, -MAX_CLIMB_RATE), MAX_CLIMB_RATE) * up
    cosine, sine = math.cos(commanded[5] * dt), math.sin(commanded[5] * dt)
    across = along = 0.0  # of the wanted x axis, in the base
    for k in range(3):
        x, y = heading[k, 0], heading[k, 1]
        heading[k, 0], heading[k, 1] = cosine * x + sine * y, cosine * y - sine * x
        along += rotation[k, 0] * heading[k, 0]
        across += rotation[k, 1] * heading[k, 0]
    wanted[5] += autopilot.heading * math.atan2(across, along)
    return wanted, climb


@njit
def dive_angle(climb: float, commanded: float, ahead_speed: float) -> float:
    """Return the pitch that gives a vehicle without heave the desired climb rate [rad]."""
    slope = min(max(climb, -MAX_CLIMB_RATE), MAX_CLIMB_RATE) + commanded
    slope *= ahead_speed / (ahead_speed * ahead_speed + SLOW * SLOW)
    return min(max(slope, -STEEPEST_DIVE), STEEPEST_DIVE)


@njit
def efforts(
    autopilot: Record, speeding: Array, error: Array, integral: Array, model: Array, velocity: Array
) -> Array:
    """Return the force and moment that the velocity loops command, (6,) [N, N m]."""
    tau: Array = autopilot.mass * (
        speeding + autopilot.velocity * error + autopilot.integral * integral
    )
    tau += autopilot.linear * model + autopilot.quadratic * np.abs(model) * model
    u, v, w = velocity[0], velocity[1], velocity[2]
    added = autopilot.added
    tau[3] += (added[2] - added[1]) * v * w  # the Munk moment v x A v, which turns hulls broadside
    tau[4] += (added[0] - added[2]) * w * u
    tau[5] += (added[1] - added[0]) * u * v
    return tau


@njit
def given(
    autopilot: Record, thrusters: Record, tau: Array, error: Array, before: Array, integral: Array
) -> Array:
    """Return the thrusts for a force and moment, (n,) [N], and hold integrals that wind up."""
    for i in range(3):
        held = min(max(tau[i], -autopilot.max_force[i]), autopilot.max_force[i])
        if (tau[i] - held) * error[i] > 0.0:
            integral[i] = before[i]
        tau[i] = held
    asked = shared(autopilot, thrusters, tau)
    forces = within_reach(autopilot, thrusters, tau, asked)
    for i in range(autopilot.n_axes):
        lacking = 0.0  # force or moment beyond the thrusters' limits
        for k in range(len(forces)):
            one = thrusters[k]
            excess = asked[k] - min(max(forces[k], one.min_thrust), one.max_thrust)
            lacking += one.reached[i] * excess
        place = autopilot.axes[i]
        if lacking * error[place] > 0.0:
            integral[place] = before[place]
    return forces


@njit
def within_reach(autopilot: Record, thrusters: Record, tau: Array, asked: Array) -> Array:
    """Return the thrusts with surge and sway reduced to what the other axes leave, (n,) [N].

    Who cannot do all keeps upright first, and depth and heading: a pull that is cut off thruster
    by thruster would turn the vehicle over.
    """
    still = tau.copy()
    still[0] = still[1] = 0.0
    rest = shared(autopilot, thrusters, still)
    part = 1.0
    for k in range(len(rest)):
        way = asked[k] - rest[k]
        end = thrusters[k].max_thrust if way > 0.0 else thrusters[k].min_thrust
        if way != 0.0:
            part = min(part, max((end - rest[k]) / way, 0.0))
    return rest + part * (asked - rest)


@njit
def shared(autopilot: Record, thrusters: Record, tau: Array) -> Array:
    """Return the thrusts that come nearest to a force and moment (6,), beyond limits too, (n,)."""
    forces = np.zeros(len(thrusters))
    for k in range(len(thrusters)):
        for i in range(autopilot.n_axes):
            forces[k] += thrusters[k].share[i] * tau[autopilot.axes[i]]
    return forces


@njit
def nearest(autopilot: Record, state: Record, thrusters: Record) -> Array:
    """Return the thrusts that come nearest to the commanded wrench, beyond limits too, (n,)."""
    forces = np.zeros(len(thrusters))
    for k in range(len(thrusters)):
        for i in range(autopilot.n_asked):
            forces[k] += thrusters[k].nearest[i] * state.wrench[autopilot.asked[i]]
    return forces


@njit
def command(thruster: Record, force: float) -> float:
    """Return a thruster's command for a thrust [N], as far as it reaches [1]."""
    x, y = thruster.thrusts, thruster.commands
    j, end = -1, len(x)  # the last point that is not beyond the force
    while end - j > 1:
        middle = (j + end) // 2
        if x[middle] > force:
            end = middle
        else:
            j = middle
    found: float = y[min(max(j, 0), len(y) - 1)]
    if 0 <= j < len(x) - 1:
        found = y[j] + (y[j + 1] - y[j]) * (force - x[j]) / (x[j + 1] - x[j])
    return found
