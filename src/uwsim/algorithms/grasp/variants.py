"""What `grasp` is compared with: a simpler station keeping, the truth instead of senses, controls.

``grasp-truth`` does what no vehicle can: it reads where vehicle and box are from
``/truth/odometry`` and ``/tf``. It shows what perception and navigation cost. ``grasp-nothing`` and
``grasp-blind-close`` do nothing useful: a benchmark in which one of them succeeds measures nothing.
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
from .arm import CLOSED, DOWN, JAW, JOINTS, OPEN
from .box import BoxPose
from .box_pose import Sighting
from .grasp import Grasp

SURE = np.diag(np.square([1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3]))
"""Covariance of the truth, (6, 6)."""


class GraspP(Grasp):
    """The algorithm grasp with proportional station keeping: a current c leaves the offset c/kp."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **Grasp.PARAMETERS,
        "ki": 0.0,
        "feed_forward": 0.0,
    }


class GraspTruth(Grasp):
    """The algorithm grasp without senses: reads the true poses. An upper bound, no competitor."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **Grasp.PARAMETERS,
        "odometry_topic": "/truth/odometry",
        "frames_topic": "/tf",
        "target": "blackbox",
    }

    def navigation(self, node: Node) -> Navigator:
        """Return the truth: its pose is set by odometry."""
        return TrueNavigator(node, self.text("odometry_topic"))

    def _subscribe(self, node: Node) -> None:
        super()._subscribe(node)
        node.subscribe(self.text("frames_topic"), TFMessage, self._on_frames)

    def _on_image(self, message: Image) -> None:
        """See nothing."""

    def _on_frames(self, message: TFMessage) -> None:
        for one in message.transforms:
            if one.child_frame_id.strip("/") != self.text("target"):
                continue
            t, q = one.transform.translation, one.transform.rotation
            pose = Pose.from_quaternion(np.array([t.x, t.y, t.z]), np.array([q.w, q.x, q.y, q.z]))
            true = BoxPose.from_pose(pose)
            depth = float(true.place[2]) + self.box().size[2] / 2.0
            self._navigator.bottom.set_depth(depth)
            if self._phase is not None and self._phase.looks:
                found = Sighting(pose=true, covariance=SURE, residual=0.0, source="truth")
                self.task.target.take(found, self._node.now)


class TrueNavigator(Navigator):
    """A navigator that is told the truth, in L."""

    def __init__(self, node: Node, topic: str) -> None:
        """Subscribe to the odometry."""
        self._is_ready, self.bottom = False, BottomPlane()
        self._pose, self._velocity = Pose.identity(), np.zeros(3)
        node.subscribe(topic, Odometry, self._on_odometry)

    @property
    def is_ready(self) -> bool:
        """Whether odometry has come."""
        return self._is_ready

    @property
    def pose(self) -> Pose:
        """``L_from_base``."""
        return self._pose

    @property
    def velocity(self) -> Array:
        """Over ground, in L, (3,) [m/s]."""
        return self._velocity

    def _on_odometry(self, message: Odometry) -> None:
        p, q = message.pose.pose.position, message.pose.pose.orientation
        v = message.twist.twist.linear
        self._is_ready = True
        self._pose = Pose.from_quaternion(np.array([p.x, p.y, p.z]), np.array([q.w, q.x, q.y, q.z]))
        self._velocity = rotate(self._pose.rotation, np.array([v.x, v.y, v.z]))


class GraspNothing:
    """Does nothing: the control that must never succeed."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {}

    def start(self, node: Node) -> None:
        """Say that it gives up searching at once."""
        self.parameters = merge_parameters(self.PARAMETERS, node.parameters)
        say = node.publisher("phase", String)
        say(String(data="search"))


class GraspBlindClose:
    """Goes down where it is and closes the jaw, again and again: a control without senses."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "period": 20.0,
        "twist_topic": "/girona500/twist",
        "arm_topic": "/girona500/joint_command",
    }

    def start(self, node: Node) -> None:
        """Begin the rounds."""
        self._node = node
        self.parameters = merge_parameters(self.PARAMETERS, node.parameters)
        self._say_phase = node.publisher("phase", String)
        self._say_twist = node.publisher(str(self.parameters["twist_topic"]), TwistStamped)
        self._say_joints = node.publisher(str(self.parameters["arm_topic"]), JointState)
        self._say_phase(String(data="search"))
        node.create_timer(0.1, self._tick)

    def _tick(self) -> None:
        """Down for a fifth of a round, close, up for a fifth."""
        now = self._node.now
        share = math.modf(now / float(self.parameters["period"]))[0]
        speed = 0.12 if share < 0.2 else -0.12 if share > 0.6 else 0.0
        jaw = CLOSED if 0.25 < share < 0.9 else OPEN
        still = Vector3(x=0.0, y=0.0, z=0.0)
        twist = Twist(linear=Vector3(x=0.0, y=0.0, z=speed), angular=still)
        self._say_twist(TwistStamped(header=header(now), twist=twist))
        self._say_joints(
            JointState(
                header=header(now),
                name=[*JOINTS, JAW],
                position=np.array([*DOWN.tolist(), jaw]),
                velocity=np.zeros(0),
                effort=np.zeros(0),
            )
        )
