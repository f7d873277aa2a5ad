r"""A PID controller of position by forces, with published gains for a BlueROV2.

.. math:: F = K_p e + K_d (r - v) + K_i \int e \, dt

along the axes of the first heading, for the distance e from the place, whose velocity is r, and the
velocity v of the vehicle. The integral counts errors below 0.5 m. The forces are within limits, and
roll and pitch are left to buoyancy. The gains are those of the comparison in docs/reproductions.md
at its date (2026-06-30), as its repository states them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from uwsim.algorithms.control.observation_controller import ObservationReader
from uwsim.base.geometry import Array
from uwsim.bus import Node
from uwsim.messages import Vector3, Wrench, WrenchStamped, header

KP = np.array([6.0, 12.0, 20.0])
"""The gains of the distance [N/m]."""
KD = np.array([8.0, 12.0, 22.0])
"""The gains of the velocity [N s/m]."""
KI = np.array([1.0, 1.5, 1.2])
"""The gains of the integral [N/(m s)]."""
INTEGRAL_LIMIT = np.array([4.0, 5.0, 5.0])
"""The greatest forces of the integral [N]."""
FORCE_LIMIT = np.array([6.0, 30.0, 30.0])
"""The greatest forces along the axes of the vehicle [N]."""
INTEGRAL_RANGE = 0.5
"""The greatest error that the integral counts [m]."""
YAW_KP, YAW_KD = 5.0, 3.0
"""The gains of the heading [N m/rad, N m s/rad]."""
TURN_RATE = math.radians(60.0)
"""The greatest rate at which the heading follows the path [rad/s]."""


class PublishedPid(ObservationReader):
    """A PID controller of position by forces."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "follows": 0.0,
        "weight": 0.98,
        "wrench_topic": "/bluerov2/wrench",
    }
    """``follows`` is 1 to turn into the direction of travel, and 0 to keep the first heading;
    ``weight`` is that in water [N]."""
    CHANNELS: ClassVar[tuple[str, ...]] = (
        "positionError", "referenceVelocity", "linearVelocity", "angularVelocity", "gravity",
        "heading",
    )  # fmt: skip
    """The parts of the observation that are needed."""

    def __init__(self) -> None:
        super().__init__()
        self._integral = np.zeros(3)  # along the axes of the first heading [m s]
        self._first_yaw: float | None = None  # [rad]
        self._desired_yaw = 0.0  # [rad]

    def _open_topic(self, node: Node) -> None:
        self._publish = node.publisher(str(self._parameters["wrench_topic"]), WrenchStamped)

    def _act(self, parts: Mapping[str, Array], dt: float) -> None:
        yaw = math.atan2(parts["heading"][1], parts["heading"][0])
        if self._first_yaw is None:
            self._first_yaw = self._desired_yaw = yaw
        first_from_body = rotation(yaw - self._first_yaw)
        error = first_from_body @ parts["positionError"]
        speed_error = first_from_body @ (parts["referenceVelocity"] - parts["linearVelocity"])
        counted_error = np.where(np.abs(error) < INTEGRAL_RANGE, error, 0.0)
        limit = INTEGRAL_LIMIT / KI
        self._integral = np.clip(self._integral + dt * counted_error, -limit, limit)
        force = KP * error + KD * speed_error + KI * self._integral
        force = first_from_body.T @ force - self._number("weight") * parts["gravity"]
        x, y, z = np.clip(force, -FORCE_LIMIT, FORCE_LIMIT).tolist()
        torque = Vector3(x=0.0, y=0.0, z=self._torque(parts, yaw, dt))
        wrench = Wrench(force=Vector3(x=x, y=y, z=z), torque=torque)
        self._publish(WrenchStamped(header=header(self._node.now), wrench=wrench))

    def _torque(self, parts: Mapping[str, Array], yaw: float, dt: float) -> float:
        """Return the torque about the z axis [N m]."""
        rate, (vx, vy, _) = 0.0, parts["referenceVelocity"].tolist()
        if self._number("follows") and math.hypot(vx, vy) > 0.0 and dt > 0.0:
            turn = math.remainder(yaw + math.atan2(vy, vx) - self._desired_yaw, 2.0 * math.pi)
            rate = max(-TURN_RATE, min(TURN_RATE, turn / dt))
            self._desired_yaw += rate * dt
        error = math.remainder(self._desired_yaw - yaw, 2.0 * math.pi)
        return YAW_KP * error + YAW_KD * (rate - float(parts["angularVelocity"][2]))


def rotation(angle: float) -> Array:
    """Return the rotation about z by an angle [rad], (3, 3)."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
