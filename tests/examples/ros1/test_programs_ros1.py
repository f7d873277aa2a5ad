"""Programs of rospy in the manner of UWSim's do to a vehicle what those did."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from tests.middleware.ros1.sea import Sea
from tests.support.ros1_peers import EXAMPLES, needs_ros1, peers
from tests.support.waiting import LIMIT, wait_until
from uwsim.base.geometry import Pose
from uwsim.messages import Float64MultiArray, JointState, Odometry, TwistStamped

pytestmark = [needs_ros1, pytest.mark.slow]
ODOMETRY, COMMAND = "/uwsim/girona500/odom", "/dataNavigator"
PANEL = """
import rospy, sys
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit
rospy.init_node("panel")
shown = rospy.wait_for_message("/uwsim_marker/update_full", InteractiveMarkerInit)
(marker,) = shown.markers
print(marker.name, marker.header.frame_id, len(marker.controls), flush=True)
feedback = InteractiveMarkerFeedback(marker_name=marker.name, event_type=1)
feedback.pose.position.x, feedback.pose.orientation.w = 0.5, 1.0
send = rospy.Publisher("/uwsim_marker/feedback", InteractiveMarkerFeedback, queue_size=1)
while True:
    send.publish(feedback)
    rospy.sleep(0.1)
"""


@pytest.fixture(scope="module")
def sea(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Sea]:
    with peers(tmp_path_factory.mktemp("ros")) as made:
        found = Sea(made)
        yield found
        found.close()


def heard(sea: Sea, topic: str, kind: type, n: int, *program: str) -> list[Any]:
    """Run a program until n of its messages have come, and return these."""
    found: list[Any] = []
    stop = sea.simulation.bus.subscribe(topic, kind, found.append)
    running = sea.peers.start(*program)
    try:
        wait_until(lambda: len(found) >= n or running.poll() is not None, sea.advance)
        assert len(found) >= n, running.communicate(timeout=LIMIT)[1]
    finally:
        stop()
        running.kill()
        running.wait(LIMIT)
        wait_until(lambda: sea.bridge.n_connected(topic) == 0, sea.advance)
    return found[:n]


def pose_of(message: Odometry) -> Pose:
    """The pose of an odometry."""
    p, q = message.pose.pose.position, message.pose.pose.orientation
    return Pose.from_quaternion(np.array([p.x, p.y, p.z]), np.array([q.w, q.x, q.y, q.z]))


def is_at(sea: Sea, wanted: Pose) -> Callable[[], bool]:
    """Whether the vehicle is there, in L."""
    return lambda: np.allclose(sea.simulation.pose("girona500").matrix, wanted.matrix, atol=1e-6)


def turned(roll: float, pitch: float, yaw: float) -> Pose:
    """Rx Ry Rz."""
    turns = ((roll, 0.0, 0.0), (0.0, pitch, 0.0), (0.0, 0.0, yaw))
    x, y, z = (Pose.from_rpy((0.0, 0.0, 0.0), turn) for turn in turns)
    return x @ y @ z


@pytest.mark.parametrize(
    ("program", "topic"),
    [("set_vehicle_pose.py", "/g500/pose"), ("set_vehicle_position.py", COMMAND)],
)
def test_a_vehicle_is_held_at_a_pose(sea: Sea, program: str, topic: str) -> None:
    z = "2.1" if topic == COMMAND else "2.3"
    running = sea.peers.start(program, topic, "0.5", "0.25", z, "0.1", "0.2", "0.3")
    wanted = Pose(np.array([0.5, 0.25, float(z)]), turned(0.1, 0.2, 0.3).rotation)
    wait_until(is_at(sea, wanted), sea.advance)
    running.kill()


def test_a_vehicle_is_driven_by_a_twist(sea: Sea) -> None:
    command = ("set_vehicle_twist.py", "/g500/twist", "0.2", "0", "0", "0", "0", "0.1")
    for message in heard(sea, "/g500/twist", TwistStamped, 3, *command):
        assert message.twist.linear.x == 0.2
        assert message.twist.angular.z == 0.1


@pytest.mark.parametrize("kind", ["absolute", "relative"])
def test_a_program_goes_to_a_pose(sea: Sea, kind: str) -> None:
    start = pose_of(sea.odometry())
    goal = (*("0.8", "0.4", "2.2"), *("0", "0", "1"))
    wanted = Pose(np.array([0.8, 0.4, 2.2]), turned(0.0, 0.0, 1.0).rotation)
    if kind == "relative":
        goal = (*("0.3", "0", "0"), *("0", "0", "-0.5"))
        wanted = start @ Pose(np.array([0.3, 0.0, 0.0]), turned(0.0, 0.0, -0.5).rotation)
    program = sea.peers.start("goto_pose.py", kind, ODOMETRY, COMMAND, *goal)
    assert sea.output(program) == "goal reached\n"
    wait_until(is_at(sea, wanted), sea.advance)


def test_a_survey_has_lanes(sea: Sea) -> None:
    survey = ("make_vehicle_survey.py", COMMAND, "0", "0.5", "2", "9", "2", "-0.5")
    for message in heard(sea, COMMAND, Odometry, 30, *survey):
        at = pose_of(message)
        a = math.asin(at.position[0] / 2)
        assert at.position[1] == pytest.approx(0.5 - 0.5 * a)
        assert at.position[2] == 2.0
        yaw = -math.pi / 2 * (1 - math.cos(a))
        np.testing.assert_allclose(at.rotation, turned(0.0, 0.0, yaw).rotation, atol=1e-9)


def test_disturbances_rock_a_vehicle(sea: Sea) -> None:
    start = pose_of(sea.odometry())
    amplitudes = ("0.1", "0.2", "0.3", "0", "0", "0.4")
    rock = ("set_vehicle_disturbances.py", ODOMETRY, COMMAND, *amplitudes)
    for message in heard(sea, COMMAND, Odometry, 20, *rock):
        moved = start.inverse() @ pose_of(message)
        a = math.asin(np.clip(moved.position[2] / 0.3, -1.0, 1.0))
        assert moved.position[0] == pytest.approx(0.1 * math.sin(2 * a), abs=1e-6)
        assert moved.position[1] == pytest.approx(0.2 * math.sin(a), abs=1e-6)
        yaw = turned(0.0, 0.0, 0.4 * math.sin(a)).rotation
        np.testing.assert_allclose(moved.rotation, yaw, atol=1e-6)


def test_thrusters_are_commanded(sea: Sea) -> None:
    topic = "/g500/thrusters_input"
    command = ("set_vehicle_actuators.py", topic, "0.1", "-0.2", "0.3")
    for message in heard(sea, topic, Float64MultiArray, 2, *command):
        assert [*message.data] == [0.1, -0.2, 0.3]


def test_joints_move_at_velocities(sea: Sea) -> None:
    topic = "/uwsim/joint_state_command"
    command = ("set_joint_velocity.py", topic, "0.1", "0", "0", "0", "-0.1")
    for message in heard(sea, topic, JointState, 3, *command):
        assert [*message.name] == ["Slew", "Shoulder", "Elbow", "JawRotate", "JawOpening"]
        assert [*message.velocity] == [0.1, 0.0, 0.0, 0.0, -0.1]
        assert len(message.position) == 0


def test_a_vehicle_follows_an_interactive_marker(sea: Sea) -> None:
    server = sea.peers.start("follow_marker.py", COMMAND, "0.1", "0.2", "2", "0", "0", "0.3")
    panel = sea.peers.start("/usr/bin/python3", "-c", PANEL)
    wanted = Pose(np.array([0.6, 0.2, 2.0]), turned(0.0, 0.0, 0.3).rotation)
    wait_until(is_at(sea, wanted), sea.advance)
    for program in (panel, server):
        program.kill()
    assert panel.communicate(timeout=LIMIT)[0] == "uwsim_marker world 7\n"


@pytest.mark.parametrize(
    "program",
    [path.name for path in sorted(EXAMPLES.glob("*.py")) if "argv" in path.read_text()],
)
def test_a_program_without_arguments_says_how_it_is_called(sea: Sea, program: str) -> None:
    running = sea.peers.start(program)
    wait_until(lambda: running.poll() is not None, sea.advance)
    _, errors = running.communicate(timeout=LIMIT)
    assert running.returncode != 0
    assert program in errors
    assert "Traceback" not in errors


RUBBISH = {
    "goto_pose.py": "absolute /odom /command 1 2 x 0 0 0",
    "goto_position.py": "/odom /pose 1 2 nan",
    "image_echo.py": "/camera 1.5",
    "keep_station.py": "/odom /twist 1 2 deep",
    "set_vehicle_pose.py": "/pose 1 2 3 0 0 inf",
    "set_vehicle_position.py": "/command 1 2 3 0 0 east",
    "set_vehicle_velocity.py": "/command 1 2 3 0 0 -",
    "set_vehicle_twist.py": "/twist 1 2 3 0 0 ''",
    "set_vehicle_actuators.py": "/thrusters 0.1 full",
    "set_vehicle_disturbances.py": "/odom /command 1 2 3 0 0 1e999",
    "make_vehicle_survey.py": "/command 1 2 3 0 0 x",
    "set_joint_position.py": "/arm 1 2 3 0 open",
    "set_joint_velocity.py": "/arm 1 2 3 0 fast",
    "follow_marker.py": "/command 1 2 3 0 0 up",
}


@pytest.mark.parametrize("program", RUBBISH)
def test_arguments_that_are_none_end_a_program_with_its_usage(sea: Sea, program: str) -> None:
    words = RUBBISH[program].split()
    running = sea.peers.start(program, *(word.strip("'") for word in words))
    _, errors = running.communicate(timeout=LIMIT)
    assert running.returncode in (1, 2)
    assert "Traceback" not in errors
    assert program in errors  # the usage
    assert words[-1].strip("'") in errors or words[0] in errors
