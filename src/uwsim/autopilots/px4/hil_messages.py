"""The messages between PX4 and a simulator: values in SI units, and payloads of MAVLink.

=====  =====================  =========  ======================================================
no.    message                direction  content
=====  =====================  =========  ======================================================
107    HIL_SENSOR             to PX4     inertial unit, compass, barometer; advances its clock
113    HIL_GPS                to PX4     position and velocity of a satellite receiver
115    HIL_STATE_QUATERNION   to PX4     the true state, which PX4 logs and does not use
331    ODOMETRY               to PX4     pose and velocity of another navigation system
93     HIL_ACTUATOR_CONTROLS  from PX4   16 outputs, and the time of HIL_SENSOR that they answer
0, 76  HEARTBEAT,             from PX4   sent when PX4 connects; read and not used
       COMMAND_LONG
=====  =====================  =========  ======================================================

Vectors of the body are in FRD axes (x forward, y to starboard, z down), those of the Earth in NED.
Layouts and units: MAVLink, ``common.xml``. The meaning of ``fields_updated`` and of the lock-step
flag: PX4, module ``simulator_mavlink``.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Protocol

from .frames import MessageFormat

HEARTBEAT, COMMAND_LONG, HIL_ACTUATOR_CONTROLS = 0, 76, 93
"""The numbers of the messages that PX4 sends to a simulator."""
RECEIVED_FORMATS = {
    HEARTBEAT: MessageFormat(crc_extra=50, size=9),
    COMMAND_LONG: MessageFormat(crc_extra=152, size=33),
    HIL_ACTUATOR_CONTROLS: MessageFormat(crc_extra=47, size=81),
}
"""The format of each message that PX4 sends."""
ACTUATOR_CHANNELS = 16
"""The number of outputs in a message of PX4."""
CONTROLS = struct.Struct("<QQ16fB")
"""The payload of HIL_ACTUATOR_CONTROLS: time, flags, 16 controls, mode."""
LOCK_STEP = 1
"""The flag of a PX4 that waits for the simulator's clock."""
ARMED_BIT = 128
"""The bit of the mode of an armed vehicle."""
ALL_FIELDS = 0b1101111111111
"""The fields of HIL_SENSOR that are measured: bits 0 to 12 without 10, differential pressure."""
STANDARD_GRAVITY = 9.80665
"""The unit of accelerations in HIL_STATE_QUATERNION [m/s2]."""
FIX_3D = 3
"""The fix type of a position in three dimensions."""
LOCAL_NED, BODY_FRD = 1, 12
"""The frames of an odometry: of position and attitude, and of the velocities."""
VISION = 2
"""The type of the estimator of an odometry: MAV_ESTIMATOR_TYPE_VISION, which PX4 accepts."""

Vector = Sequence[float]
"""A vector of three numbers."""


class HilMessage(Protocol):
    """A message to PX4."""

    message: ClassVar[int]
    """The number of the message."""
    crc_extra: ClassVar[int]
    """The byte of the message's definition that the checksum includes."""

    def payload(self) -> bytes:
        """Return the payload of the message."""


@dataclass(frozen=True, kw_only=True)
class SensorReadings:
    """The readings of the sensors on PX4's board at one time."""

    message: ClassVar[int] = 107
    crc_extra: ClassVar[int] = 108

    time_usec: int
    """The time on PX4's clock [us]."""
    specific_force: Vector
    """The specific force, (0, 0, -9.81) at rest on even keel, (3,) [m/s2]."""
    angular_velocity: Vector
    """The angular velocity of the body, (3,) [rad/s]."""
    magnetic_field: Vector
    """The magnetic flux density, (3,) [T]."""
    pressure: float
    """The pressure at the barometer [Pa]."""
    altitude: float
    """The altitude of this pressure in the standard atmosphere [m]."""
    temperature: float
    """The temperature of the barometer [degC]."""

    def payload(self) -> bytes:
        """Return the payload of HIL_SENSOR, for the sensors number 0."""
        return struct.pack(
            "<Q13fIB",
            self.time_usec,
            *self.specific_force,
            *self.angular_velocity,
            *(1e4 * component for component in self.magnetic_field),  # gauss
            0.01 * self.pressure,  # hPa
            0.0,
            self.altitude,
            self.temperature,
            ALL_FIELDS,
            0,
        )


@dataclass(frozen=True, kw_only=True)
class SatelliteFix:
    """A position and a velocity of a satellite receiver."""

    message: ClassVar[int] = 113
    crc_extra: ClassVar[int] = 124

    time_usec: int
    """The time on PX4's clock [us]."""
    latitude: float
    """The latitude [rad]."""
    longitude: float
    """The longitude [rad]."""
    altitude: float
    """The altitude [m]."""
    velocity: Vector
    """The velocity over ground, north, east, down, (3,) [m/s]."""
    horizontal_accuracy: float
    """The standard deviation of the horizontal position [m]."""
    vertical_accuracy: float
    """The standard deviation of the altitude [m]."""

    def payload(self) -> bytes:
        """Return the payload of HIL_GPS, for the receiver number 0 without a heading."""
        north, east, _ = self.velocity
        speed = math.hypot(north, east)
        course = math.degrees(math.atan2(east, north)) % 360.0
        return struct.pack(
            "<QiiiHHHhhhHBBBH",
            self.time_usec,
            *_geodetic(self.latitude, self.longitude, self.altitude),
            _limit(100.0 * self.horizontal_accuracy, 0, 65535),
            _limit(100.0 * self.vertical_accuracy, 0, 65535),
            _limit(100.0 * speed, 0, 65534),
            *(_limit(100.0 * component, -32768, 32767) for component in self.velocity),
            _limit(100.0 * course, 0, 35999),
            FIX_3D,
            10,  # satellites
            0,
            0,
        )


