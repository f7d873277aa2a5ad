"""``scripted``: an algorithm that starts and stops benchmarks and commands a constant twist."""

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
from .tracker_node import merge_parameters

PERIOD = 0.1
"""The time between two twists, and between two start signals [s]."""


class ScriptedPilot:
    """A script that starts and stops benchmarks at set times and commands a constant twist.

    A start or stop signal calls services and publishes true (std_msgs/Bool) on topics, whose names
    are separated by blanks in the parameters. From ``start_after`` on, the start signal is sent
    every `PERIOD`, so that every level and measure that waits for it starts. The stop signal is
    sent every ``stop_after`` seconds and ends one level after the other. Services that are not
    offered are skipped.
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
    """The parameters with their defaults: services and topics of the two signals, their times [s],
    and a twist (`parse_twist`), which is published on the topics that are not empty."""

    def start(self, node: Node) -> None:
        """Read the parameters and start the timers."""
        self._node = node
        self.parameters = merge_parameters(self.PARAMETERS, node.parameters)
        start_time, start_after = node.now, float(self.parameters["start_after"])
        stop_after = float(self.parameters["stop_after"])
        send_start, send_stop = self._signal("start"), self._signal("stop")

        def begin() -> None:
            if node.now >= start_time + start_after - 1e-9:
                send_start()

        def end() -> None:
            if node.now > start_time:  # a timer calls at once, too
                send_stop()

        node.create_timer(PERIOD, begin)
        if stop_after > 0.0:
            node.create_timer(stop_after, end)
        twist = parse_twist(str(self.parameters["twist"]))
        if topic := str(self.parameters["twist_topic"]):
            publish_twist = node.publisher(topic, TwistStamped)
            node.create_timer(
                PERIOD, lambda: publish_twist(TwistStamped(header=header(node.now), twist=twist))
            )
        if topic := str(self.parameters["odom_topic"]):
            publish_odometry = node.publisher(topic, Odometry)
            node.create_timer(PERIOD, lambda: publish_odometry(odometry_message(node.now, twist)))

    def _signal(self, name: str) -> Signal:
        services = str(self.parameters[name]).split()
        topics = str(self.parameters[f"{name}_topics"]).split()
        return Signal(self._node, services, topics)


class Signal:
    """A signal to benchmarks: when called, it calls services and publishes true on topics."""

    def __init__(self, node: Node, services: list[str], topics: list[str]) -> None:
        self._node, self._services = node, services
        self._publishers = [node.publisher(topic, Bool) for topic in topics]

    def __call__(self) -> None:
        """Call the services and publish on the topics."""
        for service in self._services:
            with suppress(UnknownName):  # the benchmark does not wait for it now
                self._node.call(service, Empty())
        for publish in self._publishers:
            publish(Bool(data=True))


def parse_twist(text: str) -> Twist:
    """Parse a twist of six numbers: velocities along x, y, z [m/s] and about them [rad/s].

    Raises:
        BadSetting: the text is not six finite numbers.
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


def odometry_message(time: float, twist: Twist) -> Odometry:
    """Make a message with a twist for ``ROSOdomToPAT``; the pose in it is the identity.

    ``time`` is the time of its stamp [s].
    """
    identity = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    origin = Pose(position=Point(x=0.0, y=0.0, z=0.0), orientation=identity)
    return Odometry(
        header=header(time),
        child_frame_id="",
        pose=PoseWithCovariance(pose=origin, covariance=np.zeros(36)),
        twist=TwistWithCovariance(twist=twist, covariance=np.zeros(36)),
    )
