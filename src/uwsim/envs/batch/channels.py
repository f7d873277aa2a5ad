"""The observations of a row: a table of channels, interpreted by compiled code."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ...base.numerics.jit import njit_borrowed
from ...base.numerics.memory import Floats
from ...physics.hydrodynamics.kernel import free_step as s
from ...physics.hydrodynamics.kernel.equations import to_body
from . import columns as c
from .errors import attitude_error
from .trajectories import fill_goal

Singles = npt.NDArray[np.float32]


class Situation(NamedTuple):
    """The numbers of one row that observations and rewards read."""

    state: Floats
    """The row of the state (`free_step`), (13 + k,)."""
    axes: Floats
    """The rotation ``world_from_base`` by rows, (9,)."""
    goal: Floats
    """The goal at the present time (`columns`), (10,)."""
    origin: Floats
    """The row of the origin (`columns`), (5,)."""
    action: Floats
    """The last action, (a,)."""
    water: Floats
    """The velocity of the water in W, (3,) [m/s]."""
    scratch: Floats
    """The memory for another goal, (10,)."""


@njit_borrowed
def observe(
    channels: Floats, trajectory: Floats, row: Situation, time: float, out: Singles
) -> None:
    """Write the observation of a row.

    Args:
        channels: the table of channels (`columns`), (c, 4).
        trajectory: the row of the trajectory.
        row: the numbers of the row.
        time: the time since the beginning of the episode [s].
        out: receives the observation, (numbers of all channels,).
    """
    state, goal = row.state, row.goal
    for i in range(len(channels)):
        code, k = channels[i, c.CHANNEL], int(channels[i, c.OFFSET])
        is_base = channels[i, c.AXES] == c.BASE
        if code == c.POSITION_ERROR or code == c.GOAL_VELOCITY:
            if channels[i, c.LEAD_TIME] != 0.0:
                goal = row.scratch
                fill_goal(trajectory, row.origin, time + channels[i, c.LEAD_TIME], goal)
            if code == c.POSITION_ERROR:
                x, y, z = goal[0] - state[0], goal[1] - state[1], goal[2] - state[2]
            else:
                x, y, z = goal[3], goal[4], goal[5]
            goal = row.goal
            _write_vector(row.axes, is_base, x, y, z, out, k)
        elif code == c.LINEAR_VELOCITY:
            _write_vector(row.axes, is_base, state[7], state[8], state[9], out, k)
        elif code == c.RELATIVE_VELOCITY:
            x, y, z = state[7] - row.water[0], state[8] - row.water[1], state[9] - row.water[2]
            _write_vector(row.axes, is_base, x, y, z, out, k)
        elif code == c.CURRENT:
            _write_vector(row.axes, is_base, row.water[0], row.water[1], row.water[2], out, k)
        elif code == c.ATTITUDE_ERROR or code == c.QUATERNION:
            _write_attitude(state, goal, code == c.QUATERNION, out, k)
        else:
            _write_numbers(code, row, time, out, k)


@njit_borrowed
def _write_numbers(code: float, row: Situation, time: float, out: Singles, k: int) -> None:
    """Write the numbers of a channel that are in the row already."""
    state = row.state
    if code == c.ANGULAR_VELOCITY:
        for j in range(3):
            out[k + j] = state[s.ANGULAR_VELOCITY + j]
    elif code == c.POSITION:
        for j in range(3):
            out[k + j] = state[j]
    elif code == c.ROTATION:
        for j in range(9):
            out[k + j] = row.axes[j]
    elif code == c.LAST_ACTION:
        for j in range(len(row.action)):
            out[k + j] = row.action[j]
    elif code == c.ACTUATORS:
        for j in range(len(state) - s.ACTUATORS):
            out[k + j] = state[s.ACTUATORS + j]
    else:
        out[k] = time


@njit_borrowed
def _write_vector(
    axes: Floats, is_base: bool, x: float, y: float, z: float, out: Singles, k: int
) -> None:
    """Write a vector of W, in world or base axes."""
    if is_base:
        x, y, z = to_body(axes, x, y, z)
    out[k], out[k + 1], out[k + 2] = x, y, z


@njit_borrowed
def _write_attitude(state: Floats, goal: Floats, is_absolute: bool, out: Singles, k: int) -> None:
    """Write the attitude, or the rotation from the base to the goal, with w >= 0."""
    if is_absolute:
        w, x, y, z = state[3], state[4], state[5], state[6]
    else:
        w, x, y, z = attitude_error(state, goal)
    sign = 1.0 if w >= 0.0 else -1.0
    out[k], out[k + 1], out[k + 2], out[k + 3] = sign * w, sign * x, sign * y, sign * z
