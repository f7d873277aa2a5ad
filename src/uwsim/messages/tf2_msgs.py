"""Messages of tf2_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field

from rosbags.typesys.stores import ros2_jazzy as ros


@dataclass
class TFMessage(ros.tf2_msgs__msg__TFMessage):
    """Transforms between frames."""

    transforms: list[ros.geometry_msgs__msg__TransformStamped] = field(default_factory=list)
