"""Without rclpy a node for this computer cannot be reached from others."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import closing

import pytest

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

from tests.support.ros2_peers import free_domain
from uwsim.middleware.log import Log
from uwsim.middleware.ros2.choice import open_node
from uwsim.middleware.ros2.loopback import bind_to_loopback, list_sockets

LINES = ("for nodes on this computer", "its ports are open on all addresses")


def devices(value_before: set[str]) -> Iterator[tuple[str, bytes]]:
    """Addresses and interfaces of the UDP sockets that were opened since."""
    for number in os.listdir("/proc/self/fd"):
        try:
            name = os.readlink(f"/proc/self/fd/{number}")
        except OSError:
            continue
        if name.startswith("socket:") and name not in value_before:
            with socket.socket(fileno=os.dup(int(number))) as actual:
                if actual.family == socket.AF_INET and actual.type == socket.SOCK_DGRAM:
                    device = actual.getsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, 16)
                    yield actual.getsockname()[0], device.rstrip(b"\0")


@pytest.mark.parametrize(
    ("user_xml", "is_closed"),
    [
        ({}, True),
        ({"ROS_LOCALHOST_ONLY": "1"}, True),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, False),
        ({"ROS_STATIC_PEERS": "127.0.0.1"}, False),
    ],
)
def test_ports_are_bound_to_the_loopback_interface_when_the_first_line_says_so(
    user_xml: dict[str, str], is_closed: bool
) -> None:
    lines: list[str] = []
    with free_domain() as domain:
        value_before = list_sockets()
        with closing(open_node({"UWSIM_ROS2": "dds", **user_xml}, domain, Log("", lines.append))):
            actual = list(devices(value_before))
    assert actual
    is_reachable = [entry for entry in actual if entry[0] == "0.0.0.0" and entry[1] != b"lo"]
    assert (not is_reachable) == is_closed
    assert LINES[not is_closed] in lines[0]


def test_a_socket_that_is_bound_to_loopback_still_hears_this_computer() -> None:
    value_before = list_sockets()
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
    ):
        listener.bind(("0.0.0.0", 0))
        listener.settimeout(5.0)
        assert bind_to_loopback(value_before)
        sender.sendto(b"here", ("127.0.0.1", listener.getsockname()[1]))
        assert listener.recv(10) == b"here"
