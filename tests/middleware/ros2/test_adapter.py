"""A bus as a node of ROS 2, seen by real nodes of rclpy (Fast DDS)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from tests.support.ros2_peers import needs_rclpy, peer, wait_until
from uwsim.messages import Image, Odometry, String, TwistStamped
from uwsim.messages.build import image

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

from tests.middleware.ros2.simulator import Simulator, run_in_thread
from uwsim.middleware.types import wire_type

pytestmark = needs_rclpy
RECEIVE_BUFFER = Path("/proc/sys/net/core/rmem_max")


@pytest.fixture
def simulator() -> Iterator[Simulator]:
    with run_in_thread() as actual:
        yield actual


def test_a_node_reads_the_odometry_with_its_stamp_on_the_clock_of_ros(simulator: Simulator) -> None:
    publish = simulator.bus.publisher("rov/odom", Odometry)
    source = """
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
got, clocks = [], []
node.create_subscription(Odometry, "/rov/odom", got.append, 10)
node.create_subscription(Clock, "/clock", clocks.append, qos_profile_sensor_data)
spin_until(lambda: got and clocks)
has_begun = clocks[0].clock.sec >= 1
say(x=got[0].pose.pose.position.x, sec=got[0].header.stamp.sec, has_begun=has_begun)
"""
    with peer(source, simulator.domain) as node:
        answers: list[dict[str, object]] = []

        def step() -> None:
            message = Odometry()
            message.pose.pose.position.x = 1.25
            publish(message)
            simulator.step()
            answers.extend(node.answers())

        wait_until(lambda: answers, step)
    assert answers == [{"x": 1.25, "sec": 1, "has_begun": True}]


def test_a_node_drives_a_vehicle(simulator: Simulator) -> None:
    inbox = simulator.bus.inbox("rov/twist", TwistStamped)
    source = """
from geometry_msgs.msg import TwistStamped
out = node.create_publisher(TwistStamped, "/rov/twist", 10)
message = TwistStamped()
message.twist.linear.x = 0.5
while True:
    out.publish(message)
    rclpy.spin_once(node, timeout_sec=0.02)
"""
    with peer(source, simulator.domain):
        wait_until(lambda: inbox.last_message is not None, simulator.step)
    assert inbox.last_message is not None
    assert inbox.last_message.twist.linear.x == 0.5
    assert inbox.last_message.header.stamp.sec == 0, "none given: none"


def test_the_graph_shows_one_node_with_its_endpoints_and_type_hashes(simulator: Simulator) -> None:
    simulator.bus.publisher("rov/odom", Odometry)
    simulator.bus.publisher("rov/truth", Odometry)
    simulator.bus.hide_topic("rov/truth", "is not in track 'a'")
    simulator.bus.inbox("rov/twist", TwistStamped)
    simulator.step()
    source = """
from rclpy.node import Node
def ours():
    return ("uwsim", "/") in node.get_node_names_and_namespaces() and len(
        node.get_publisher_names_and_types_by_node("uwsim", "/")
    ) >= 2 and node.get_subscriber_names_and_types_by_node("uwsim", "/")
spin_until(ours)
(info,) = node.get_publishers_info_by_topic("/rov/odom")
published = dict(node.get_publisher_names_and_types_by_node("uwsim", "/"))
published.pop("/parameter_events", None)  # every node of rclpy has it
say(
    published=sorted(published.items()),
    read=node.get_subscriber_names_and_types_by_node("uwsim", "/"),
    hash=str(info.topic_type_hash),
    reliability=info.qos_profile.reliability.name,
)
"""
    with peer(source, simulator.domain) as node:
        answers: list[dict[str, object]] = []
        wait_until(lambda: answers, lambda: (simulator.step(), answers.extend(node.answers())))
    odometry = wire_type(Odometry)
    assert odometry is not None
    assert answers == [
        {
            "published": [
                ["/clock", ["rosgraph_msgs/msg/Clock"]],
                ["/rov/odom", ["nav_msgs/msg/Odometry"]],
            ],
            "read": [["/rov/twist", ["geometry_msgs/msg/TwistStamped"]]],
            "hash": odometry.type_hash,
            "reliability": "RELIABLE",
        }
    ]


def test_a_camera_is_read_only_while_a_node_subscribes(simulator: Simulator) -> None:
    simulator.bus.publisher("camera", Image)
    source = """
