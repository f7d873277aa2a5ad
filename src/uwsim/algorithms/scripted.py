"""``scripted``: calls services and publishes at given times, and drives at a constant twist."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import ClassVar

import numpy as np

from ..bus import Node
from ..errors import BadSetting, UnknownName
from ..messages import (
    Bool,
    Empty,
    Odometry,
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistStamped,
    TwistWithCovariance,
    Vector3,
    header,
)
from .tracker_node import chosen

PERIOD = 0.1
"""Between two twists, and between two calls of what starts [s]."""


class Scripted:
    """Starts and stops benchmarks on time, and drives at a constant twist: no tracker at all.

    Services and topics are named with blanks between them. What starts is called, or told yes
    (std_msgs/Bool), again and again, so that every level and measure that waits for it begins;
    what stops is used every ``stop_after`` seconds, so that it ends one level after the other.
    Services that are not offered are skipped.
    """

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "start": "startBench",
        "start_topics": "",
        "start_after": 0.0,
        "stop": "stopBench",
        "stop_topics": "",
        "stop_after": 10.0,
        "twist_topic": "",
        "odom_topic": "",
        "twist": "0 0 0 0 0 0",
    }

    def start(self, node: Node) -> None:
        """Set the timers."""
        self._node = node
        self.parameters = chosen(self.PARAMETERS, node.parameters)
        begun, start_after = node.now, float(self.parameters["start_after"])
        stop_after = float(self.parameters["stop_after"])
        starts, stops = self._doer("start"), self._doer("stop")

        def begin() -> None:
            if node.now >= begun + start_after - 1e-9:
                starts()

        def end() -> None:
            if node.now > begun:  # a timer goes off at once, too
                stops()

        node.create_timer(PERIOD, begin)
        if stop_after > 0.0:
            node.create_timer(stop_after, end)
        twist = twist_of(str(self.parameters["twist"]))
        if topic := str(self.parameters["twist_topic"]):
            say = node.publisher(topic, TwistStamped)
            node.create_timer(
                PERIOD, lambda: say(TwistStamped(header=header(node.now), twist=twist))
            )
        if topic := str(self.parameters["odom_topic"]):
            tell = node.publisher(topic, Odometry)
            node.create_timer(PERIOD, lambda: tell(odometry(node.now, twist)))

    def _doer(self, what: str) -> Doer:
        services = str(self.parameters[what]).split()
        topics = str(self.parameters[f"{what}_topics"]).split()
        return Doer(self._node, services, topics)


class Doer:
    """Calls services and publishes true on topics."""

    def __init__(self, node: Node, services: list[str], topics: list[str]) -> None:
        self._node, self._services = node, services
        self._say = [node.publisher(topic, Bool) for topic in topics]

    def __call__(self) -> None:
        """Call the services and publish on the topics."""
        for service in self._services:
            with suppress(UnknownName):  # nobody waits for it just now
                self._node.call(service, Empty())
        for say in self._say:
            say(Bool(data=True))


def twist_of(text: str) -> Twist:
    """A twist from six numbers: along x, y, z [m/s] and about them [rad/s].

    Raises:
        BadSetting: it is no six finite numbers.
    """
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError:
        numbers = []
    if len(numbers) != 6 or not all(map(math.isfinite, numbers)):
        raise BadSetting(
            f"Parameter 'twist' of the algorithm is {text!r}; expected six numbers: along x, y, z "
            "[m/s] and about them [rad/s]."
        )
    vx, vy, vz, wx, wy, wz = numbers
    return Twist(linear=Vector3(x=vx, y=vy, z=vz), angular=Vector3(x=wx, y=wy, z=wz))


def odometry(time: float, twist: Twist) -> Odometry:
    """A message with a twist for ``ROSOdomToPAT``: its pose is all zero."""
    upright = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    nowhere = Pose(position=Point(x=0.0, y=0.0, z=0.0), orientation=upright)
    return Odometry(
        header=header(time),
        child_frame_id="",
        pose=PoseWithCovariance(pose=nowhere, covariance=np.zeros(36)),
        twist=TwistWithCovariance(twist=twist, covariance=np.zeros(36)),
    )
