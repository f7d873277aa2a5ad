"""Messages of tf2_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from .geometry_msgs import TransformStamped


@dataclass
class TFMessage:
    """Transforms between frames."""

    transforms: list[TransformStamped] = field(default_factory=list)
    __msgtype__: ClassVar[str] = "tf2_msgs/msg/TFMessage"
