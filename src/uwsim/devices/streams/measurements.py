"""The values of instruments from the messages of the bus, in the axes of the instruments."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...autopilots.instruments.attitude import Attitude
from ...autopilots.instruments.depth import BottomDistance, DepthReading
from ...autopilots.instruments.dvl import DvlPing, Vector
from ...autopilots.instruments.satellite import Fix
from ...autopilots.instruments.usbl import BeaconPosition
from ...base.geodesy import Geodetic
from ...base.geometry import Array, Pose, rotation_from_quaternion, rpy_from_rotation
from ...base.numerics.linear import multiply_matrices, rotate, rotate_back
from ...messages import DVL, Header, Imu, NavSatFix, NavSatStatus, Pressure, Range
from ...vehicle import Vehicle

NED_FROM_WORLD = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""The rotation from W (east, north, up) to north, east, down, (3, 3)."""
MIN_COURSE_SPEED = 0.05
"""The speed below which a receiver states no course [m/s]."""


@dataclass(frozen=True, eq=False)
class InstrumentCarrier:
    """The vehicle that carries the instruments, and the frames of their values."""

    vehicle: Vehicle
    """The vehicle."""
    origin: Geodetic
    """The position of the origin of W on Earth."""
    world_from_localized: Pose
    """The transform from L to W."""
    epoch_us: int
    """The time at the start of the simulation [us since 1970]."""
    beam_angle: float
    """The angle from the axis of a DVL to its beams [rad]."""
    is_z_down: bool
    """True if the z axis of the vehicle's base points down at the start."""

    def to_time_us(self, header: Header) -> int:
        """Return the time of a header [us since 1970]."""
        return self.epoch_us + header.stamp.sec * 1_000_000 + header.stamp.nanosec // 1000

    def measure_attitude(self, time_us: int, world_from_sensor: Array) -> Attitude:
        """Return the attitude of a rotation in W, (3, 3), whose axes are those of the base."""
        ned_from_sensor = multiply_matrices(NED_FROM_WORLD, world_from_sensor)
        if not self.is_z_down:  # forward, left, up becomes forward, right, down
            ned_from_sensor = ned_from_sensor * np.array([1.0, -1.0, -1.0])
        roll, pitch, yaw = map(math.degrees, rpy_from_rotation(ned_from_sensor))
        return Attitude(time_us=time_us, roll=roll, pitch=pitch, heading=yaw % 360.0)

    def read_imu(self, message: Imu) -> Attitude:
        """Return the attitude that an inertial measurement unit measures."""
        q = message.orientation
        localized_from_sensor = rotation_from_quaternion(np.array([q.w, q.x, q.y, q.z]))
        world_from_sensor = multiply_matrices(
            self.world_from_localized.rotation, localized_from_sensor
        )
        return self.measure_attitude(self.to_time_us(message.header), world_from_sensor)

    def read_fix(self, message: NavSatFix) -> Fix:
        """Return the position of a satellite receiver, and the vehicle's velocity over ground.

        The velocity is that of the vehicle's base, without noise.
        """
        time_us = self.to_time_us(message.header)
        if message.status.status < NavSatStatus.STATUS_FIX:
            return Fix(time_us=time_us)
        rotation = self.vehicle.world_from_base.rotation
        east, north, _ = rotate(rotation, self.vehicle.velocity[:3]).tolist()
        speed = math.hypot(east, north)
        course = math.degrees(math.atan2(east, north)) % 360.0
        return Fix(
            time_us=time_us,
            latitude=message.latitude,
            longitude=message.longitude,
            altitude=message.altitude,
            speed=speed,
            course=course if speed >= MIN_COURSE_SPEED else math.nan,
        )

    def read_pressure(self, message: Pressure, *, is_depth: bool) -> DepthReading:
        """Return the reading of a pressure sensor that measures depth [m] or pressure [Pa]."""
        if is_depth:
            return DepthReading(depth=message.pressure)
        return DepthReading(pressure=message.pressure)

    def read_range(self, message: Range) -> BottomDistance:
        """Return the distance of an altimeter; the greatest range means that there is no echo."""
        has_echo = message.range < message.max_range
        return BottomDistance(distance=message.range if has_echo else math.nan)

    def read_ping(self, message: DVL) -> DvlPing:
        """Return the measurement of a DVL, with the true attitude of the vehicle."""
        m, time_us = message, self.to_time_us(message.header)
        attitude = self.measure_attitude(time_us, self.vehicle.world_from_base.rotation)
        ranges = [float(text) for text in m.raw_data.split()[:4]] or [math.nan] * 4
        cosine = math.cos(self.beam_angle)
        return DvlPing(
            time_us=time_us,
            velocity=(m.bi_x_axis, m.bi_y_axis, m.bi_z_axis),
            error_velocity=m.bi_error,
            earth_velocity=(m.be_east, m.be_north, m.be_upwards),
            water_velocity=(m.wi_x_axis, m.wi_y_axis, m.wi_z_axis),
            water_error_velocity=m.wi_error,
            water_earth_velocity=(m.we_east, m.we_north, m.we_upwards),
            distance_made_good=(m.bd_east, m.bd_north, m.bd_upwards),
            water_distance_made_good=(m.wd_east, m.wd_north, m.wd_upwards),
            altitude=m.bd_range,
            water_layer=m.wd_range,
            age=m.bd_time,
            water_age=m.wd_time,
            vertical_ranges=tuple(value * cosine for value in ranges),
            roll=attitude.roll,
            pitch=attitude.pitch,
            heading=attitude.heading,
            depth=m.depth,
            sound_speed=m.sound_speed,
            salinity=m.salinity,
            temperature=m.temperature,
        )

    def measure_beacon(
        self, name: str, time_us: int, noise: Array, std: float, transceiver: Vector
    ) -> BeaconPosition:
        """Return the position of the vehicle as an acoustic positioning system measures it.

        The transceiver looks north: starboard is east, forward is north.

        Args:
            name: the name of the beacon.
            time_us: the time [us since 1970].
            noise: the errors along x, y, z of W, (3,) [m].
            std: the standard deviation of each error [m].
            transceiver: the position of the transceiver in L [m].
        """
        position = self.vehicle.world_from_base.position + noise  # (3,) in W [m]
        geodetic = self.origin.position_at(rotate(NED_FROM_WORLD, position))
        world = self.world_from_localized
        offset = position - world.position - rotate(world.rotation, np.array(transceiver))
        east, north, up = offset.tolist()
        return BeaconPosition(
            time_us=time_us,
            beacon=name,
            latitude=math.degrees(geodetic.latitude),
            longitude=math.degrees(geodetic.longitude),
            starboard=east,
            forward=north,
            depth=-up,
            error=std,
        )


def is_base_z_down(vehicle: Vehicle) -> bool:
    """Return whether the z axis of a vehicle's base points down now."""
    down = rotate_back(vehicle.world_from_base.rotation, np.array([0.0, 0.0, -1.0]))
    return float(down[2]) > 0.0
