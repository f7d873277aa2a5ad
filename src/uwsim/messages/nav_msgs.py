"""Messages of nav_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from .geometry_msgs import PoseStamped, PoseWithCovariance, TwistWithCovariance
from .std_msgs import Header


@dataclass
class Odometry:
    """Pose and velocity of a vehicle."""

    header: Header = field(default_factory=Header)
    child_frame_id: str = ""
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)
    twist: TwistWithCovariance = field(default_factory=TwistWithCovariance)
    __msgtype__: ClassVar[str] = "nav_msgs/msg/Odometry"


@dataclass
class Path:
    """Poses, one after the other."""

    header: Header = field(default_factory=Header)
    poses: list[PoseStamped] = field(default_factory=list)
    __msgtype__: ClassVar[str] = "nav_msgs/msg/Path"
