"""Messages of sensor_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np

from .geometry_msgs import Quaternion, Vector3
from .std_msgs import Header

_ZEROS_0: Any = partial(np.zeros, 0)
_ZEROS_9: Any = partial(np.zeros, 9)
_ZEROS_12: Any = partial(np.zeros, 12)
_FLOATS_0: Any = partial(np.zeros, 0, np.float32)
_BYTES_0: Any = partial(np.zeros, 0, np.uint8)
"""What makes the arrays, anew for each message."""


@dataclass
class Image:
    """Pixels, row 0 at the top."""

    header: Header = field(default_factory=Header)
    height: int = 0
    width: int = 0
    encoding: str = ""
    is_bigendian: int = 0
    step: int = 0
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/Image"


@dataclass
class RegionOfInterest:
    """A part of an image [px]."""

    x_offset: int = 0
    y_offset: int = 0
    height: int = 0
    width: int = 0
    do_rectify: bool = False
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/RegionOfInterest"


@dataclass
class CameraInfo:
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
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/CameraInfo"


@dataclass
class JointState:
    """Names, positions [rad or m], velocities and efforts of joints."""

    header: Header = field(default_factory=Header)
    name: list[str] = field(default_factory=list)
    position: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)
    velocity: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)
    effort: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/JointState"


@dataclass
class BatteryState:
    """Voltage [V], current [A], below 0 while it is drained, charge [A h] and share left [0..1]."""

    POWER_SUPPLY_STATUS_UNKNOWN: ClassVar[int] = 0
    POWER_SUPPLY_STATUS_CHARGING: ClassVar[int] = 1
    POWER_SUPPLY_STATUS_DISCHARGING: ClassVar[int] = 2
    POWER_SUPPLY_STATUS_NOT_CHARGING: ClassVar[int] = 3
    POWER_SUPPLY_STATUS_FULL: ClassVar[int] = 4
    POWER_SUPPLY_HEALTH_UNKNOWN: ClassVar[int] = 0
    POWER_SUPPLY_HEALTH_GOOD: ClassVar[int] = 1
    POWER_SUPPLY_HEALTH_OVERHEAT: ClassVar[int] = 2
    POWER_SUPPLY_HEALTH_DEAD: ClassVar[int] = 3
    POWER_SUPPLY_HEALTH_OVERVOLTAGE: ClassVar[int] = 4
    POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: ClassVar[int] = 5
    POWER_SUPPLY_HEALTH_COLD: ClassVar[int] = 6
    POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: ClassVar[int] = 7
    POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: ClassVar[int] = 8
    POWER_SUPPLY_TECHNOLOGY_UNKNOWN: ClassVar[int] = 0
    POWER_SUPPLY_TECHNOLOGY_NIMH: ClassVar[int] = 1
    POWER_SUPPLY_TECHNOLOGY_LION: ClassVar[int] = 2
    POWER_SUPPLY_TECHNOLOGY_LIPO: ClassVar[int] = 3
    POWER_SUPPLY_TECHNOLOGY_LIFE: ClassVar[int] = 4
    POWER_SUPPLY_TECHNOLOGY_NICD: ClassVar[int] = 5
    POWER_SUPPLY_TECHNOLOGY_LIMN: ClassVar[int] = 6
    POWER_SUPPLY_TECHNOLOGY_TERNARY: ClassVar[int] = 7
    POWER_SUPPLY_TECHNOLOGY_VRLA: ClassVar[int] = 8
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
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/BatteryState"


@dataclass
class Range:
    """The distance to what is nearest in a cone [m]."""

    ULTRASOUND: ClassVar[int] = 0
    INFRARED: ClassVar[int] = 1
    header: Header = field(default_factory=Header)
    radiation_type: int = 0
    field_of_view: float = 0.0
    min_range: float = 0.0
    max_range: float = 0.0
    range: float = 0.0
    variance: float = 0.0
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/Range"


@dataclass
class LaserScan:
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
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/LaserScan"


@dataclass
class PointField:
    """The offset and type of a field of each point."""

    INT8: ClassVar[int] = 1
    UINT8: ClassVar[int] = 2
    INT16: ClassVar[int] = 3
    UINT16: ClassVar[int] = 4
    INT32: ClassVar[int] = 5
    UINT32: ClassVar[int] = 6
    FLOAT32: ClassVar[int] = 7
    FLOAT64: ClassVar[int] = 8
    name: str = ""
    offset: int = 0
    datatype: int = 0
    count: int = 0
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/PointField"


@dataclass
class PointCloud2:
    """Points as bytes."""

    header: Header = field(default_factory=Header)
    height: int = 0
    width: int = 0
    fields: list[PointField] = field(default_factory=list)
    is_bigendian: bool = False
    point_step: int = 0
    row_step: int = 0
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)
    is_dense: bool = False
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/PointCloud2"


@dataclass
class CompressedImage:
    """An image as the bytes of a PNG or JPEG file."""

    header: Header = field(default_factory=Header)
    format: str = ""
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/CompressedImage"


@dataclass
class Imu:
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
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/Imu"


@dataclass
class NavSatStatus:
    """Whether a receiver of satellites knows its position."""

    STATUS_UNKNOWN: ClassVar[int] = -2
    STATUS_NO_FIX: ClassVar[int] = -1
    STATUS_FIX: ClassVar[int] = 0
    STATUS_SBAS_FIX: ClassVar[int] = 1
    STATUS_GBAS_FIX: ClassVar[int] = 2
    SERVICE_UNKNOWN: ClassVar[int] = 0
    SERVICE_GPS: ClassVar[int] = 1
    SERVICE_GLONASS: ClassVar[int] = 2
    SERVICE_COMPASS: ClassVar[int] = 4
    SERVICE_GALILEO: ClassVar[int] = 8
    status: int = 0
    service: int = 0
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/NavSatStatus"


@dataclass
class NavSatFix:
    """Latitude and longitude [deg], altitude [m], and their 3x3 covariance east, north, up [m2]."""

    COVARIANCE_TYPE_UNKNOWN: ClassVar[int] = 0
    COVARIANCE_TYPE_APPROXIMATED: ClassVar[int] = 1
    COVARIANCE_TYPE_DIAGONAL_KNOWN: ClassVar[int] = 2
    COVARIANCE_TYPE_KNOWN: ClassVar[int] = 3
    header: Header = field(default_factory=Header)
    status: NavSatStatus = field(default_factory=NavSatStatus)
    latitude: float = 0.0
    longitude: float = 0.0
    altitude: float = 0.0
    position_covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(
        default_factory=_ZEROS_9
    )
    position_covariance_type: int = 0
    __msgtype__: ClassVar[str] = "sensor_msgs/msg/NavSatFix"
