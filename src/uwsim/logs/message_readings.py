"""The numbers of ROS messages in a log: motion, commands and sensors, by the type of the message.

Sensors have the axes of their frame. A mapping with the body frame ``flu`` turns them to ``frd``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ..base.geometry import Array
from .frames import BodyFrame, convert_body_vectors

Reading = Callable[[Any], tuple[float, ...]]
"""A function that returns the numbers of a message."""


@dataclass(frozen=True, kw_only=True)
class SensorReader:
    """The readings of a type of messages."""

    kind: str
    """The kind of the sensor."""
    names: tuple[str, ...]
    """The names of the numbers."""
    units: tuple[str, ...]
    """The units of the numbers."""
    read: Reading
    """The function that returns the numbers of a message."""
    n_vectors: int = 0
    """The number of vectors in body axes among the first numbers."""

    def convert(self, values: Array, frame: BodyFrame) -> Array:
        """Return readings (n, columns) with vectors in base axes."""
        for first in range(0, 3 * self.n_vectors, 3):
            values[:, first : first + 3] = convert_body_vectors(values[:, first : first + 3], frame)
        return values


def _read_pose(pose: Any) -> tuple[float, ...]:
    p, q = pose.position, pose.orientation
    return (p.x, p.y, p.z, q.w, q.x, q.y, q.z)


def _read_twist(twist: Any) -> tuple[float, ...]:
    v, w = twist.linear, twist.angular
    return (v.x, v.y, v.z, w.x, w.y, w.z)


def _read_wrench(message: Any) -> tuple[float, ...]:
    f, t = message.wrench.force, message.wrench.torque
    return (f.x, f.y, f.z, t.x, t.y, t.z)


def _read_imu(message: Any) -> tuple[float, ...]:
    a, w = message.linear_acceleration, message.angular_velocity
    return (a.x, a.y, a.z, w.x, w.y, w.z)


MOTION_READERS: Mapping[str, Reading] = MappingProxyType(
    {
        "nav_msgs/msg/Odometry": lambda m: _read_pose(m.pose.pose) + _read_twist(m.twist.twist),
        "geometry_msgs/msg/PoseStamped": lambda m: _read_pose(m.pose),
    }
)
"""The position, the quaternion wxyz and the twist of a message, by its type, preferred first."""
COMMAND_READERS: Mapping[str, Reading] = MappingProxyType(
    {
        "std_msgs/msg/Float64MultiArray": lambda m: tuple(m.data.tolist()),
        "geometry_msgs/msg/WrenchStamped": _read_wrench,
        "geometry_msgs/msg/TwistStamped": lambda m: _read_twist(m.twist),
        "geometry_msgs/msg/Twist": _read_twist,
    }
)
"""The commands of a message, by its type."""
SENSOR_READERS: Mapping[str, SensorReader] = MappingProxyType(
    {
        "sensor_msgs/msg/Imu": SensorReader(
            kind="imu",
            names=("ax", "ay", "az", "p", "q", "r"),
            units=("m/s2",) * 3 + ("rad/s",) * 3,
            read=_read_imu,
            n_vectors=2,
        ),
        "underwater_sensor_msgs/msg/DVL": SensorReader(
            kind="dvl",
            names=("u", "v", "w", "altitude"),
            units=("m/s",) * 3 + ("m",),
            read=lambda m: (m.bi_x_axis, m.bi_y_axis, m.bi_z_axis, m.bd_range),
            n_vectors=1,
        ),
        "underwater_sensor_msgs/msg/Pressure": SensorReader(
            kind="pressure", names=("depth",), units=("m",), read=lambda m: (m.pressure,)
        ),
        "sensor_msgs/msg/FluidPressure": SensorReader(
            kind="pressure",
            names=("pressure",),
            units=("Pa",),
            read=lambda m: (m.fluid_pressure,),
        ),
        "sensor_msgs/msg/Range": SensorReader(
            kind="range", names=("range",), units=("m",), read=lambda m: (m.range,)
        ),
        "sensor_msgs/msg/NavSatFix": SensorReader(
            kind="gps",
            names=("latitude", "longitude", "altitude"),
            units=("deg", "deg", "m"),
            read=lambda m: (m.latitude, m.longitude, m.altitude),
        ),
        "sensor_msgs/msg/BatteryState": SensorReader(
            kind="battery",
            names=("voltage", "current"),
            units=("V", "A"),
            read=lambda m: (m.voltage, m.current),
        ),
    }
)
"""The readings of sensors, by the type of the message."""