@dataclass(frozen=True, kw_only=True)
class TrueState:
    """The true state of the vehicle."""

    message: ClassVar[int] = 115
    crc_extra: ClassVar[int] = 4

    time_usec: int
    """The time on PX4's clock [us]."""
    quaternion: Sequence[float]
    """The attitude of the body in NED, wxyz, (4,) [1]."""
    angular_velocity: Vector
    """The angular velocity of the body, (3,) [rad/s]."""
    latitude: float
    """The latitude [rad]."""
    longitude: float
    """The longitude [rad]."""
    altitude: float
    """The altitude [m]."""
    velocity: Vector
    """The velocity over ground, north, east, down, (3,) [m/s]."""
    specific_force: Vector
    """The specific force, (3,) [m/s2]."""

    def payload(self) -> bytes:
        """Return the payload of HIL_STATE_QUATERNION, with air speeds of 0."""
        milli = 1000.0 / STANDARD_GRAVITY
        return struct.pack(
            "<Q7f3i3h2H3h",
            self.time_usec,
            *self.quaternion,
            *self.angular_velocity,
            *_geodetic(self.latitude, self.longitude, self.altitude),
            *(_limit(100.0 * component, -32768, 32767) for component in self.velocity),
            0,
            0,
            *(_limit(milli * component, -32768, 32767) for component in self.specific_force),
        )


@dataclass(frozen=True, kw_only=True)
class Odometry:
    """A pose and a velocity of another navigation system, such as one with a DVL."""

    message: ClassVar[int] = 331
    crc_extra: ClassVar[int] = 91

    time_usec: int
    """The time on PX4's clock [us]."""
    position: Vector
    """The position in NED, (3,) [m]."""
    quaternion: Sequence[float]
    """The attitude of the body in NED, wxyz, (4,) [1]."""
    velocity: Vector
    """The velocity over ground in body axes, (3,) [m/s]."""
    angular_velocity: Vector
    """The angular velocity of the body, (3,) [rad/s]."""
    position_variance: float
    """The variance of each coordinate [m2]."""
    attitude_variance: float
    """The variance of each angle [rad2]."""
    velocity_variance: float
    """The variance of each component of the velocity [m2/s2]."""

    def payload(self) -> bytes:
        """Return the payload of ODOMETRY."""
        pose = _diagonal((self.position_variance,) * 3 + (self.attitude_variance,) * 3)
        twist = _diagonal((self.velocity_variance,) * 3 + (math.nan,) * 3)
        return struct.pack(
            "<Q13f21f21f4Bb",
            self.time_usec,
            *self.position,
            *self.quaternion,
            *self.velocity,
            *self.angular_velocity,
            *pose,
            *twist,
            LOCAL_NED,
            BODY_FRD,
            0,
            VISION,
            100,
        )


@dataclass(frozen=True, kw_only=True)
class ActuatorControls:
    """The outputs of PX4 at one time."""

    time_usec: int
    """The time on PX4's clock, that of the last HIL_SENSOR [us]."""
    controls: tuple[float, ...]
    """The outputs, from 0 to 1 for motors of one direction, else from -1 to 1, (16,) [1]."""
    is_armed: bool
    """True if the vehicle is armed; otherwise all outputs are 0."""
    is_lock_step: bool
    """True if PX4 waits for the simulator's clock."""


def decode_actuator_controls(payload: bytes) -> ActuatorControls | None:
    """Return the values of HIL_ACTUATOR_CONTROLS; None if they are not finite or out of range.

    Args:
        payload: the payload, of at most 81 bytes; missing bytes at its end are zeros.
    """
    if len(payload) > CONTROLS.size:
        return None
    time_usec, flags, *controls, mode = CONTROLS.unpack(payload.ljust(CONTROLS.size, b"\0"))
    if not all(math.isfinite(control) and abs(control) <= 1.5 for control in controls):
        return None
    return ActuatorControls(
        time_usec=time_usec,
        controls=tuple(min(1.0, max(-1.0, control)) for control in controls),
        is_armed=bool(mode & ARMED_BIT),
        is_lock_step=bool(flags & LOCK_STEP),
    )


def _geodetic(latitude: float, longitude: float, altitude: float) -> tuple[int, int, int]:
    """Return latitude and longitude [1e-7 deg] and altitude [mm], rounded."""
    return (
        round(1e7 * math.degrees(latitude)),
        round(1e7 * math.degrees(longitude)),
        _limit(1000.0 * altitude, -(2**31), 2**31 - 1),
    )


def _limit(value: float, minimum: int, maximum: int) -> int:
    """Return a value rounded, and limited to the range of its field."""
    return min(maximum, max(minimum, round(value)))


def _diagonal(variances: Sequence[float]) -> list[float]:
    """Return the upper triangle of a diagonal matrix by rows, (21,)."""
    values = [0.0] * 21
    for row, index in enumerate((0, 6, 11, 15, 18, 20)):
        values[index] = variances[row]
    return values
