r"""The equations of OneOcean's core benchmark, in steps of any length: its own take one second.

In each step of length h, for the position p, the heading psi, the velocity v through the water in
axes of the body, the turn rate r and the current c:

.. math::

    u &= k_p (q - p), \quad |u| \le u_{max} \\
    v &\leftarrow v + h \left( k (R^T u - v) - d v \right) / m, \quad |v| \le u_{max} \\
    r &\leftarrow r + h \left( k_r (r_u - r) - d_r r \right) / J, \quad |r| \le r_{max} \\
    p &\leftarrow p + h (R v + c), \qquad \psi \leftarrow \psi + h r

with the heading's error times 2/s for :math:`r_u`. This is the explicit Euler method. For the
velocity it is stable if :math:`h < 2 m / (k + d)`, 0.92 s, and for the turn rate if
:math:`h < 2 J / (k_r + d_r)`, 0.8 s: see `stable_step`. The equations have no term for the turn of
the axes in which v is, and R turns by :math:`-\psi`, the other way than the heading's error. The
numbers are those of the repository OneOcean-IROS (benchmark_core/env.py, controllers.py), and so
are the limits of the positions: a square of 600 m, and depths from 2 to 18 m. Left out: roll and
pitch, which stay 0, and the bottom, which is far below.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from oneocean_waypoints import SIDE, draw_waypoints

from uwsim.base.geometry import Array
from uwsim.base.rng import stream

MASS, GAIN, DRAG = 12.0, 18.0, 8.0
"""The mass [kg], the gain of the velocity and the drag [N s/m]."""
INERTIA, TURN_GAIN, TURN_DRAG = 6.0, 10.0, 5.0
"""The moment of inertia [kg m2], the gain of the turn rate and its drag [N m s/rad]."""
HEADING_GAIN = 2.0
"""The commanded turn rate for an error of the heading [1/s]."""
MAX_SPEED, MAX_TURN_RATE = 1.2, 1.2
"""The greatest speed through the water [m/s], and turn rate [rad/s]."""
MIN_POSITION, MAX_POSITION = np.array([0.0, 0.0, 2.0]), np.array([SIDE, SIDE, 18.0])
"""The limits of positions, z down [m]."""


@dataclass(frozen=True, kw_only=True)
class Task:
    """A task of the benchmark, in one of its tiers."""

    count: int
    """The number of places."""
    length: float
    """The distance of one place, 0 for the start, or the length of the line of several [m]."""
    radius: float
    """The distance at which a place is reached [m]."""
    duration: float
    """The time of a trial [s]."""
    hold: float = 0.0
    """The time for which a vehicle has to stay at its start, for a success [s]."""
    kp: float = 0.9
    """The gain of the heuristic [1/s]."""

    @property
    def is_station(self) -> bool:
        """True if the vehicle has to stay where it begins."""
        return self.hold > 0.0


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """The outcome of a trial."""

    is_success: bool
    """True if all places were reached, or the vehicle stayed within the radius of its start."""
    error: float
    """The root mean square of the distance from the present place [m]."""


def stable_step() -> tuple[float, float]:
    """Return the steps below which velocity and turn rate are stable [s]."""
    return 2.0 * MASS / (GAIN + DRAG), 2.0 * INERTIA / (TURN_GAIN + TURN_DRAG)


def simulate(task: Task, *, seed: int, current: float, step: float) -> Outcome:
    """Run a trial, whose start, places and direction of the current depend on the seed.

    Args:
        task: the task.
        seed: the seed.
        current: the speed of the water [m/s].
        step: the length of a step [s].
    """
    generator = stream(seed, "oneocean")
    position = generator.uniform(MIN_POSITION, MAX_POSITION)
    places = draw_waypoints(position, generator, count=task.count, length=task.length)
    yaw, direction = generator.uniform(-math.pi, math.pi, size=2)
    water = current * np.array([math.cos(direction), math.sin(direction), 0.0])
    velocity, rate, n_reached, held_time = np.zeros(3), 0.0, 0, 0.0
    squares: list[float] = []
    for _ in range(round(task.duration / step)):
        command = _limit(task.kp * (places[n_reached] - position), MAX_SPEED)
        rotation = _rotation(-yaw)
        velocity = velocity + step / MASS * (
            GAIN * (rotation.T @ command - velocity) - DRAG * velocity
        )
        velocity = _limit(velocity, MAX_SPEED)
        turn = math.remainder(math.atan2(command[1], command[0]) - yaw, 2.0 * math.pi)
        desired_rate = _bound(HEADING_GAIN * turn, MAX_TURN_RATE)
        rate += step / INERTIA * (TURN_GAIN * (desired_rate - rate) - TURN_DRAG * rate)
        rate = _bound(rate, MAX_TURN_RATE)
        position = np.clip(
            position + step * (rotation @ velocity + water), MIN_POSITION, MAX_POSITION
        )
        yaw += step * rate
        distance = math.hypot(*(position - places[n_reached]).tolist())
        squares.append(distance * distance)
        is_near = distance <= task.radius
        held_time = held_time + step if is_near else 0.0
        if is_near and not task.is_station:
            n_reached += 1
        if n_reached == task.count or (task.is_station and held_time > task.hold - step / 2.0):
            return Outcome(is_success=True, error=math.sqrt(math.fsum(squares) / len(squares)))
    return Outcome(is_success=False, error=math.sqrt(math.fsum(squares) / len(squares)))


def _limit(vector: Array, length: float) -> Array:
    """Return the vector, or the one of a length in its direction if it is longer."""
    limited_vector: Array = vector * min(1.0, length / max(math.hypot(*vector.tolist()), 1e-9))
    return limited_vector


def _bound(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)


def _rotation(yaw: float) -> Array:
    """Return the rotation about z from axes of the body, (3, 3)."""
    c, s = math.cos(yaw), math.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
