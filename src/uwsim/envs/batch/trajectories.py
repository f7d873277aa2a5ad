r"""The goal of a row as a function of time: a point to hold, a circle, a helix, a lemniscate.

With the phase :math:`\theta = \theta_0 + \omega t` and the radius R, in axes that are turned by the
heading of the row about its centre:

.. math:: \text{circle, helix: } (R\cos\theta,\; R\sin\theta,\; c\,t), \qquad
          \text{lemniscate of Gerono: } (R\cos\theta,\; R\sin\theta\cos\theta,\; 0)

with the speed c upwards, which is 0 on a circle. The goal is level. Its heading is that of the row,
or of the goal's motion.
"""

from __future__ import annotations

import math

from ...base.numerics.jit import njit_borrowed
from ...base.numerics.memory import Floats
from . import columns as c


@njit_borrowed
def fill_goal(trajectory: Floats, origin: Floats, time: float, goal: Floats) -> None:
    """Compute the goal of a row at a time.

    Args:
        trajectory: the row of the trajectory (`columns`), (9,).
        origin: the row of the origin, (5,).
        time: the time since the beginning of the episode [s].
        goal: receives position [m], velocity [m/s] and attitude (wxyz) in W, (10,).
    """
    x, y, z, u, v, w = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    kind, yaw = trajectory[c.KIND], origin[c.YAW]
    if kind != c.HOLD:
        radius, rate = trajectory[c.RADIUS], trajectory[c.RATE]
        angle = origin[c.PHASE] + rate * time
        sine, cosine = math.sin(angle), math.cos(angle)
        x, u = radius * cosine, -radius * rate * sine
        if kind == c.LEMNISCATE:
            y, v = radius * sine * cosine, radius * rate * (cosine * cosine - sine * sine)
        else:
            y, v = radius * sine, radius * rate * cosine
        if kind == c.HELIX:
            z, w = trajectory[c.CLIMB] * time, trajectory[c.CLIMB]
    sine, cosine = math.sin(yaw), math.cos(yaw)
    goal[c.GOAL_POSITION] = origin[0] + cosine * x - sine * y
    goal[c.GOAL_POSITION + 1] = origin[1] + sine * x + cosine * y
    goal[c.GOAL_POSITION + 2] = origin[2] + z
    goal[c.GOAL_SPEED] = cosine * u - sine * v
    goal[c.GOAL_SPEED + 1] = sine * u + cosine * v
    goal[c.GOAL_SPEED + 2] = w
    if trajectory[c.FACES_ALONG] != 0.0 and (u != 0.0 or v != 0.0):
        yaw += math.atan2(v, u)
    turn_level(trajectory, yaw, goal)


@njit_borrowed
def turn_level(trajectory: Floats, yaw: float, goal: Floats) -> None:
    """Write the attitude of a level base with a heading [rad] to a goal."""
    n, m = math.cos(0.5 * yaw), math.sin(0.5 * yaw)
    k = c.LEVEL
    w, x, y, z = trajectory[k], trajectory[k + 1], trajectory[k + 2], trajectory[k + 3]
    k = c.GOAL_ATTITUDE
    goal[k], goal[k + 1] = n * w - m * z, n * x - m * y
    goal[k + 2], goal[k + 3] = n * y + m * x, n * z + m * w
