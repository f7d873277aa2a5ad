"""ROS message and service types: what travels on the bus.

Messages are the ROS 2 (Jazzy) dataclasses that rosbags ships; their text is ROS's own. Services
and the types of the UWSim packages are in this room, beside the ``.srv`` text they are checked
against by a test. Headers are ROS 2's; the ROS 1 adapter adds ``seq``.
"""

from __future__ import annotations

from rosbags.typesys.stores.ros2_jazzy import (
    builtin_interfaces__msg__Time as Time,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__Point as Point,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__Pose as Pose,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__PoseStamped as PoseStamped,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__PoseWithCovariance as PoseWithCovariance,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__Quaternion as Quaternion,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__Twist as Twist,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__TwistStamped as TwistStamped,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__TwistWithCovariance as TwistWithCovariance,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__Vector3 as Vector3,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__Wrench as Wrench,
)
from rosbags.typesys.stores.ros2_jazzy import (
    geometry_msgs__msg__WrenchStamped as WrenchStamped,
)
from rosbags.typesys.stores.ros2_jazzy import (
    nav_msgs__msg__Odometry as Odometry,
)
from rosbags.typesys.stores.ros2_jazzy import (
    nav_msgs__msg__Path as Path,
)
from rosbags.typesys.stores.ros2_jazzy import (
    sensor_msgs__msg__CameraInfo as CameraInfo,
)
from rosbags.typesys.stores.ros2_jazzy import (
    sensor_msgs__msg__Image as Image,
)
from rosbags.typesys.stores.ros2_jazzy import (
    sensor_msgs__msg__JointState as JointState,
)
from rosbags.typesys.stores.ros2_jazzy import (
    sensor_msgs__msg__PointCloud2 as PointCloud2,
)
from rosbags.typesys.stores.ros2_jazzy import (
    sensor_msgs__msg__PointField as PointField,
)
from rosbags.typesys.stores.ros2_jazzy import (
    sensor_msgs__msg__RegionOfInterest as RegionOfInterest,
)
from rosbags.typesys.stores.ros2_jazzy import (
    std_msgs__msg__Bool as Bool,
)
from rosbags.typesys.stores.ros2_jazzy import (
    std_msgs__msg__Float32MultiArray as Float32MultiArray,
)
from rosbags.typesys.stores.ros2_jazzy import (
    std_msgs__msg__Float64 as Float64,
)
from rosbags.typesys.stores.ros2_jazzy import (
    std_msgs__msg__Float64MultiArray as Float64MultiArray,
)
from rosbags.typesys.stores.ros2_jazzy import (
    std_msgs__msg__Header as Header,
)
from rosbags.typesys.stores.ros2_jazzy import (
    std_msgs__msg__MultiArrayDimension as MultiArrayDimension,
)
from rosbags.typesys.stores.ros2_jazzy import (
    std_msgs__msg__MultiArrayLayout as MultiArrayLayout,
)
from rosbags.typesys.stores.ros2_jazzy import (
    std_msgs__msg__String as String,
)

from .build import floats, header, image, picture, seconds, time_from_seconds
from .point_cloud import point_cloud, points
from .services import Empty, EmptyResponse, GTpublish, GTpublishResponse, Service

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
    "picture",
    "point_cloud",
    "points",
    "seconds",
    "time_from_seconds",
]
