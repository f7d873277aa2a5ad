"""A bus as a node of rclpy, in the environment of rclpy: `test_with_rclpy` runs this file there."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from tests.middleware.ros2.simulator import Simulator, run_in_thread
from tests.support.ros2_peers import peer, wait_until
from uwsim.errors import UwsimError
from uwsim.messages import Float32MultiArray, Odometry, ProjectedSonarImage, TwistStamped
from uwsim.messages.services import Empty, EmptyResponse, GTpublish
from uwsim.middleware.types import SERVICES, ros2_store, service, wire_service

pytest.importorskip("rclpy", reason="rclpy cannot be imported here; test_with_rclpy has it")

from uwsim.middleware.ros2.rclpy_types import RclpyTypes, has_same_fields, install_command


@pytest.fixture
def simulator() -> Iterator[Simulator]:
    with run_in_thread() as actual:
        yield actual


CALLER = """
from std_srvs.srv import Empty
client = node.create_client(Empty, "/start")
spin_until(client.service_is_ready)
n = 0
while n < 3:
    future = client.call_async(Empty.Request())
    rclpy.spin_until_future_complete(node, future, timeout_sec=60.0)
    assert future.done()
    n += 1
    say(answered=n)
"""


def test_a_node_of_fast_dds_calls_a_service_of_the_simulation(simulator: Simulator) -> None:
    requests: list[Empty] = []

    def start(request: Empty) -> EmptyResponse:
        requests.append(request)
        return EmptyResponse()

    simulator.bus.services.serve("start", Empty, start)
    with peer(CALLER, simulator.domain) as node:
        answers: list[dict[str, int]] = []
        wait_until(
            lambda: len(answers) == 3, lambda: (simulator.step(), answers.extend(node.answers()))
        )
    assert requests == [Empty()] * 3
    assert simulator.lines == []


def test_a_call_that_fails_is_reported_and_the_next_is_answered(simulator: Simulator) -> None:
    n_calls = 0

    def start(request: Empty) -> EmptyResponse:
        nonlocal n_calls
        n_calls += 1
        if n_calls == 1:
            raise UwsimError("not yet")
        return EmptyResponse()

    simulator.bus.services.serve("start", Empty, start)
    source = CALLER.replace("timeout_sec=60.0)", "timeout_sec=0.5)").replace(
        "    assert future.done()\n", "    if not future.done():\n        continue\n"
    )
    with peer(source, simulator.domain) as node:
        answers: list[dict[str, int]] = []
        wait_until(
            lambda: len(answers) == 3, lambda: (simulator.step(), answers.extend(node.answers()))
        )
    assert [line.removeprefix("uwsim: : ") for line in simulator.lines] == [
        "service /start: no answer: not yet"
    ]


def test_the_simulation_calls_a_service_of_a_node(simulator: Simulator) -> None:
    source = """
from std_srvs.srv import Empty
def answer(request, response):
    say(asked=True)
    return response
node.create_service(Empty, "/home", answer)
spin_until(lambda: False)
"""
    services = simulator.bus.services
    assert not services.is_offered("home")
    with peer(source, simulator.domain) as node:
        wait_until(lambda: services.is_offered("home"), simulator.step)
        assert [services.call("home", Empty()) for _ in range(3)] == [EmptyResponse()] * 3
        answers: list[dict[str, bool]] = []
        wait_until(lambda: len(answers) == 3, lambda: answers.extend(node.answers()))


def test_what_is_published_and_read_in_the_simulation_comes_back_to_it_once(
    simulator: Simulator,
) -> None:
    publish = simulator.bus.publisher("rov/twist", TwistStamped)
    inbox = simulator.bus.inbox("rov/twist", TwistStamped)
    source = """
from geometry_msgs.msg import TwistStamped
out = node.create_publisher(TwistStamped, "/rov/twist", 10)
got = []
node.create_subscription(TwistStamped, "/rov/twist", lambda m: got.append(m.twist.linear.x), 10)
spin_until(lambda: 3.0 in got)
out.publish(TwistStamped())
spin_until(lambda: False)
"""
    samples: list[float] = []
    n = 0

    def step() -> None:
        nonlocal n
        n += 1
        message = TwistStamped()
        message.twist.linear.x = 3.0 + n
        publish(message)
        simulator.step()
        samples.extend(entry.twist.linear.x for entry in inbox.take())

    step()
    assert not simulator.bridge.subscribers.is_read("rov/twist"), (
        "the simulation's own reader is no demand"
    )
    with peer(source.replace("3.0 in got", "len(got) > 20"), simulator.domain):
        wait_until(lambda: 0.0 in samples, step)
        for _ in range(20):
            step()
    assert sorted(samples) == [0.0, *(3.0 + entry for entry in range(1, n + 1))]


def test_types_that_rclpy_lacks_are_told_a_package_a_line_and_the_rest_goes_on(
    simulator: Simulator,
) -> None:
    bus = simulator.bus
    bus.publisher("rov/sonar", ProjectedSonarImage)
    bus.publisher("rov/second_sonar", ProjectedSonarImage)
    bus.services.serve("autoInit", GTpublish, lambda request: None)
    publish = bus.publisher("rov/odom", Odometry)
    simulator.step()
    topics, services = (line.removeprefix("uwsim: : ") for line in simulator.lines)
    assert topics == (
        "not on the graph: /rov/second_sonar, /rov/sonar. The ROS 2 package marine_acoustic_msgs "
        "is not installed: apt install ros-$ROS_DISTRO-marine-acoustic-msgs; or set "
        "UWSIM_ROS2=dds, which does not need rclpy"
    )
    assert services.startswith(
        "not on the graph: /autoInit. The installed underwater_sensor_msgs has no "
    )
    simulator.step()
    assert len(simulator.lines) == 2, "once"
    source = """
