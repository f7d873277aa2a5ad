"""A small autopilot for the stub: it holds a place, or drives along a path, with servo outputs.

It reads the position, the quaternion and the velocities of an answer, as ArduSub's estimator would
supply them, and writes the pulse widths of the eight motors of ArduSub's frame vectored_6dof.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from tests.support.ardupilot_stub import NEUTRAL_WIDTHS, State

MOTORS = (
    # roll, pitch, yaw, throttle (up), forward, lateral (starboard)
    (0.0, 0.0, 1.0, 0.0, -1.0, 1.0),
    (0.0, 0.0, -1.0, 0.0, -1.0, -1.0),
    (0.0, 0.0, -1.0, 0.0, 1.0, 1.0),
    (0.0, 0.0, 1.0, 0.0, 1.0, -1.0),
    (1.0, -1.0, 0.0, -1.0, 0.0, 0.0),
    (-1.0, -1.0, 0.0, -1.0, 0.0, 0.0),
    (1.0, 1.0, 0.0, -1.0, 0.0, 0.0),
    (-1.0, 1.0, 0.0, -1.0, 0.0, 0.0),
)
"""The factors of the motors of vectored_6dof."""
Target = Callable[[float], Sequence[float]]
KP, KI, KD = 3.0, 0.6, 2.0
DELTA = 0.01
"""The time for the velocity of a target [s]."""


def hold(position: Sequence[float]) -> Target:
    return lambda time: position


def square_path(side: float, depth: float, speed: float) -> Target:
    """Return the place on a square that is driven again and again, from the first call on."""
    corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]

    def place(time: float) -> Sequence[float]:
        way = (speed * time) % (4.0 * side)
        leg, part = int(way // side), (way % side) / side
        (x0, y0), (x1, y1) = corners[leg], corners[(leg + 1) % 4]
        return (x0 + part * (x1 - x0), y0 + part * (y1 - y0), depth)

    return place


def rotation(quaternion: Sequence[float]) -> tuple[tuple[float, float, float], ...]:
    """Return the rotation matrix of a quaternion w, x, y, z."""
    w, x, y, z = quaternion
    return (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )


@dataclass
class PidAutopilot:
    """A proportional, integral and derivative controller of position and heading."""

    target: Target
    integral: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    last_time: float = 0.0

    def __call__(self, state: State) -> list[int]:
        if not state:
            return NEUTRAL_WIDTHS
        (time,) = state["timestamp"]
        if time < self.last_time:  # the physics was reset
            self.integral, self.last_time = [0.0, 0.0, 0.0], 0.0
        step, self.last_time = time - self.last_time, time
        axes_in_ned = rotation(state["quaternion"])
        roll = math.atan2(axes_in_ned[2][1], axes_in_ned[2][2])
        pitch = -math.asin(max(-1.0, min(1.0, axes_in_ned[2][0])))
        yaw = math.atan2(axes_in_ned[1][0], axes_in_ned[0][0])
        demands = []
        for i, (goal, next_goal) in enumerate(
            zip(self.target(time), self.target(time + DELTA), strict=True)
        ):
            error, speed = goal - state["position"][i], (next_goal - goal) / DELTA
            self.integral[i] = min(1.0, max(-1.0, self.integral[i] + KI * error * step))
            demands.append(KP * error + self.integral[i] + KD * (speed - state["velocity"][i]))
        surge, sway, down = (
            sum(axes_in_ned[row][column] * demands[row] for row in range(3)) for column in range(3)
        )
        gyro = state["imu.gyro"]
        axes = (
            -0.8 * roll - 0.3 * gyro[0], -0.8 * pitch - 0.3 * gyro[1], -0.6 * yaw - 0.3 * gyro[2],
            -down, surge, sway,
        )  # fmt: skip
        return [
            1500 + round(400.0 * min(1.0, max(-1.0, sum(map(float.__mul__, motor, axes)))))
            for motor in MOTORS
        ]
