"""A simulation on one host; on another, two programs drive a vehicle each."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.middleware.hosts import Host, two_hosts
from tests.support.ros1_peers import EXAMPLES, PYTHON, needs_ros1
from tests.support.waiting import LIMIT

pytestmark = pytest.mark.slow
ROSPY_WATCHER = """
import rospy
from nav_msgs.msg import Odometry
rospy.init_node("watcher", disable_signals=True)
began, moved = {}, {}
def look(message, name):
    x = message.pose.pose.position.x, message.pose.pose.position.y, message.pose.pose.position.z
    first = began.setdefault(name, x)
    moved[name] = max(abs(a - b) for a, b in zip(x, first))
    if len(moved) == 2 and min(moved.values()) > 0.1:
        rospy.signal_shutdown("both")
for name in ("first", "second"):
    rospy.Subscriber(f"/{name}/odom", Odometry, look, name)
rospy.spin()
print("both moved")
"""
WEB_DRIVER = """
import json, sys
from websockets.sync.client import connect
uri, name, speed = sys.argv[1], sys.argv[2], float(sys.argv[3])
with connect(uri, open_timeout=200) as socket:
    def send(**frame):
        socket.send(json.dumps(frame))
    send(op="advertise", topic=f"/{name}/twist", type="geometry_msgs/TwistStamped")
    send(op="subscribe", topic=f"/{name}/odom", type="nav_msgs/Odometry")
    first = None
    while True:
        heard = json.loads(socket.recv(timeout=200))
        if heard.get("op") != "publish":
            continue
        x = heard["msg"]["pose"]["pose"]["position"]
        first = first or x
        if max(abs(x[axis] - first[axis]) for axis in "xyz") > 0.1:
            break
        twist = {"linear": {"x": speed}}
        send(op="publish", topic=f"/{name}/twist", msg={"twist": twist})
print(name, "moved")
"""


@pytest.fixture
def hosts() -> Iterator[tuple[Host, Host]]:
    with two_hosts() as actual:
        yield actual


def simulation(host: Host, *options: str, **variables: str) -> None:
    """Run a scene of two vehicles there, and wait until it listens."""
    run = host.start(
        *(sys.executable, "-m", "uwsim", "run", "two-vehicles-scene", *options),
        env={**os.environ, **variables},
    )
    assert run.stderr is not None
    text = ""
    while not ("listening on" in text or "one was started at" in text):
        line = run.stderr.readline()
        assert line, text
        text += line


@needs_ros1
def test_two_nodes_of_ros_1_on_another_host_drive_a_vehicle_each(
    hosts: tuple[Host, Host], tmp_path: Path
) -> None:
    local_host, remote_host = hosts
    master = f"http://{local_host.address}:11311"
    simulation(local_host, "--ros1", "--ros1-host", local_host.address, ROS_MASTER_URI=master)
    variables = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "VIRTUAL"))}
    ros_variables = {
        "ROS_MASTER_URI": master,
        "ROS_IP": remote_host.address,
        "ROS_LOG_DIR": str(tmp_path),
    }
    environment = {**variables, **ros_variables}
    twist = str(EXAMPLES / "set_vehicle_twist.py")
    watcher = remote_host.start(PYTHON, "-c", ROSPY_WATCHER, env=environment)
    for name, speed in (("first", "0.3"), ("second", "-0.3")):
        command = (PYTHON, twist, f"/{name}/twist", speed, "0", "0", "0", "0", "0")
        remote_host.start(*command, env=environment)
    lines, errors = watcher.communicate(timeout=LIMIT)
    assert lines == "both moved\n", errors


def test_two_web_clients_on_another_host_drive_a_vehicle_each(hosts: tuple[Host, Host]) -> None:
    local_host, remote_host = hosts
    simulation(
        local_host, "--web", "9090", "--web-host", local_host.address, UWSIM_WEB_TOKEN="secret"
    )
    uri = f"ws://{local_host.address}:9090/?token=secret"
    drivers = [
        remote_host.start(sys.executable, "-c", WEB_DRIVER, uri, name, speed)
        for name, speed in (("first", "0.3"), ("second", "-0.3"))
    ]
    for name, driver in zip(("first", "second"), drivers, strict=True):
        lines, errors = driver.communicate(timeout=LIMIT)
        assert lines == f"{name} moved\n", errors


def test_another_host_without_the_token_is_refused(hosts: tuple[Host, Host]) -> None:
    local_host, remote_host = hosts
    simulation(
        local_host, "--web", "9090", "--web-host", local_host.address, UWSIM_WEB_TOKEN="secret"
    )
    driver = remote_host.start(
        sys.executable, "-c", WEB_DRIVER, f"ws://{local_host.address}:9090", "first", "1"
    )
    lines, errors = driver.communicate(timeout=LIMIT)
    assert lines == ""
    assert "HTTP 401" in errors
