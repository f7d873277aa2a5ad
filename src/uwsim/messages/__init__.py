"""ROS message and service types: what travels on the bus.

Messages are the ROS 2 (Jazzy) dataclasses that rosbags ships, with ROS's defaults, so that
``Twist()`` is one that is all zero (`types`); their text is ROS's own. Services and the types of
the UWSim packages are in this room, beside the ``.srv`` text they are checked against by a test.
Headers are ROS 2's; the ROS 1 adapter adds ``seq``.
"""

from __future__ import annotations

from .build import floats, header, image, pixels_of, seconds, time_from_seconds
from .point_cloud import point_cloud, points
from .services import Empty, EmptyResponse, GTpublish, GTpublishResponse, Service
from .types import (
    Bool,
    CameraInfo,
    Float32MultiArray,
    Float64,
    Float64MultiArray,
    Header,
    Image,
    JointState,
    MultiArrayDimension,
    MultiArrayLayout,
    Odometry,
    Path,
    Point,
    PointCloud2,
    PointField,
    Pose,
    PoseStamped,
    PoseWithCovariance,
    Quaternion,
    RegionOfInterest,
    String,
    Time,
    Twist,
    TwistStamped,
    TwistWithCovariance,
    Vector3,
    Wrench,
    WrenchStamped,
)

__all__ = [
    "Bool",
    "CameraInfo",
    "Empty",
    "EmptyResponse",
    "Float32MultiArray",
    "Float64",
    "Float64MultiArray",
    "GTpublish",
    "GTpublishResponse",
    "Header",
    "Image",
    "JointState",
    "MultiArrayDimension",
    "MultiArrayLayout",
    "Odometry",
    "Path",
    "Point",
    "PointCloud2",
    "PointField",
    "Pose",
    "PoseStamped",
    "PoseWithCovariance",
    "Quaternion",
    "RegionOfInterest",
    "Service",
    "String",
    "Time",
    "Twist",
    "TwistStamped",
    "TwistWithCovariance",
    "Vector3",
    "Wrench",
    "WrenchStamped",
    "floats",
    "header",
    "image",
    "pixels_of",
    "point_cloud",
    "points",
    "seconds",
    "time_from_seconds",
]
