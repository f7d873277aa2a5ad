"""The reward of a row in a step: a table of weighted terms, interpreted by compiled code."""

from __future__ import annotations

import math

from ...base.numerics.jit import njit_borrowed
from ...base.numerics.memory import Floats
from . import columns as c
from .errors import attitude_error, speed_error


@njit_borrowed
def reward_of(
    terms: Floats,
    state: Floats,
    goal: Floats,
    error: float,
    actions: tuple[float, float],
    has_succeeded: bool,
    has_left: bool,
) -> float:
    """Return the sum of the weighted terms of a reward.

    Args:
        terms: the table of terms (`columns`), (m, 3).
        state: the row of the state after the step.
        goal: the goal at the same time.
        error: the distance from the goal [m].
        actions: the mean squares of the actions, and of their changes in this step.
        has_succeeded: true in the step in which the row succeeds.
        has_left: true in the step in which the row leaves the region of the task.
    """
    total = 0.0
    for i in range(len(terms)):
        code, scale, value = terms[i, c.TERM], terms[i, c.SCALE], 1.0
        if code == c.DISTANCE:
            value = error / scale
        elif code == c.CAPPED_DISTANCE:
            value = min(error / scale, 1.0)
        elif code == c.SQUARED_DISTANCE:
            value = (error / scale) * (error / scale)
        elif code == c.CLOSENESS:
            value = 1.0 / (1.0 + (error / scale) * (error / scale))
        elif code == c.ATTITUDE:
            _, x, y, z = attitude_error(state, goal)
            value = 2.0 * math.sqrt(x * x + y * y + z * z) / scale
        elif code == c.SPEED_ERROR:
            value = speed_error(state, goal) / scale
        elif code == c.EFFORT:
            value = actions[0]
        elif code == c.CHANGE:
            value = actions[1]
        elif code == c.SUCCESS:
            value = 1.0 if has_succeeded else 0.0
        elif code == c.EXIT:
            value = 1.0 if has_left else 0.0
        total += terms[i, c.WEIGHT] * value
    return total
