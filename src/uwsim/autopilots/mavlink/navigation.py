"""Messages of navigation sensors: a DVL, a position, and a distance to the bottom.

Axes are those of the autopilot: forward, starboard, down (FRD) for the body, and north, east, down
(NED) for positions. The definitions are those of MAVLink's ``common.xml`` and ``ardupilotmega.xml``
(https://mavlink.io/en/messages). ArduPilot fuses them as external navigation (``VISO_TYPE`` 1).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length
from .message import Message

LOCAL_FRD, BODY_FRD = 20, 12
"""The numbers of MAV_FRAME_LOCAL_FRD and MAV_FRAME_BODY_FRD."""
ESTIMATOR_EXTERNAL = 3
"""The number of MAV_ESTIMATOR_TYPE_VIO, external navigation."""
LOOKS_DOWN = 25
"""The number of MAV_SENSOR_ROTATION_PITCH_270, a sensor that looks down."""
ULTRASOUND = 1
"""The number of MAV_DISTANCE_SENSOR_ULTRASOUND."""
WORST_ERROR_VELOCITY = 0.4
"""The error velocity of a DVL at which the confidence of a velocity is 0 [m/s]."""
THREE_BEAM_CONFIDENCE = 50.0
"""The confidence of a velocity of three beams, which has no error velocity [%]."""
MAX_CENTIMETRES = 65535
"""The greatest distance of a DISTANCE_SENSOR [cm]."""
_DIAGONAL = (0, 6, 11, 15, 18, 20)
"""The indices of the variances in the upper triangle of a 6 x 6 matrix, row by row."""


def microseconds(time: float) -> int:
    """Return a time in microseconds, for a time in seconds that is not negative."""
    return round(1e6 * max(0.0, time))


def confidence_of(error_velocity: float) -> float:
    """Return the confidence of a velocity of a DVL, 0 to 100 [%].

    It falls linearly with the absolute error velocity, the difference between the two vertical
    velocities that four beams measure, to 0 at `WORST_ERROR_VELOCITY`. A velocity of three beams
    has no error velocity (NaN), and the confidence 50. The rule is ours: MAVLink defines only that
    100 is the best.
    """
    if not math.isfinite(error_velocity):
        return THREE_BEAM_CONFIDENCE
    return 100.0 * max(0.0, 1.0 - abs(error_velocity) / WORST_ERROR_VELOCITY)


def rotation_vector(rotation: Array) -> Array:
    """Return the axis times the angle of a rotation matrix, (3,) [rad]; the angle is below pi."""
    sine_axis = 0.5 * np.array(
        [
            rotation[2, 1] - rotation[1, 2],
            rotation[0, 2] - rotation[2, 0],
            rotation[1, 0] - rotation[0, 1],
        ]
    )
    sine = length(sine_axis)
    cosine = 0.5 * (float(rotation[0, 0] + rotation[1, 1] + rotation[2, 2]) - 1.0)
    angle = math.atan2(sine, cosine)
    return sine_axis * (angle / sine) if sine > 1e-12 else sine_axis


def vision_position_delta(
    time: float, interval: float, *, velocity: Array, turn: Array, confidence: float
) -> Message:
    r"""Return VISION_POSITION_DELTA: the displacement :math:`v \Delta t` since the last ping.

    ArduPilot divides it by the interval again, so that it fuses the velocity of the ping.

    Args:
        time: the time of the ping [s].
        interval: the time :math:`\Delta t` since the ping before [s].
        velocity: the velocity :math:`v` over the bottom in FRD axes, (3,) [m/s].
        turn: the rotation vector of the body since the ping before, in FRD axes, (3,) [rad].
        confidence: 0 to 100 [%].
    """
    fields = {
        "time_usec": microseconds(time),
        "time_delta_usec": microseconds(interval),
        "angle_delta": tuple(map(float, turn)),
        "position_delta": tuple((velocity * interval).tolist()),
        "confidence": confidence,
    }
    return Message("VISION_POSITION_DELTA", fields)


@dataclass(frozen=True, kw_only=True, eq=False)
class NavigationSample:
    """A position, attitude and velocity of a vehicle."""

    time: float
    """The time of the sample [s]."""
    position: Array
    """The position from the origin of the autopilot, north, east, down, (3,) [m]."""
    quaternion: Sequence[float]
    """The orientation of FRD axes in NED axes, w, x, y, z, (4,) [1]."""
    velocity: Array
    """The velocity in FRD axes, (3,) [m/s]."""
    angular_velocity: Array
    """The angular velocity in FRD axes, (3,) [rad/s]."""


def odometry(
    sample: NavigationSample,
    *,
    position_std: float,
    attitude_std: float,
    velocity_std: float,
    reset_counter: int,
) -> Message:
    """Return ODOMETRY, in the frames that ArduPilot accepts: LOCAL_FRD and BODY_FRD.

    Args:
        sample: the measured values.
        position_std: the standard deviation of each component of the position [m].
        attitude_std: the standard deviation of each angle [rad].
        velocity_std: the standard deviation of each component of the velocity [m/s].
        reset_counter: the number of jumps of the position so far.
    """
    x, y, z = sample.position.tolist()
    vx, vy, vz = sample.velocity.tolist()
    roll_rate, pitch_rate, yaw_rate = sample.angular_velocity.tolist()
    fields = {
        "time_usec": microseconds(sample.time),
        "frame_id": LOCAL_FRD,
        "child_frame_id": BODY_FRD,
        **{"x": x, "y": y, "z": z, "q": tuple(map(float, sample.quaternion))},
        **{"vx": vx, "vy": vy, "vz": vz},
        **{"rollspeed": roll_rate, "pitchspeed": pitch_rate, "yawspeed": yaw_rate},
        "pose_covariance": _covariance(position_std**2, attitude_std**2),
        "velocity_covariance": _covariance(velocity_std**2, math.nan),
        "reset_counter": reset_counter % 256,
        "estimator_type": ESTIMATOR_EXTERNAL,
        "quality": 100,
    }
    return Message("ODOMETRY", fields)


def _covariance(linear: float, angular: float) -> tuple[float, ...]:
    """Return the upper triangle of a diagonal covariance; NaN begins one that is unknown."""
    triangle = [0.0] * 21
    for k, index in enumerate(_DIAGONAL):
        triangle[index] = linear if k < 3 else angular
    return tuple(triangle)


def distance_sensor(
    time: float, distance: float, *, minimum: float, maximum: float, beam_width: float
) -> Message:
    """Return DISTANCE_SENSOR of an altimeter that looks down; beyond the maximum if no echo came.

    Args:
        time: the time of the ping [s].
        distance: the measured distance [m]; not finite: no echo.
        minimum: the smallest distance that the sensor measures [m].
        maximum: the greatest distance that the sensor measures [m].
        beam_width: the angle of the cone of the beam [rad].
    """
    has_echo = math.isfinite(distance) and minimum <= distance <= maximum
    centimetres = round(100.0 * distance) if has_echo else round(100.0 * maximum) + 1
    fields = {
        "time_boot_ms": round(1e3 * max(0.0, time)) % 2**32,
        "min_distance": min(round(100.0 * minimum), MAX_CENTIMETRES),
        "max_distance": min(round(100.0 * maximum), MAX_CENTIMETRES - 1),
        "current_distance": min(centimetres, MAX_CENTIMETRES),
        "type": ULTRASOUND,
        "orientation": LOOKS_DOWN,
        "covariance": 255,
        "horizontal_fov": beam_width,
        "vertical_fov": beam_width,
        "signal_quality": 100 if has_echo else 1,
    }
    return Message("DISTANCE_SENSOR", fields)
