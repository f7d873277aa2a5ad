"""The navigation sensors of an autopilot: a DVL, a position and an altimeter, from topics."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...autopilots.mavlink import Message
from ...autopilots.mavlink.navigation import (
    NavigationSample,
    confidence_of,
    distance_sensor,
    odometry,
    rotation_vector,
    vision_position_delta,
)
from ...base.geometry import (
    Array,
    quaternion_from_rotation,
    rotation_from_quaternion,
    rotation_from_rpy,
)
from ...base.numerics.linear import length, product
from ...base.record import Record
from ...messages import DVL, Odometry, Range, seconds
from .axes import BodyAxes, HomeFrame

MAX_INTERVAL = 1.0
"""The longest time between two velocities of which a displacement is sent [s]."""
JUMP_SPEED = 10.0
"""The speed between two positions above which the position has jumped [m/s]."""


@dataclass(slots=True)
class NavigationState(Record):
    """The state of the navigation sensors."""

    rng: np.random.Generator
    """The generator of the noise of positions."""
    dvl_time: float = -math.inf
    """The time of the last valid velocity [s]."""
    dvl_rotation: tuple[float, ...] = ()
    """The attitude at that time, by rows, (9,); empty before the first valid velocity."""
    position_time: float = -math.inf
    """The time of the last position [s]."""
    position: tuple[float, ...] = ()
    """The last position without noise, north, east, down (3,) [m]; empty before the first."""
    n_jumps: int = 0
    """The number of jumps of the position so far."""


@dataclass(frozen=True, kw_only=True)
class PositionNoise:
    """The standard deviations of the noise of a position."""

    position: float
    """The noise of each component of the position [m]."""
    attitude: float
    """The noise of roll, pitch and heading [rad]."""
    velocity: float
    """The noise of each component of the velocity [m/s]."""


class NavigationSensors:
    """The conversion of messages of topics to messages for the autopilot.

    Args:
        axes: the body axes of the vehicle.
        home: the frame of the autopilot's local positions.
        noise: the noise that is added to positions.
        rng: the generator of the noise.
        send: the function that sends a message.
    """

    def __init__(
        self,
        axes: BodyAxes,
        home: HomeFrame,
        noise: PositionNoise,
        rng: np.random.Generator,
        send: Callable[[Message], None],
    ) -> None:
        self._axes, self._home = axes, home
        self._noise, self._send = noise, send
        self.state = NavigationState(rng)
        """The state of the sensors."""

    def send_dvl(self, message: DVL) -> None:
        """Send the velocity over the bottom of a ping as VISION_POSITION_DELTA.

        A ping without a valid velocity is not sent; nor is the first one after a gap of more than
        `MAX_INTERVAL`. The velocity is that of the sensor, in body axes: ``VISO_POS_X`` to ``_Z``
        of ArduPilot are the sensor's place. The turn is that of the vehicle's attitude, without
        noise; ArduPilot uses it only to correct for that place.
        """
        base_velocity = (message.bs_longitudinal, message.bs_transverse, message.bs_normal)
        velocity = product(self._axes.frd_from_base, base_velocity)
        if not np.isfinite(velocity).all():
            return
        state, time = self.state, seconds(message.header.stamp)
        rotation, interval = self._axes.ned_from_frd, time - state.dvl_time
        last_rotation = state.dvl_rotation
        state.dvl_time, state.dvl_rotation = time, tuple(rotation.ravel().tolist())
        if not last_rotation or not 0.0 < interval <= MAX_INTERVAL:
            return
        self._send(
            vision_position_delta(
                time,
                interval,
                velocity=velocity,
                turn=rotation_vector(product(np.reshape(last_rotation, (3, 3)).T, rotation)),
                confidence=confidence_of(message.bi_error),
            )
        )

    def send_position(self, message: Odometry) -> None:
        """Send a pose and a velocity, with noise, as ODOMETRY in NED and FRD axes.

        The pose is that of ``/odom``-like topics: L from the base, with the twist in base axes.
        """
        pose, twist = message.pose.pose, message.twist.twist
        q = pose.orientation
        rotation = rotation_from_quaternion(np.array([q.w, q.x, q.y, q.z]))
        frd_from_base, noise = self._axes.frd_from_base, self._noise
        linear, angular = twist.linear, twist.angular
        velocity = product(frd_from_base, (linear.x, linear.y, linear.z))
        rates = product(frd_from_base, (angular.x, angular.y, angular.z))
        draws = self.state.rng.standard_normal(9)
        roll, pitch, yaw = (noise.attitude * draws[3:6]).tolist()
        point = np.array([pose.position.x, pose.position.y, pose.position.z])
        position = self._home.position(point)
        self._count_jump(seconds(message.header.stamp), position)
        localized_from_frd = product(rotation, frd_from_base.T)
        ned_from_frd = product(self._home.ned_from_localized, localized_from_frd)
        rotation = product(ned_from_frd, rotation_from_rpy(roll, pitch, yaw))
        quaternion = tuple(quaternion_from_rotation(rotation).tolist())
        sample = NavigationSample(
            time=seconds(message.header.stamp),
            position=position + noise.position * draws[:3],
            quaternion=quaternion,
            velocity=velocity + noise.velocity * draws[6:],
            angular_velocity=rates,
        )
        if not np.isfinite([*sample.position, *quaternion, *sample.velocity, *rates]).all():
            return
        self._send(
            odometry(
                sample,
                position_std=noise.position,
                attitude_std=noise.attitude,
                velocity_std=noise.velocity,
                reset_counter=self.state.n_jumps,
            )
        )

    def send_range(self, message: Range) -> None:
        """Send the distance to the bottom as DISTANCE_SENSOR of a sensor that looks down."""
        self._send(
            distance_sensor(
                seconds(message.header.stamp),
                float(message.range),
                minimum=float(message.min_range),
                maximum=float(message.max_range),
                beam_width=float(message.field_of_view),
            )
        )

    def _count_jump(self, time: float, position: Array) -> None:
        """Count a jump of the position, such as a reset of the vehicle to its start."""
        state = self.state
        last_position, interval = state.position, time - state.position_time
        state.position, state.position_time = tuple(position.tolist()), time
        if not last_position:
            return
        if length(position - np.array(last_position)) > JUMP_SPEED * max(interval, 0.0):
            state.n_jumps += 1
