"""Attitude, angular velocity and specific force.

.. code-block:: xml

    <imu>
      <name>imu</name> <relativeTo>base_link</relativeTo> <std>0.02</std>
      <u:gyro>
        <u:noiseDensity>5e-4</u:noiseDensity> <u:biasInstability>3e-5</u:biasInstability>
      </u:gyro>
      <u:accelerometer> <u:noiseDensity>6e-4</u:noiseDensity> </u:accelerometer>
    </imu>

The attitude is the sensor's orientation in L, the frame of scene files. The accelerometer measures
:math:`R^T (a - g)`, with the sensor's acceleration a and its rotation R in W, and gravity g. At
rest this is 9.81 m/s2 upwards.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..base.geometry import Array, write_quaternion, write_rotation
from ..base.numerics.draws import STREAM, normal, stream_of
from ..base.numerics.jit import njit
from ..base.numerics.linear import multiply_matrices, rotate_back
from ..base.numerics.memory import carray, pointer, view_doubles
from ..base.record import Record
from ..messages import Imu, Quaternion, Vector3, header
from ..schema import MAX_DISTANCE, element
from ..world import GRAVITY, MovingBody, SensorWorld
from ..world.mounts import MOUNT, read_frame, read_motion
from .drift import DRIFT, Drift, DriftSpec, DriftState, draw_errors
from .sensor import Carrier, CompiledSensor, SensorSpec, create_sampler


@dataclass(frozen=True, kw_only=True)
class ImuSpec(SensorSpec):
    """An ``<imu>``."""

    message_type: ClassVar[type] = Imu

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    std: float = element(default=0.0, minimum=0, maximum=10)
    """The standard deviation of the noise of roll, pitch and yaw [rad]."""
    gyro: DriftSpec = element(namespaced=True, default=DriftSpec())
    """The errors of the measured angular velocity."""
    accelerometer: DriftSpec = element(namespaced=True, default=DriftSpec())
    """The errors of the measured specific force."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> InertialUnit:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        return InertialUnit(self, vehicle.moving_mount(self), world, vehicle.name)


@dataclass(slots=True)
class ImuState(Record):
    """The state of an inertial measurement unit."""

    rng: np.random.Generator
    """The generator of the noise of the attitude."""
    gyro: DriftState
    """The slow errors of the angular velocity [rad/s]."""
    accelerometer: DriftState
    """The slow errors of the specific force [m/s2]."""


SPECIFIC_FORCE_AT_REST = (0.0, 0.0, GRAVITY)
"""The specific force at rest, in W [m/s2]."""
IMU = np.dtype(
    [
        ("mount", MOUNT),
        ("stream", STREAM),  # of the noise of the attitude
        ("std", np.float64),  # of the noise of each angle [rad]
        ("localized_from_world", np.float64, (3, 3)),
        ("measures_motion", np.int64),  # 0: the attitude alone, as the original UWSim
        ("gyro", DRIFT),
        ("accelerometer", DRIFT),
    ]
)
"""The parameters of an inertial measurement unit, for compiled code."""
N_VALUES = 12
"""The number of values of a sample: a quaternion wxyz (4); the angular velocity (3) [rad/s] and the
variance of each component; the specific force (3) [m/s2] and the variance of each component."""


class InertialUnit(CompiledSensor):
    """An inertial measurement unit with attitude."""

    def __init__(self, spec: ImuSpec, mount: MovingBody, world: SensorWorld, vehicle: str) -> None:
        prefix = f"{vehicle}/{spec.name}"
        self._name = spec.name
        gyro = Drift(spec.gyro, world.stream(f"{prefix}/gyro"))
        accelerometer = Drift(spec.accelerometer, world.stream(f"{prefix}/accelerometer"))
        rng = world.stream(f"{prefix}/noise")
        self.state = ImuState(rng, gyro.state, accelerometer.state)
        """The state: the slow errors, and the generators of the noise."""
        self._measures_motion = "imu-orientation" not in world.compatibility
        self._attitude_covariance = _diagonal(spec.std**2)
        row = np.zeros(1, IMU)
        row["mount"], row["stream"], row["std"] = mount.functions, stream_of(rng), spec.std
        row["localized_from_world"] = world.world_from_localized.rotation.T
        row["measures_motion"] = self._measures_motion
        row["gyro"], row["accelerometer"] = gyro.parameters, accelerometer.parameters
        self.sampler = create_sampler(mount, sample_imu, row, N_VALUES, (self.state,))
        """The sampler that takes samples in compiled code."""

    def message(self, time: float, values: Array) -> Imu:
        """Return the message of a sample at ``time`` [s]."""
        w, x, y, z, *motion = values.tolist()
        message = Imu(
            header=header(time, self._name if self._measures_motion else "world"),
            orientation=Quaternion(x=x, y=y, z=z, w=w),
            orientation_covariance=self._attitude_covariance,
        )
        if self._measures_motion:
            message.angular_velocity = Vector3(*motion[:3])
            message.angular_velocity_covariance = _diagonal(motion[3])
            message.linear_acceleration = Vector3(*motion[4:7])
            message.linear_acceleration_covariance = _diagonal(motion[7])
        return message


def sample_imu(parameters: int, values: int, time: float) -> None:
    """Take a sample of an inertial measurement unit; see `uwsim.base.numerics.calls`."""
    imu = carray(pointer(parameters), (1,), IMU)[0]
    measure(imu, time, view_doubles(values, N_VALUES))


@njit
def measure(imu: Any, time: float, values: Array) -> None:
    """Write the values of a sample with their errors; see `N_VALUES`."""
    frame, noise = np.empty(12), np.empty((3, 3))
    read_frame(imu.mount, frame)
    axes = frame[3:].reshape((3, 3))
    roll = imu.std * normal(imu.stream)
    pitch = imu.std * normal(imu.stream)
    yaw = imu.std * normal(imu.stream)
    write_rotation(roll, pitch, yaw, noise)
    localized_from_sensor = multiply_matrices(imu.localized_from_world, axes)
    write_quaternion(multiply_matrices(noise, localized_from_sensor), values[:4])
    if imu.measures_motion == 0:
        return
    motion, errors = np.empty(12), np.empty(3)
    motion[:3] = frame[:3]
    read_motion(imu.mount, motion)
    values[7] = draw_errors(imu.gyro, time, errors)
    values[4:7] = rotate_back(axes, motion[6:9]) + errors
    values[11] = draw_errors(imu.accelerometer, time, errors)
    for i in range(3):
        motion[9 + i] += SPECIFIC_FORCE_AT_REST[i]
    values[8:11] = rotate_back(axes, motion[9:12]) + errors


@functools.lru_cache(maxsize=64)
def _diagonal(variance: float) -> Array:
    """Return the covariance matrix of three equal variances, by rows, (9,); read-only."""
    covariance = np.zeros(9)
    covariance[::4] = variance
    covariance.flags.writeable = False
    return covariance
