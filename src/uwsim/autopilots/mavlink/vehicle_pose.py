"""Poses of a vehicle in MAVLink messages: ODOMETRY, or LOCAL_POSITION_NED with ATTITUDE.

Positions are north, east, down of the autopilot's local origin; attitudes are of the body axes
forward, right, down. A LOCAL_POSITION_NED is joined with the newest attitude, if their times differ
by at most `MAX_ATTITUDE_AGE`. Messages of all systems are read: give each vehicle its own port.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from ...base.geometry import quaternion_from_rotation, rotation_from_rpy
from ...base.record import Record
from .codec import Codec
from .message import Message
from .stream import MessageReader, ReaderState

MAX_ATTITUDE_AGE = 0.5
"""The greatest difference of the times of a position and its attitude [s]."""
MAX_ANGLE = 4.0 * math.pi
"""The greatest angle of an attitude [rad]."""
MAX_RATE = 1e3
"""The greatest angular velocity [rad/s]."""
MAX_COORDINATE = 1e6
"""The greatest coordinate of a position [m]."""
FRAMES = (1, 20)
"""The values of MAV_FRAME that are read: MAV_FRAME_LOCAL_NED, MAV_FRAME_LOCAL_FRD."""


@dataclass(frozen=True, kw_only=True)
class MavlinkPose:
    """A pose of a vehicle."""

    time: float
    """The time of the measurement since the autopilot's start [s]."""
    position: tuple[float, ...]
    """The position north, east, down, (3,) [m]."""
    quaternion: tuple[float, ...]
    """The attitude of the body, w, x, y, z."""
    twist: tuple[float, ...]
    """The linear and angular velocity in body axes, (6,) [m/s, rad/s]; empty: unknown."""


@dataclass(slots=True)
class PoseReaderState(Record):
    """The state of a reader of poses."""

    stream: ReaderState
    """The bytes that wait, and the counters."""
    attitude: tuple[float, ...] = field(default=())
    """The newest attitude: its time [s], roll, pitch, yaw [rad] and their rates in body axes
    [rad/s]; empty before the first."""


class PoseReader:
    """A reader of the poses in datagrams of MAVLink 1 and 2.

    Raises:
        MissingExtra: pymavlink is not installed.
    """

    def __init__(self) -> None:
        self._reader = MessageReader(Codec())
        self.state = PoseReaderState(self._reader.state)
        """The bytes that wait, and the newest attitude."""

    def read(self, datagrams: Sequence[bytes]) -> list[MavlinkPose | None]:
        """Return the poses in datagrams, in order; None for each pose that is not finite."""
        poses: list[MavlinkPose | None] = []
        for message in self._reader.read(b"".join(datagrams)):
            if message.name == "ODOMETRY":
                poses.append(_read_odometry(message))
            elif message.name == "ATTITUDE" and not self._store_attitude(message):
                poses.append(None)
            elif message.name == "LOCAL_POSITION_NED" and self._has_attitude(message):
                poses.append(_join(message, self.state.attitude))
        return poses

    def _store_attitude(self, message: Message) -> bool:
        """Store an attitude; return False if it is not finite."""
        angles = _read_numbers(message, "roll pitch yaw", MAX_ANGLE)
        rates = _read_numbers(message, "rollspeed pitchspeed yawspeed", MAX_RATE)
        is_valid = bool(angles and rates)
        self.state.attitude = (_read_time(message), *angles, *rates) if is_valid else ()
        return is_valid

    def _has_attitude(self, message: Message) -> bool:
        attitude = self.state.attitude
        return bool(attitude) and abs(_read_time(message) - attitude[0]) <= MAX_ATTITUDE_AGE


def _join(message: Message, attitude: Sequence[float]) -> MavlinkPose | None:
    position = _read_numbers(message, "x y z", MAX_COORDINATE)
    velocity = _read_numbers(message, "vx vy vz", MAX_COORDINATE)
    if not position or not velocity:
        return None
    rotation = rotation_from_rpy(*attitude[1:4])
    body_velocity = (
        sum(float(rotation[row, column]) * velocity[row] for row in range(3)) for column in range(3)
    )
    return MavlinkPose(
        time=_read_time(message),
        position=position,
        quaternion=tuple(quaternion_from_rotation(rotation).tolist()),
        twist=(*body_velocity, *attitude[4:]),
    )


def _read_odometry(message: Message) -> MavlinkPose | None:
    position = _read_numbers(message, "x y z", MAX_COORDINATE)
    linear = _read_numbers(message, "vx vy vz", MAX_COORDINATE)
    angular = _read_numbers(message, "rollspeed pitchspeed yawspeed", MAX_RATE)
    quaternion = tuple(message.fields.get("q", ()))
    is_valid = len(quaternion) == 4 and _is_bounded(quaternion, 2.0) and any(quaternion)
    if not position or not is_valid or message.integer("frame_id") not in FRAMES:
        return None
    return MavlinkPose(
        time=1e-6 * message.number("time_usec"),
        position=position,
        quaternion=quaternion,
        twist=(*linear, *angular) if linear and angular else (),
    )


def _read_time(message: Message) -> float:
    return 1e-3 * message.number("time_boot_ms")


def _read_numbers(message: Message, names: str, limit: float) -> tuple[float, ...]:
    """Return fields as numbers; empty if one is not finite or beyond the limit."""
    numbers = tuple(message.fields.get(name, math.nan) for name in names.split())
    return tuple(map(float, numbers)) if _is_bounded(numbers, limit) else ()


def _is_bounded(numbers: Sequence[float], limit: float) -> bool:
    return all(math.isfinite(number) and abs(number) <= limit for number in numbers)
