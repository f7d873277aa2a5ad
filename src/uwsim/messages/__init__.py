"""ROS message and service types of the bus.

The messages are those of ROS 2 (Jazzy), as dataclasses, in one module for each ROS package. Each
field has the default of ROS: 0, False, an empty text or list, zeros in an array of fixed length;
a quaternion is the identity (w = 1). So every number in ``Twist()`` is 0. ``scripts/messages``
generates the modules: the types of ROS from the definitions that rosbags ships, those of other
packages from the ``.msg`` and ``.srv`` files in the package's folder. The services of UWSim are in
``services.py``; a test compares them with their ``.srv`` files. Headers are those of ROS 2; the
adapter for ROS 1 adds ``seq``.
"""

from __future__ import annotations

from .build import (
    array_of,
    depth_image,
    floats,
    header,
    image,
    image_of,
    label_image,
    numbers_of,
    pixels_of,
    seconds,
    time_from_seconds,
)
from .geometry_msgs import (
    Point,
    PointStamped,
    Pose,
    PoseStamped,
    PoseWithCovariance,
    Quaternion,
    Transform,
    TransformStamped,
    Twist,
    TwistStamped,
    TwistWithCovariance,
    Vector3,
    Wrench,
    WrenchStamped,
)
from .nav_msgs import Odometry, Path
from .point_cloud import point_cloud, points
from .sensor_msgs import (
    BatteryState,
    CameraInfo,
    CompressedImage,
    Image,
    Imu,
    JointState,
    LaserScan,
    NavSatFix,
    NavSatStatus,
    PointCloud2,
    PointField,
    Range,
    RegionOfInterest,
)
from .services import (
    Empty,
    EmptyResponse,
    GTpublish,
    GTpublishResponse,
    Service,
    SpawnMarker,
    SpawnMarkerResponse,
)
from .sonar import PingInfo, ProjectedSonarImage, SonarImageData
from .std_msgs import (
    Bool,
    ColorRGBA,
    Duration,
    Float32MultiArray,
    Float64,
    Float64MultiArray,
    Header,
    MultiArrayDimension,
    MultiArrayLayout,
    String,
    Time,
    UInt8MultiArray,
)
from .tf2_msgs import TFMessage
from .underwater import DVL, LedLight, Pressure
from .visualization_msgs import Marker, MarkerArray, MeshFile, UVCoordinate

__all__ = [
    "DVL",
    "BatteryState",
    "Bool",
    "CameraInfo",
    "ColorRGBA",
    "CompressedImage",
    "Duration",
    "Empty",
    "EmptyResponse",
    "Float32MultiArray",
    "Float64",
    "Float64MultiArray",
    "GTpublish",
    "GTpublishResponse",
    "Header",
    "Image",
    "Imu",
    "JointState",
    "LaserScan",
    "LedLight",
    "Marker",
    "MarkerArray",
    "MeshFile",
    "MultiArrayDimension",
    "MultiArrayLayout",
    "NavSatFix",
    "NavSatStatus",
    "Odometry",
    "Path",
    "PingInfo",
    "Point",
    "PointCloud2",
    "PointField",
    "PointStamped",
    "Pose",
    "PoseStamped",
    "PoseWithCovariance",
    "Pressure",
    "ProjectedSonarImage",
    "Quaternion",
    "Range",
    "RegionOfInterest",
    "Service",
    "SonarImageData",
    "SpawnMarker",
    "SpawnMarkerResponse",
    "String",
    "TFMessage",
    "Time",
    "Transform",
    "TransformStamped",
    "Twist",
    "TwistStamped",
    "TwistWithCovariance",
    "UInt8MultiArray",
    "UVCoordinate",
    "Vector3",
    "Wrench",
    "WrenchStamped",
    "array_of",
    "depth_image",
    "floats",
    "header",
    "image",
    "image_of",
    "label_image",
    "numbers_of",
    "pixels_of",
    "point_cloud",
    "points",
    "seconds",
    "time_from_seconds",
]
