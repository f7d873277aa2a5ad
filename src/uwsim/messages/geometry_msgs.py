"""Messages of geometry_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np

from .std_msgs import Header

_ZEROS_36: Any = partial(np.zeros, 36)
"""What makes the array, anew for each message."""


@dataclass
class Point:
    """A place [m]."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/Point"


@dataclass
class Vector3:
    """A direction with a length."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/Vector3"


@dataclass
class Quaternion:
    """A rotation; the identity by default (w is 1)."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    w: float = 1.0
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/Quaternion"


@dataclass
class Pose:
    """A place and a rotation."""

    position: Point = field(default_factory=Point)
    orientation: Quaternion = field(default_factory=Quaternion)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/Pose"


@dataclass
class PoseStamped:
    """A pose, with its time and frame."""

    header: Header = field(default_factory=Header)
    pose: Pose = field(default_factory=Pose)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/PoseStamped"


@dataclass
class PoseWithCovariance:
    """A pose and its 6x6 covariance, by rows."""

    pose: Pose = field(default_factory=Pose)
    covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_36)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/PoseWithCovariance"


@dataclass
class Twist:
    """Linear [m/s] and angular [rad/s] velocity."""

    linear: Vector3 = field(default_factory=Vector3)
    angular: Vector3 = field(default_factory=Vector3)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/Twist"


@dataclass
class TwistStamped:
    """A twist, with its time and frame."""

    header: Header = field(default_factory=Header)
    twist: Twist = field(default_factory=Twist)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/TwistStamped"


@dataclass
class TwistWithCovariance:
    """A twist and its 6x6 covariance, by rows."""

    twist: Twist = field(default_factory=Twist)
    covariance: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_36)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/TwistWithCovariance"


@dataclass
class Wrench:
    """Force [N] and torque [N m]."""

    force: Vector3 = field(default_factory=Vector3)
    torque: Vector3 = field(default_factory=Vector3)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/Wrench"


@dataclass
class WrenchStamped:
    """A wrench, with its time and frame."""

    header: Header = field(default_factory=Header)
    wrench: Wrench = field(default_factory=Wrench)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/WrenchStamped"


@dataclass
class Transform:
    """Where a frame is in another: its origin [m] and its rotation."""

    translation: Vector3 = field(default_factory=Vector3)
    rotation: Quaternion = field(default_factory=Quaternion)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/Transform"


@dataclass
class TransformStamped:
    """A transform with its time, the frame it is in and the frame it is of."""

    header: Header = field(default_factory=Header)
    child_frame_id: str = ""
    transform: Transform = field(default_factory=Transform)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/TransformStamped"