from nav_msgs.msg import Odometry
node.create_subscription(Odometry, "/rov/odom", lambda m: say(x=1), 10)
spin_until(lambda: False)
"""
    with peer(source, simulator.domain) as node:
        wait_until(node.answers, lambda: (publish(Odometry()), simulator.step()))


def test_a_topic_whose_name_ros_2_refuses_is_left_out(simulator: Simulator) -> None:
    simulator.bus.publisher("3d-cam", Odometry)
    simulator.step()
    assert len(simulator.lines) == 1
    assert "not on the graph: /3d-cam. " in simulator.lines[0]


def test_a_reader_knows_whether_a_node_outside_feeds_it(simulator: Simulator) -> None:
    simulator.bus.publisher("rov/twist", TwistStamped)
    simulator.bus.inbox("rov/twist", TwistStamped)
    for _ in range(3):
        simulator.step()
    assert not simulator.bridge.has_publisher("rov/twist"), "the simulation's own writer is none"
    source = """
from geometry_msgs.msg import TwistStamped
out = node.create_publisher(TwistStamped, "/rov/twist", 10)
spin_until(lambda: False)
"""
    with peer(source, simulator.domain):
        wait_until(lambda: simulator.bridge.has_publisher("rov/twist"), simulator.step)


def test_a_service_outside_whose_type_rclpy_lacks_is_an_error_that_names_it(
    simulator: Simulator,
) -> None:
    node = simulator.bridge._node
    with pytest.raises(UwsimError, match="rclpy has no type underwater_sensor_msgs/srv/GTpublish"):
        node.call("autoInit", GTpublish(groundTruth=Float32MultiArray().data))


def test_how_to_get_the_package_of_uwsim_is_to_build_its_folder() -> None:
    command, _, folder = install_command("underwater_sensor_msgs").rpartition(" ")
    assert command == "colcon build --base-paths"
    assert (Path(folder) / "package.xml").is_file()


def test_a_type_with_other_fields_than_ours_is_not_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    class SpawnMarkerHalf:
        @classmethod
        def get_fields_and_field_types(cls) -> dict[str, str]:
            return {"marker": "visualization_msgs/Marker", "lifetime": "double"}

    class Type:
        Request = Response = SpawnMarkerHalf

    module = ModuleType("other_msgs.srv")
    module.GTpublish = Type  # type: ignore[attr-defined]
    package = ModuleType("underwater_sensor_msgs")
    monkeypatch.setitem(sys.modules, "underwater_sensor_msgs", package)
    monkeypatch.setitem(sys.modules, "underwater_sensor_msgs.srv", module)
    types = RclpyTypes()
    kind = wire_service(service("underwater_sensor_msgs/GTpublish"))
    assert types.service(kind, "autoInit") is None
    assert "other fields" in types.faults()[0]


def test_all_types_of_the_packages_that_rclpy_has_have_our_fields() -> None:
    packages = (
        "std_msgs",
        "sensor_msgs",
        "geometry_msgs",
        "nav_msgs",
        "std_srvs",
        "rosgraph_msgs",
    )
    names = [
        name
        for name in ros2_store().fielddefs
        if name.startswith(packages) and "_Event" not in name and name.count("/") == 2
    ]
    errors = [name for name in names if name not in SERVICES and not has_same_fields(name)]
    assert len(names) > 90
    assert errors == []


def test_a_node_whose_command_is_odd_is_named(simulator: Simulator) -> None:
    def remark(message: TwistStamped) -> tuple[str, str] | None:
        is_known = simulator.bridge._node.publishers("rov/twist") == ["/peer"]
        return ("it is odd", "another") if is_known else None  # a name may come after messages

    simulator.bus.subscribe("rov/twist", TwistStamped, lambda _: None, remark=remark)
    source = """
from geometry_msgs.msg import TwistStamped
out = node.create_publisher(TwistStamped, "/rov/twist", 10)
while True:
    out.publish(TwistStamped())
    rclpy.spin_once(node, timeout_sec=0.05)
"""
    with peer(source, simulator.domain):
        wait_until(lambda: any("it is odd" in line for line in simulator.lines), simulator.step)
    [line] = [line for line in simulator.lines if "it is odd" in line]
    assert "/rov/twist: in a message of node /peer, it is odd; expected another" in line