from sensor_msgs.msg import Image
node.create_subscription(Image, "/camera", print, qos_profile_sensor_data)
spin_until(lambda: False)
"""
    simulator.step()
    assert not simulator.bus.has_subscribers("camera")
    with peer(source, simulator.domain) as node:
        wait_until(lambda: simulator.bus.has_subscribers("camera"), simulator.step)
        node.process.terminate()  # rclpy leaves the graph
        wait_until(lambda: not simulator.bus.has_subscribers("camera"), simulator.step)


@pytest.mark.skipif(
    not RECEIVE_BUFFER.is_file() or int(RECEIVE_BUFFER.read_text()) < 2**20,
    reason="net.core.rmem_max is below 1 MB: Fast DDS loses large images",
)
def test_images_of_640_by_480_pixels_arrive_each_and_whole(simulator: Simulator) -> None:
    publish = simulator.bus.publisher("camera", Image)
    actual = simulator.bus.inbox("seen", String)
    source = """
from sensor_msgs.msg import Image
from std_msgs.msg import String
out = node.create_publisher(String, "/seen", 10)
def look(image):
    size = f"{image.width}x{image.height}"
    out.publish(String(data=f"{size} {image.data[0]} {len(image.data)}"))
node.create_subscription(Image, "/camera", look, 10)
spin_until(lambda: False)
"""
    pixels = np.zeros((480, 640, 3), dtype=np.uint8)
    samples: list[str] = []

    def step() -> None:
        simulator.step()
        samples.extend(entry.data for entry in actual.take())

    def send(n: int) -> None:
        pixels[0, 0, 0] = n
        publish(image(pixels.copy(), time=float(n)))

    with peer(source, simulator.domain):
        small_image = np.zeros((1, 1, 3), dtype=np.uint8)
        wait_until(lambda: samples, lambda: (publish(image(small_image.copy(), time=0.0)), step()))
        for n in range(1, 21):  # both ends know each other
            send(n)
            wait_until(lambda n=n: samples[-1].startswith(f"640x480 {n} "), step)
    large_image = [entry for entry in samples if not entry.startswith("1x1 ")]
    assert large_image == [f"640x480 {n} 921600" for n in range(1, 21)]


def test_a_late_node_gets_what_was_published_before(simulator: Simulator) -> None:
    publish = simulator.bus.publisher("robot_description", String)
    publish(String(data="<robot/>"))
    for _ in range(3):
        simulator.step()
    source = """
from std_msgs.msg import String
late = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_subscription(String, "/robot_description", lambda m: say(text=m.data), late)
spin_until(lambda: False)
"""
    with peer(source, simulator.domain) as node:
        answers: list[dict[str, object]] = []
        wait_until(lambda: answers, lambda: (simulator.step(), answers.extend(node.answers())))
    assert answers == [{"text": "<robot/>"}]


def test_a_publisher_of_best_effort_is_reported(simulator: Simulator) -> None:
    simulator.bus.inbox("rov/twist", TwistStamped)
    source = """
from geometry_msgs.msg import TwistStamped
out = node.create_publisher(TwistStamped, "/rov/twist", qos_profile_sensor_data)
spin_until(lambda: False)
"""
    with peer(source, simulator.domain):
        wait_until(lambda: simulator.lines, simulator.step)
    assert "/rov/twist" in simulator.lines[0]
    assert "best effort" in simulator.lines[0]
