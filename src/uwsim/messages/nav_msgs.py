"""Messages of nav_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field

from rosbags.typesys.stores import ros2_jazzy as ros

from .geometry_msgs import PoseWithCovariance, TwistWithCovariance
from .std_msgs import Header


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
