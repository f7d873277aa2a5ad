"""Algorithms with which `grasp` is compared.

- ``grasp-p`` has a simpler control law for station keeping.
- ``grasp-truth`` reads the true poses of vehicle and box from ``/truth/odometry`` and ``/tf``,
  which no real vehicle can. Its advantage over `grasp` is the loss due to errors of perception and
  navigation.
- ``grasp-blind-close`` is a sham baseline, which does not search for the box. If it succeeds, the
  benchmark is invalid.

L is the localized world frame, which is used as the navigation frame.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import rotate
from ...bus import Node
from ...messages import (
    Image,
    JointState,
    Odometry,
    String,
    TFMessage,
    Twist,
    TwistStamped,
    Vector3,
    header,
)
from ..navigation import BottomPlane, Navigator
from ..tracker_node import merge_parameters
from .arm import DOWN_POSTURE, JAW, JAW_CLOSED, JAW_OPEN, JOINTS
from .box import BoxPose
from .box_pose import Sighting
from .grasp import Grasp

TRUTH_COVARIANCE = np.diag(np.square([1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3]))
"""The covariance that is assumed for a true pose, (6, 6) [m, rad]."""


class GraspP(Grasp):
    """The algorithm grasp with proportional station keeping: a current c leaves the offset c/kp."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **Grasp.PARAMETERS,
        "ki": 0.0,
        "feed_forward": 0.0,
    }


class GraspTruth(Grasp):
    """The algorithm grasp with the true poses instead of sensors: an upper bound."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **Grasp.PARAMETERS,
        "odometry_topic": "/truth/odometry",
        "frames_topic": "/tf",
        "target": "blackbox",
    }

    def navigation(self, node: Node) -> Navigator:
        """Make a navigator that reads the true pose."""
        return TrueNavigator(node, self.text("odometry_topic"))

    def seabed_depth(self, target: BoxPose) -> float:
        """Return the depth of the seabed under the target at a pose [m]."""
        return float(target.position[2]) + self.box().size[2] / 2.0

    def _subscribe(self, node: Node) -> None:
        super()._subscribe(node)
        node.subscribe(self.text("frames_topic"), TFMessage, self._on_frames)

    def _on_image(self, message: Image) -> None:
        """Ignore the image."""

    def _on_frames(self, message: TFMessage) -> None:
        for frame in message.transforms:
            if frame.child_frame_id.strip("/") != self.text("target"):
                continue
            t, q = frame.transform.translation, frame.transform.rotation
            pose = Pose.from_quaternion(np.array([t.x, t.y, t.z]), np.array([q.w, q.x, q.y, q.z]))
            box_pose = BoxPose.from_pose(pose)
            self._navigator.bottom.set_depth(self.seabed_depth(box_pose))
            if self._phase is not None and self._phase.uses_images:
                sighting = Sighting(
                    pose=box_pose, covariance=TRUTH_COVARIANCE, residual=0.0, source="truth"
                )
                self.task.target.update(sighting, self._node.now)


class TrueNavigator(Navigator):
    """A navigator that reads the true odometry, in L, instead of sensors."""

    def __init__(self, node: Node, topic: str) -> None:
        """Subscribe to the topic of the odometry."""
        self._is_ready, self.bottom = False, BottomPlane()
        self._pose, self._velocity = Pose.identity(), np.zeros(3)
        node.subscribe(topic, Odometry, self._on_odometry)

    @property
    def is_ready(self) -> bool:
        """True if an odometry message has arrived."""
        return self._is_ready

    @property
    def pose(self) -> Pose:
        """The pose ``L_from_base``."""
        return self._pose

    @property
    def velocity(self) -> Array:
        """The velocity of the base over ground, in L, (3,) [m/s]."""
        return self._velocity

    def _on_odometry(self, message: Odometry) -> None:
        p, q = message.pose.pose.position, message.pose.pose.orientation
        v = message.twist.twist.linear
        self._is_ready = True
        self._pose = Pose.from_quaternion(np.array([p.x, p.y, p.z]), np.array([q.w, q.x, q.y, q.z]))
        self._velocity = rotate(self._pose.rotation, np.array([v.x, v.y, v.z]))


class GraspBlindClose:
    """A sham baseline that descends and closes the jaw periodically, without reading images."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "period": 20.0,
        "twist_topic": "/girona500/twist",
        "arm_topic": "/girona500/joint_command",
    }
    """The parameters with their defaults: the ``period`` of the motion [s], and the topics."""

    def start(self, node: Node) -> None:
        """Publish the phase ``search`` and start the timer."""
        self._node = node
        self.parameters = merge_parameters(self.PARAMETERS, node.parameters)
        self._publish_phase = node.publisher("phase", String)
        self._publish_twist = node.publisher(str(self.parameters["twist_topic"]), TwistStamped)
        self._publish_joints = node.publisher(str(self.parameters["arm_topic"]), JointState)
        self._publish_phase(String(data="search"))
        node.create_timer(0.1, self._tick)

    def _tick(self) -> None:
        """Publish the commands: descend for a fifth of the period, close the jaw, later rise."""
        now = self._node.now
        fraction = math.modf(now / float(self.parameters["period"]))[0]
        speed = 0.12 if fraction < 0.2 else -0.12 if fraction > 0.6 else 0.0
        jaw = JAW_CLOSED if 0.25 < fraction < 0.9 else JAW_OPEN
        zero = Vector3(x=0.0, y=0.0, z=0.0)
        twist = Twist(linear=Vector3(x=0.0, y=0.0, z=speed), angular=zero)
        self._publish_twist(TwistStamped(header=header(now), twist=twist))
        self._publish_joints(
            JointState(
                header=header(now),
                name=[*JOINTS, JAW],
                position=np.array([*DOWN_POSTURE.tolist(), jaw]),
                velocity=np.zeros(0),
                effort=np.zeros(0),
            )
        )
