"""Attitude, angular velocity and specific force.

.. code-block:: xml

    <imu>
      <name>imu</name> <relativeTo>base_link</relativeTo> <std>0.02</std>
      <u:gyro>
        <u:noiseDensity>5e-4</u:noiseDensity> <u:biasInstability>3e-5</u:biasInstability>
      </u:gyro>
      <u:accelerometer> <u:noiseDensity>6e-4</u:noiseDensity> </u:accelerometer>
    </imu>

The attitude is that of the sensor in L, the frame of the file. What the accelerometer measures is
:math:`R^T (a - g)`, with the acceleration a of its own place: at rest 9.81 m/s2 upwards.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.geometry import Array, quaternion_from_rotation, rotation_from_rpy
from ..base.numerics.linear import product, turned_back
from ..base.record import Record
from ..messages import Imu, Quaternion, Vector3, header
from ..schema import MAX_DISTANCE, element
from ..world import GRAVITY, MovingBody, SensorWorld
from .drift import Drift, DriftSpec, DriftState
from .sensor import Carrier, SensorSpec

UP = np.array([0.0, 0.0, GRAVITY])
"""What an accelerometer at rest measures, in W [m/s2]."""


@dataclass(frozen=True, kw_only=True)
class ImuSpec(SensorSpec):
    """An ``<imu>``."""

    message_type: ClassVar[type] = Imu

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Of the sensor in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    std: float = element(default=0.0, minimum=0, maximum=10)
    """Noise of each angle, standard deviation [rad]."""
    gyro: DriftSpec = element(namespaced=True, default=DriftSpec())
    """Errors of the angular velocity."""
    accelerometer: DriftSpec = element(namespaced=True, default=DriftSpec())
    """Errors of the specific force."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> InertialUnit:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        return InertialUnit(self, vehicle.moving_mount(self), world, vehicle.name)


@dataclass(slots=True)
class ImuState(Record):
    """What changes of an inertial measurement unit."""

    random: np.random.Generator
    """The generator of the noise of its attitude."""
    gyro: DriftState
    """The errors of its rates."""
    accelerometer: DriftState
    """The errors of its accelerations."""


class InertialUnit:
    """An inertial measurement unit with attitude."""

    def __init__(self, spec: ImuSpec, mount: MovingBody, world: SensorWorld, vehicle: str) -> None:
        own = f"{vehicle}/{spec.name}"
        self._spec, self._mount, self._world = spec, mount, world
        self._gyro = Drift(spec.gyro, world.stream(f"{own}/gyro"))
        self._accelerometer = Drift(spec.accelerometer, world.stream(f"{own}/accelerometer"))
        random = world.stream(f"{own}/noise")
        self.state = ImuState(random, self._gyro.state, self._accelerometer.state)
        """What changes of it."""
        self._measures_motion = "imu-orientation" not in world.compatibility

    def sample(self, time: float) -> Imu:
        """Measure now, at ``time`` [s]."""
        pose = self._mount.world_from_body
        noise = rotation_from_rpy(*(self._spec.std * self.state.random.standard_normal(3)).tolist())
        localized = product(self._world.world_from_localized.rotation.T, pose.rotation)
        w, x, y, z = quaternion_from_rotation(product(noise, localized)).tolist()
        message = Imu(
            header=header(time, self._spec.name),
            orientation=Quaternion(x=x, y=y, z=z, w=w),
            orientation_covariance=_diagonal(self._spec.std**2),
        )
        if not self._measures_motion:
            message.header.frame_id = "world"
            return message
        motion = self._mount.motion()
        for part, value, drift in (
            ("angular_velocity", motion.angular_velocity, self._gyro),
            ("linear_acceleration", motion.acceleration + UP, self._accelerometer),
        ):
            error, variance = drift.sample(time)
            measured = turned_back(pose.rotation, value) + error
            setattr(message, part, Vector3(*measured.tolist()))
            setattr(message, f"{part}_covariance", _diagonal(variance))
        return message


def _diagonal(variance: float) -> Array:
    """A covariance of equal variances, by rows (9,)."""
    covariance = np.zeros(9)
    covariance[::4] = variance
    return covariance
