r"""The sensors on PX4's board: what they measure of the vehicle's true motion.

The accelerometer measures the specific force :math:`R^T (a - g)`, with the board's acceleration a
and its rotation R in W. Each sample of each sensor has white noise; a sensor with a noise density N
and the rate f has the standard deviation :math:`N \sqrt{f}`. PX4 takes a sensor whose value is the
same 100 times in a row as failed (DataValidator), so the noise must not be zero.

Not modelled: biases, scale errors, misalignment, vibration, temperature, delays.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...autopilots.px4 import (
    HilMessage,
    Odometry,
    SatelliteFix,
    SensorReadings,
    TrueState,
    air_pressure,
    air_temperature,
    magnetic_field,
)
from ...base.geodesy import Geodetic
from ...base.geometry import Array, quaternion_from_rotation
from ...base.numerics.linear import multiply_matrices, rotate, rotate_back
from ...world import GRAVITY, MovingBody

NED_FROM_WORLD = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""The rotation from W (east, north, up) to NED."""
N_DRAWS = 16
"""The number of random numbers of a sample, whichever messages are due."""


@dataclass(frozen=True, kw_only=True)
class BoardNoise:
    """The standard deviations of single samples."""

    specific_force: float
    """The noise of the accelerometer [m/s2]."""
    angular_velocity: float
    """The noise of the gyro [rad/s]."""
    magnetic_field: float
    """The noise of the magnetometer [T]."""
    depth: float
    """The noise of the barometer, as a depth [m]."""
    satellites: float
    """The noise of the satellite receiver's position [m]."""
    odometry: float
    """The noise of the odometry's position [m]; of its velocity, the same number [m/s]."""


@dataclass(frozen=True, kw_only=True)
class Due:
    """The messages that are due besides HIL_SENSOR."""

    has_satellites: bool
    """True if HIL_GPS is due."""
    has_odometry: bool
    """True if ODOMETRY is due."""
    has_truth: bool
    """True if HIL_STATE_QUATERNION is due."""


class Board:
    """The board of PX4 on a vehicle.

    Args:
        body: the frame of the board, in FRD axes.
        origin: the origin of W on Earth.
        noise: the noise of single samples.
    """

    def __init__(self, body: MovingBody, origin: Geodetic, noise: BoardNoise) -> None:
        self._body, self._origin, self._noise = body, origin, noise
        self._field = magnetic_field(origin)  # (3,) in NED [T]

    def measure(self, clock: int, due: Due, rng: np.random.Generator) -> list[HilMessage]:
        """Return the messages that are due; HIL_SENSOR is the last one, because PX4 then runs.

        Args:
            clock: the time on PX4's clock [us].
            due: the messages that are due besides HIL_SENSOR.
            rng: the generator of the noise, from which `N_DRAWS` numbers are taken.
        """
        noise, draws = self._noise, rng.standard_normal(N_DRAWS)
        world_from_board, motion = self._body.world_from_body, self._body.motion()
        rotation = world_from_board.rotation
        ned_from_board = multiply_matrices(NED_FROM_WORLD, rotation)
        position = rotate(NED_FROM_WORLD, world_from_board.position)
        velocity = rotate(NED_FROM_WORLD, motion.velocity)
        rates = rotate_back(rotation, motion.angular_velocity)
        force = rotate_back(rotation, motion.acceleration + np.array([0.0, 0.0, GRAVITY]))
        quaternion = quaternion_from_rotation(ned_from_board)
        messages: list[HilMessage] = []
        if due.has_truth:
            messages.append(self._true_state(clock, position, velocity, quaternion, rates, force))
        if due.has_satellites:
            messages.append(
                self._satellite_fix(clock, position + noise.satellites * draws[10:13], velocity)
            )
        if due.has_odometry:
            body_velocity = rotate_back(ned_from_board, velocity)
            messages.append(
                Odometry(
                    time_usec=clock,
                    position=(position + noise.odometry * draws[10:13]).tolist(),
                    quaternion=quaternion.tolist(),
                    velocity=(body_velocity + noise.odometry * draws[13:16]).tolist(),
                    angular_velocity=rates.tolist(),
                    position_variance=max(noise.odometry**2, 1e-6),
                    attitude_variance=1e-4,
                    velocity_variance=max(noise.odometry**2, 1e-6),
                )
            )
        altitude = self._origin.altitude - float(position[2]) + noise.depth * float(draws[9])
        field = rotate_back(ned_from_board, self._field) + noise.magnetic_field * draws[6:9]
        messages.append(
            SensorReadings(
                time_usec=clock,
                specific_force=(force + noise.specific_force * draws[0:3]).tolist(),
                angular_velocity=(rates + noise.angular_velocity * draws[3:6]).tolist(),
                magnetic_field=field.tolist(),
                pressure=air_pressure(altitude),
                altitude=altitude,
                temperature=air_temperature(altitude),
            )
        )
        return messages

    def _true_state(
        self,
        clock: int,
        position: Array,
        velocity: Array,
        quaternion: Array,
        rates: Array,
        force: Array,
    ) -> TrueState:
        place = self._origin.position_at(position)
        return TrueState(
            time_usec=clock,
            quaternion=quaternion.tolist(),
            angular_velocity=rates.tolist(),
            latitude=place.latitude,
            longitude=place.longitude,
            altitude=place.altitude,
            velocity=velocity.tolist(),
            specific_force=force.tolist(),
        )

    def _satellite_fix(self, clock: int, position: Array, velocity: Array) -> SatelliteFix:
        place = self._origin.position_at(position)
        accuracy = max(self._noise.satellites, 0.3)
        return SatelliteFix(
            time_usec=clock,
            latitude=place.latitude,
            longitude=place.longitude,
            altitude=place.altitude,
            velocity=velocity.tolist(),
            horizontal_accuracy=accuracy * math.sqrt(2.0),
            vertical_accuracy=accuracy,
        )
