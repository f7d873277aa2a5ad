"""ROS message types with ROS's defaults: ``Twist()`` is all zero.

The classes are those of rosbags (ROS 2 Jazzy), which want every field; here each field has the
default that ROS gives it: 0, False, an empty text or list, arrays of zeros in their length, and for
a quaternion that of no rotation, w = 1. Names, order and units are theirs.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from rosbags.typesys.stores import ros2_jazzy as ros

_ZEROS_0: Any = partial(np.zeros, 0)
_ZEROS_9: Any = partial(np.zeros, 9)
_ZEROS_12: Any = partial(np.zeros, 12)
_ZEROS_36: Any = partial(np.zeros, 36)
_FLOATS_0: Any = partial(np.zeros, 0, np.float32)
_BYTES_0: Any = partial(np.zeros, 0, np.uint8)
"""What makes the arrays, anew for each message."""


@dataclass
class Time(ros.builtin_interfaces__msg__Time):
    """A moment, from the beginning of the simulation."""

    sec: int = 0
    nanosec: int = 0


@dataclass
class Header(ros.std_msgs__msg__Header):
    """When and in which frame."""

    stamp: Time = field(default_factory=Time)
    frame_id: str = ""


@dataclass
class Bool(ros.std_msgs__msg__Bool):
    """True or False."""

    data: bool = False


@dataclass
class Float64(ros.std_msgs__msg__Float64):
    """A number."""

    data: float = 0.0


@dataclass
class String(ros.std_msgs__msg__String):
    """Text."""

    data: str = ""


@dataclass
class MultiArrayDimension(ros.std_msgs__msg__MultiArrayDimension):
    """One dimension of an array."""

    label: str = ""
    size: int = 0
    stride: int = 0


@dataclass
class MultiArrayLayout(ros.std_msgs__msg__MultiArrayLayout):
    """The layout of an array."""

    dim: list[ros.std_msgs__msg__MultiArrayDimension] = field(default_factory=list)
    data_offset: int = 0


@dataclass
class Float32MultiArray(ros.std_msgs__msg__Float32MultiArray):
    """Numbers of 32 bits."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(default_factory=_FLOATS_0)


@dataclass
class Float64MultiArray(ros.std_msgs__msg__Float64MultiArray):
    """Numbers of 64 bits."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)


@dataclass
class UInt8MultiArray(ros.std_msgs__msg__UInt8MultiArray):
    """Bytes."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)


@dataclass
class Point(ros.geometry_msgs__msg__Point):
    """A place [m]."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


@dataclass
class Vector3(ros.geometry_msgs__msg__Vector3):
    """A direction with a length."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


@dataclass
class Quaternion(ros.geometry_msgs__msg__Quaternion):
    """A rotation; the identity by default (w is 1)."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    w: float = 1.0


@dataclass
class Pose(ros.geometry_msgs__msg__Pose):
    """A place and a rotation."""

    position: Point = field(default_factory=Point)
    orientation: Quaternion = field(default_factory=Quaternion)


@dataclass
class PoseStamped(ros.geometry_msgs__msg__PoseStamped):
    """A pose, with its time and frame."""

    header: Header = field(default_factory=Header)
    pose: Pose = field(default_factory=Pose)


@dataclass
class PoseWithCovariance(ros.geometry_msgs__msg__PoseWithCovariance):
    """A pose and its 6x6 covariance, by rows."""

    pose: Pose = field(default_factory=Pose)
    covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_36)


@dataclass
class Twist(ros.geometry_msgs__msg__Twist):
    """Linear [m/s] and angular [rad/s] velocity."""

    linear: Vector3 = field(default_factory=Vector3)
    angular: Vector3 = field(default_factory=Vector3)


@dataclass
class TwistStamped(ros.geometry_msgs__msg__TwistStamped):
    """A twist, with its time and frame."""

    header: Header = field(default_factory=Header)
    twist: Twist = field(default_factory=Twist)


@dataclass
class TwistWithCovariance(ros.geometry_msgs__msg__TwistWithCovariance):
    """A twist and its 6x6 covariance, by rows."""

    twist: Twist = field(default_factory=Twist)
    covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_36)


@dataclass
class Wrench(ros.geometry_msgs__msg__Wrench):
    """Force [N] and torque [N m]."""

    force: Vector3 = field(default_factory=Vector3)
    torque: Vector3 = field(default_factory=Vector3)


@dataclass
class WrenchStamped(ros.geometry_msgs__msg__WrenchStamped):
    """A wrench, with its time and frame."""

    header: Header = field(default_factory=Header)
    wrench: Wrench = field(default_factory=Wrench)


@dataclass
class Transform(ros.geometry_msgs__msg__Transform):
    """Where a frame is in another: its origin [m] and its rotation."""

    translation: Vector3 = field(default_factory=Vector3)
    rotation: Quaternion = field(default_factory=Quaternion)


@dataclass
class TransformStamped(ros.geometry_msgs__msg__TransformStamped):
    """A transform with its time, the frame it is in and the frame it is of."""

    header: Header = field(default_factory=Header)
    child_frame_id: str = ""
    transform: Transform = field(default_factory=Transform)


@dataclass
class TFMessage(ros.tf2_msgs__msg__TFMessage):
    """Transforms between frames."""

    transforms: list[ros.geometry_msgs__msg__TransformStamped] = field(default_factory=list)


@dataclass
class Odometry(ros.nav_msgs__msg__Odometry):
    """Pose and velocity of a vehicle."""

    header: Header = field(default_factory=Header)
    child_frame_id: str = ""
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)
    twist: TwistWithCovariance = field(default_factory=TwistWithCovariance)


@dataclass
class Path(ros.nav_msgs__msg__Path):
    """Poses, one after the other."""

    header: Header = field(default_factory=Header)
    poses: list[ros.geometry_msgs__msg__PoseStamped] = field(default_factory=list)


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


@dataclass
class ColorRGBA(ros.std_msgs__msg__ColorRGBA):
    """A colour and its opacity [0..1]."""

    r: float = 0.0
    g: float = 0.0
    b: float = 0.0
    a: float = 0.0


@dataclass
class Duration(ros.builtin_interfaces__msg__Duration):
    """A span of time."""

    sec: int = 0
    nanosec: int = 0


@dataclass
class MeshFile(ros.visualization_msgs__msg__MeshFile):
    """The content of a mesh file."""

    filename: str = ""
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)


@dataclass
class Marker(ros.visualization_msgs__msg__Marker):
    """A shape to show: `ns` and `id` name it; type, pose, scale [m] and colour say what it is."""

    header: Header = field(default_factory=Header)
    ns: str = ""
    id: int = 0
    type: int = 0
    action: int = 0
    pose: Pose = field(default_factory=Pose)
    scale: Vector3 = field(default_factory=Vector3)
    color: ColorRGBA = field(default_factory=ColorRGBA)
    lifetime: Duration = field(default_factory=Duration)
    frame_locked: bool = False
    points: list[ros.geometry_msgs__msg__Point] = field(default_factory=list)
    colors: list[ros.std_msgs__msg__ColorRGBA] = field(default_factory=list)
    texture_resource: str = ""
    texture: CompressedImage = field(default_factory=CompressedImage)
    uv_coordinates: list[ros.visualization_msgs__msg__UVCoordinate] = field(default_factory=list)
    text: str = ""
    mesh_resource: str = ""
    mesh_file: MeshFile = field(default_factory=MeshFile)
    mesh_use_embedded_materials: bool = False
