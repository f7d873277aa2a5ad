"""The errors of a row: its distance from the goal, and the rotation to the goal's attitude."""

from __future__ import annotations

import math

from ...base.numerics.jit import njit_borrowed
from ...base.numerics.memory import Floats
from . import columns as c


@njit_borrowed
def distance(state: Floats, goal: Floats) -> float:
    """Return the distance of the base from the goal [m]."""
    x, y, z = goal[0] - state[0], goal[1] - state[1], goal[2] - state[2]
    return math.sqrt(x * x + y * y + z * z)


@njit_borrowed
def attitude_error(state: Floats, goal: Floats) -> tuple[float, float, float, float]:
    """Return the rotation from the base to the goal's attitude in base axes, as wxyz."""
    k = c.GOAL_ATTITUDE
    a, b, d, e = goal[k], goal[k + 1], goal[k + 2], goal[k + 3]
    w, x, y, z = state[3], -state[4], -state[5], -state[6]  # the inverse of the attitude
    return (
        w * a - x * b - y * d - z * e,
        w * b + x * a + y * e - z * d,
        w * d - x * e + y * a + z * b,
        w * e + x * d - y * b + z * a,
    )


@njit_borrowed
def speed_error(state: Floats, goal: Floats) -> float:
    """Return the speed of the base relative to the goal [m/s]."""
    x, y, z = state[7] - goal[3], state[8] - goal[4], state[9] - goal[5]
    return math.sqrt(x * x + y * y + z * z)
