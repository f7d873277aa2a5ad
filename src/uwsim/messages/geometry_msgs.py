"""Messages of geometry_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from rosbags.typesys.stores import ros2_jazzy as ros

from .std_msgs import Header

_ZEROS_36: Any = partial(np.zeros, 36)
"""What makes the array, anew for each message."""


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
