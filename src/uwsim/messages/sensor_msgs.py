"""Messages of sensor_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from rosbags.typesys.stores import ros2_jazzy as ros

from .geometry_msgs import Quaternion, Vector3
from .std_msgs import Header

_ZEROS_0: Any = partial(np.zeros, 0)
_ZEROS_9: Any = partial(np.zeros, 9)
_ZEROS_12: Any = partial(np.zeros, 12)
_FLOATS_0: Any = partial(np.zeros, 0, np.float32)
_BYTES_0: Any = partial(np.zeros, 0, np.uint8)
"""What makes the arrays, anew for each message."""


@dataclass
class Image(ros.sensor_msgs__msg__Image):
    """Pixels, row 0 at the top."""

    header: Header = field(default_factory=Header)
    height: int = 0
    width: int = 0
    encoding: str = ""
    is_bigendian: int = 0
    step: int = 0
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)


@dataclass
class RegionOfInterest(ros.sensor_msgs__msg__RegionOfInterest):
    """A part of an image [px]."""

    x_offset: int = 0
    y_offset: int = 0
    height: int = 0
    width: int = 0
    do_rectify: bool = False


@dataclass
class CameraInfo(ros.sensor_msgs__msg__CameraInfo):
    """What kind of camera it is: distortion d, intrinsics k, rectification r, projection p."""

    header: Header = field(default_factory=Header)
    height: int = 0
    width: int = 0
    distortion_model: str = ""
    d: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)
    k: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_9)
    r: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_9)
    p: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_12)
    binning_x: int = 0
    binning_y: int = 0
    roi: RegionOfInterest = field(default_factory=RegionOfInterest)


@dataclass
class JointState(ros.sensor_msgs__msg__JointState):
    """Names, positions [rad or m], velocities and efforts of joints."""

    header: Header = field(default_factory=Header)
    name: list[str] = field(default_factory=list)
    position: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)
    velocity: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)
    effort: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)


@dataclass
class BatteryState(ros.sensor_msgs__msg__BatteryState):
    """Voltage [V], current [A], below 0 while it is drained, charge [A h] and share left [0..1]."""

    header: Header = field(default_factory=Header)
    voltage: float = 0.0
    temperature: float = 0.0
    current: float = 0.0
    charge: float = 0.0
    capacity: float = 0.0
    design_capacity: float = 0.0
    percentage: float = 0.0
    power_supply_status: int = 0
    power_supply_health: int = 0
    power_supply_technology: int = 0
    present: bool = False
    cell_voltage: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(
        default_factory=_FLOATS_0
    )
    cell_temperature: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(
        default_factory=_FLOATS_0
    )
    location: str = ""
    serial_number: str = ""


@dataclass
class Range(ros.sensor_msgs__msg__Range):
    """The distance to what is nearest in a cone [m]."""

    header: Header = field(default_factory=Header)
    radiation_type: int = 0
    field_of_view: float = 0.0
    min_range: float = 0.0
    max_range: float = 0.0
    range: float = 0.0
    variance: float = 0.0


@dataclass
class LaserScan(ros.sensor_msgs__msg__LaserScan):
    """Distances along rays of a plane, at equal angles [m, rad]."""

    header: Header = field(default_factory=Header)
    angle_min: float = 0.0
    angle_max: float = 0.0
    angle_increment: float = 0.0
    time_increment: float = 0.0
    scan_time: float = 0.0
    range_min: float = 0.0
    range_max: float = 0.0
    ranges: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(default_factory=_FLOATS_0)
    intensities: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(
        default_factory=_FLOATS_0
    )


@dataclass
class PointField(ros.sensor_msgs__msg__PointField):
    """The offset and type of a field of each point."""

    name: str = ""
    offset: int = 0
    datatype: int = 0
    count: int = 0


@dataclass
class PointCloud2(ros.sensor_msgs__msg__PointCloud2):
    """Points as bytes."""

    header: Header = field(default_factory=Header)
    height: int = 0
    width: int = 0
    fields: list[ros.sensor_msgs__msg__PointField] = field(default_factory=list)
    is_bigendian: bool = False
    point_step: int = 0
    row_step: int = 0
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)
    is_dense: bool = False


@dataclass
class CompressedImage(ros.sensor_msgs__msg__CompressedImage):
    """An image as the bytes of a PNG or JPEG file."""

    header: Header = field(default_factory=Header)
    format: str = ""
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)


@dataclass
class Imu(ros.sensor_msgs__msg__Imu):
    """Attitude, angular velocity [rad/s], specific force [m/s2]; 3x3 covariances by rows."""

    header: Header = field(default_factory=Header)
    orientation: Quaternion = field(default_factory=Quaternion)
    orientation_covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(
        default_factory=_ZEROS_9
    )
    angular_velocity: Vector3 = field(default_factory=Vector3)
    angular_velocity_covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(
        default_factory=_ZEROS_9
    )
    linear_acceleration: Vector3 = field(default_factory=Vector3)
    linear_acceleration_covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(
        default_factory=_ZEROS_9
    )


@dataclass
class NavSatStatus(ros.sensor_msgs__msg__NavSatStatus):
    """Whether a receiver of satellites knows its position."""

    status: int = 0
    service: int = 0


@dataclass
class NavSatFix(ros.sensor_msgs__msg__NavSatFix):
    """Latitude and longitude [deg], altitude [m], and their 3x3 covariance east, north, up [m2]."""

    header: Header = field(default_factory=Header)
    status: NavSatStatus = field(default_factory=NavSatStatus)  # type: ignore[assignment]
    latitude: float = 0.0
    longitude: float = 0.0
    altitude: float = 0.0
    position_covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(
        default_factory=_ZEROS_9
    )
    position_covariance_type: int = 0
