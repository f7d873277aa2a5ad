"""Commands that are not followed, or not as they are, are told: topic, sender, field, expected."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from tests.middleware.ros1.nodes import Graph
from tests.middleware.test_bridge import FakeBridge
from tests.middleware.web.test_web import Setting, send
from tests.simulation.girona500 import make
from tests.support.waiting import wait_until
from uwsim.bus import Node
from uwsim.messages import (
    Float64MultiArray,
    JointState,
    MultiArrayLayout,
    Odometry,
    Point,
    Pose,
    Quaternion,
    Twist,
    TwistStamped,
    Vector3,
    Wrench,
    WrenchStamped,
    header,
)
from uwsim.simulation import Simulation
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.ros_odom_to_pat import ROSOdomToPATSpec
from uwsim.topics.ros_pose_to_pat import ROSPoseToPATSpec
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec
from uwsim.topics.thruster_commands import ROSThrustersToPATSpec, ROSWrenchToPATSpec

NAME = "girona500"
INTERFACES = (
    ROSTwistToPATSpec(topic="/twist", vehicle_name=NAME),
    ROSPoseToPATSpec(topic="/pose", vehicle_name=NAME),
    ROSOdomToPATSpec(topic="/odometry", vehicle_name=NAME),
    ROSThrustersToPATSpec(topic="/thrusters", vehicle_name=NAME),
    ROSWrenchToPATSpec(topic="/wrench", vehicle_name=NAME),
    ROSJointStateToArmSpec(topic="/arm", vehicle_name=NAME),
)
FINITE = "expected a finite number; it is not followed"
MOST = "expected -1e+06 to 1e+06; the nearest is taken"


@pytest.fixture
def simulation() -> Iterator[Simulation]:
    with make(INTERFACES) as made:
        yield made


def twist(x: float) -> TwistStamped:
    return TwistStamped(header=header(0.0), twist=Twist(linear=Vector3(x=x)))


def numbers(*values: float) -> Float64MultiArray:
    return Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=np.array(values))


def odometry(*, x: float = 0.0, forward: float = 0.0) -> Odometry:
    message = Odometry(header=header(0.0, "world"), child_frame_id="g500")
    message.pose.pose = Pose(
        position=Point(x=x, y=0.0, z=0.0), orientation=Quaternion(0.0, 0.0, 0.0, 0.0)
    )
    message.twist.twist = Twist(linear=Vector3(x=forward))
    return message


COMMANDS: dict[str, tuple[str, Any, str]] = {
    "a twist": ("twist", twist(math.nan), f"twist.linear.x is nan; {FINITE}"),
    "a large twist": ("twist", twist(1e300), f"twist.linear.x is 1e+300; {MOST}"),
    "a pose": (
        "pose",
        Pose(position=Point(x=0.0, y=-math.inf, z=0.0), orientation=Quaternion(w=1.0)),
        f"position.y is -inf; {FINITE}",
    ),
    "a turn": (
        "pose",
        Pose(position=Point(x=0.0, y=0.0, z=3.0), orientation=Quaternion(w=math.nan)),
        "orientation.w is nan; expected a finite number; it counts as no rotation",
    ),
    "odometry": ("odometry", odometry(x=math.nan), f"pose.pose.position.x is nan; {FINITE}"),
    "its twist": ("odometry", odometry(forward=1e9), f"twist.twist.linear.x is 1e+09; {MOST}"),
    "a thruster": ("thrusters", numbers(0, 0, math.inf, 0, 0), f"data[2] is inf; {FINITE}"),
    "a wrench": (
        "wrench",
        WrenchStamped(header=header(0.0), wrench=Wrench(torque=Vector3(z=math.nan))),
        f"wrench.torque.z is nan; {FINITE}",
    ),
    "a joint": (
        "arm",
        JointState(header=header(0.0), name=["joint"], velocity=np.array([math.nan])),
        f"velocity[0] is nan; {FINITE}",
    ),
}


@pytest.mark.parametrize("case", COMMANDS)
def test_a_command_that_cannot_be_followed_as_it_is_is_told_once(
    simulation: Simulation, capsys: pytest.CaptureFixture[str], case: str
) -> None:
    topic, message, said = COMMANDS[case]
    for _ in range(3):
        simulation.publish(topic, message)
        simulation.advance()
    assert capsys.readouterr().err == f"uwsim: warning: /{topic}: {said}\n"


def test_what_is_not_finite_and_what_is_large_are_told_once_each(
    simulation: Simulation, capsys: pytest.CaptureFixture[str]
) -> None:
    for value in (1e7, math.nan, 1e9, math.inf, 1.0):
        simulation.publish("twist", twist(value))
    assert capsys.readouterr().err.splitlines() == [
        f"uwsim: warning: /twist: twist.linear.x is 1e+07; {MOST}",
        f"uwsim: warning: /twist: twist.linear.x is nan; {FINITE}",
    ]


def test_an_algorithm_that_sends_it_is_named(
    simulation: Simulation, capsys: pytest.CaptureFixture[str]
) -> None:
    class Divides:
        def start(self, node: Node) -> None:
            node.publisher("/twist", TwistStamped)(twist(math.nan))

    simulation.attach(Divides())
    said = f"uwsim: warning: Divides: /twist: twist.linear.x is nan; {FINITE}\n"
    assert capsys.readouterr().err == said


def test_a_client_that_sends_it_is_named_in_the_log_of_its_transport(
    simulation: Simulation,
) -> None:
    bridge = FakeBridge(simulation.bus)
    for _ in range(3):
        bridge.put("/twist", twist(math.nan), "client 127.0.0.1:1")
        bridge.step()
    said = "/twist: in a message of client 127.0.0.1:1, twist.linear.x is nan"
    assert bridge.lines == [f"uwsim: test: {said}; {FINITE}"]


def test_a_node_of_ros_1_that_sends_it_is_named() -> None:
    graph = Graph()
    try:
        sim, other = graph.node(), graph.node("/my_pilot")
        sim.bus.subscribe(
            "twist", TwistStamped, lambda _: None, remark=lambda _: ("it is odd", "another")
        )
        publish = other.bus.publisher("twist", TwistStamped)
        graph.wait_until_ready()
        wait_until(lambda: other.bus.has_subscribers("twist"), graph.step)
        publish(twist(1.0))
        wait_until(lambda: "it is odd" in "".join(graph.lines), graph.step)
        [line] = [line for line in graph.lines if "it is odd" in line]
        said = "/twist: in a message of node /my_pilot, it is odd; expected another"
        assert line == f"uwsim: test: {said}"
    finally:
        graph.close()


def test_a_web_client_that_sends_it_is_named() -> None:
    setting = Setting()
    try:
        setting.bus.subscribe(
            "twist", TwistStamped, lambda _: None, remark=lambda _: ("it is odd", "another")
        )
        client = setting.client()
        send(client, op="publish", topic="/twist", msg={})
        setting.step_until(lambda: "it is odd" in "".join(setting.lines))
        host, port = client.local_address[:2]
        said = f"/twist: in a message of client {host}:{port}, it is odd; expected another"
        assert f"uwsim: web: {said}" in setting.lines
    finally:
        setting.close()
