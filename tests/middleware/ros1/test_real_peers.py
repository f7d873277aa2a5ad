"""Debian's ROS 1 against the scene cirs: tools see it, rospy programs drive it."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

import uwsim
from tests.middleware.ros1.sea import Sea
from tests.support.ros1_peers import needs_ros1, peers
from tests.support.waiting import LIMIT, wait_until
from uwsim.middleware.types import wire_type

pytestmark = [needs_ros1, pytest.mark.slow]


@pytest.fixture(scope="module")
def sea(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Sea]:
    with peers(tmp_path_factory.mktemp("ros")) as new_sea:
        actual = Sea(new_sea)
        yield actual
        actual.close()


def test_the_tools_see_its_topics_and_services(sea: Sea) -> None:
    topics = sea.output(sea.peers.start("rostopic", "list")).split()
    assert {"/uwsim/girona500/odom", "/dataNavigator", "/uwsim/camera1", "/clock", "/tf"} <= set(
        topics
    )
    assert "/SpawnMarker" in sea.output(sea.peers.start("rosservice", "list"))
    description = sea.output(sea.peers.start("rosnode", "info", "/uwsim"))
    assert " * /uwsim/girona500/odom [nav_msgs/Odometry]" in description
    assert " * /dataNavigator" in description
    assert sea.output(sea.peers.start("rosparam", "get", "/use_sim_time")).strip() == "true"


def test_rostopic_echoes_a_message(sea: Sea) -> None:
    echo = sea.peers.start("rostopic", "echo", "-n", "1", "/uwsim/girona500/odom")
    lines = sea.output(echo)
    assert "secs:" in lines
    assert "orientation:" in lines


def test_rostopic_hz_finds_a_rate(sea: Sea) -> None:
    lines: list[str] = []
    program = sea.peers.start("rostopic", "hz", "/uwsim/girona500/odom")
    assert program.stdout is not None
    reader = threading.Thread(target=lines.extend, args=(program.stdout,), daemon=True)
    reader.start()
    wait_until(lambda: any(line.startswith("average rate: ") for line in lines), sea.advance)
    program.kill()  # on Ctrl-C rospy asks the master first, which is neither ours nor tested here
    wait_until(lambda: not reader.is_alive(), sea.advance)


def test_the_robot_is_told_to_a_node_that_comes_late(sea: Sea) -> None:
    publish = sea.simulation.bus.publisher("robot_description", uwsim.messages.String)
    publish(uwsim.messages.String(data="<robot/>"))
    sea.advance()
    assert sea.bridge.wait(LIMIT)
    echo = sea.peers.start("rostopic", "echo", "-n", "1", "/robot_description")
    assert 'data: "<robot/>"' in sea.output(echo)


def test_a_program_of_the_originals_kind_drives_the_vehicle(sea: Sea) -> None:
    value_before = sea.odometry().pose.pose
    program = sea.peers.start(
        "set_vehicle_velocity.py", "/dataNavigator", *("0.2", "0", "0", "0", "0", "0")
    )

    def has_moved() -> float:
        now = sea.odometry().pose.pose.position
        return math.dist((now.x, now.y), (value_before.position.x, value_before.position.y))

    wait_until(lambda: has_moved() > 0.1, sea.advance)
    assert program.poll() is None
    program.kill()


def test_a_program_of_the_originals_kind_moves_the_arm(sea: Sea) -> None:
    program = sea.peers.start(
        "set_joint_position.py", "/uwsim/joint_state_command", *("0.3", "0.5", "1", "0", "0.2")
    )
    sea.simulation.latest_message("/uwsim/joint_state")

    def slew() -> float:
        actual = sea.simulation.latest_message("/uwsim/joint_state")
        return math.nan if actual is None else float(actual.position[0])

    wait_until(lambda: math.isclose(slew(), 0.3, abs_tol=1e-6), sea.advance)
    program.kill()


def test_a_program_closes_a_loop_over_odometry_and_pose(sea: Sea) -> None:
    goto = ("goto_position.py", "/uwsim/girona500/odom", "/g500/pose", "0.8", "0.4", "2.2")
    assert sea.output(sea.peers.start(*goto)) == "goal reached\n"
    place = sea.odometry().pose.pose.position
    assert math.dist((place.x, place.y, place.z), (0.8, 0.4, 2.2)) < 0.02


def test_a_program_sees_the_images_of_a_camera_and_no_others_are_rendered(sea: Sea) -> None:
    assert not sea.simulation.bus.has_subscribers("/uwsim/camera1")
    echo = sea.peers.start("image_echo.py", "/uwsim/camera1", "2")
    lines = sea.output(echo).splitlines()
    assert len(lines) == 2
    assert all("320x240 rgb8" in line for line in lines)
    assert not sea.simulation.bus.has_subscribers("/uwsim/camera2")
    wait_until(lambda: not sea.simulation.bus.has_subscribers("/uwsim/camera1"), sea.advance)


def test_the_sums_of_types_are_those_of_ros(sea: Sea) -> None:
    kinds = {
        actual.ros1_name: actual.md5
        for entry in vars(uwsim.messages).values()
        if isinstance(entry, type) and (actual := wire_type(entry)) is not None and actual.md5
    }
    expected = [
        name for name in kinds if name.startswith(("std_msgs", "geometry_", "sensor_", "nav_"))
    ]
    assert len(expected) > 30
    for name, line in zip(
        expected,
        sea.output(
            sea.peers.start(
                "/usr/bin/python3",
                "-c",
                "import sys, importlib\n"
                "for name in sys.argv[1:]:\n"
                "    package, kind = name.split('/')\n"
                "    module = importlib.import_module(package + '.msg')\n"
                "    print(getattr(getattr(module, kind, None), '_md5sum', ''))",
                *expected,
            )
        ).splitlines(),
        strict=True,
    ):
        assert line in (kinds[name], ""), name


def test_a_master_killed_and_started_again_has_the_topics_back(sea: Sea) -> None:
    sea.peers.kill_master()
    wait_until(lambda: any("is tried again" in line for line in sea.lines), sea.advance)
    sea.peers.start_master()
    wait_until(lambda: any("restarted" in line for line in sea.lines), sea.advance)
    assert sea.bridge.wait(LIMIT)
    topic_list = sea.output(sea.peers.start("rostopic", "list"))
    assert "/uwsim/girona500/odom" in topic_list


def test_a_rospy_node_calls_a_service(sea: Sea, tmp_path: Path) -> None:
    from uwsim.messages import EmptyResponse
    from uwsim.messages.services import Empty

    calls: list[Empty] = []

    def answer(request: Empty) -> EmptyResponse:
        calls.append(request)
        return EmptyResponse()

    sea.simulation.bus.services.serve("dynamics/reset", Empty, answer)
    sea.advance()
    assert sea.bridge.wait(LIMIT)
    sea.output(sea.peers.start("rosservice", "call", "/dynamics/reset"))
    assert len(calls) == 1


def test_a_service_of_a_rospy_node_is_called_from_the_bus(sea: Sea, tmp_path: Path) -> None:
    from uwsim.messages import EmptyResponse
    from uwsim.messages.services import Empty

    (tmp_path / "server.py").write_text(
        "import rospy\nfrom std_srvs.srv import Empty, EmptyResponse\n"
        "rospy.init_node('server')\n"
        "rospy.Service('/vision/reset', Empty, lambda r: EmptyResponse())\nrospy.spin()\n"
    )
    sea.peers.start("/usr/bin/python3", str(tmp_path / "server.py"))
    wait_until(lambda: sea.simulation.bus.services.is_offered("vision/reset"), sea.advance)
    assert sea.simulation.call("vision/reset", Empty()) == EmptyResponse()
