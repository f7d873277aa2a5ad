"""The small master: registrations, look-ups, updates, parameters."""

from __future__ import annotations

import socket
import threading
import time
import xmlrpc.client
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest

from tests.support.waiting import LIMIT, wait_until
from uwsim.middleware.log import Log
from uwsim.middleware.ros1.master import Master
from uwsim.middleware.ros1.tcpros import PeerError
from uwsim.middleware.ros1.xmlrpc import MAX_REQUEST, Answer, RefusedCall, XmlRpcServer, call

NODE = "http://127.0.0.1:1/"


@pytest.fixture
def lines() -> list[str]:
    return []


@pytest.fixture
def master(lines: list[str]) -> Iterator[Master]:
    new_master = Master(Log("test", lines.append))
    yield new_master
    new_master.close()


def test_topics_are_registered_and_listed(master: Master) -> None:
    register = ("/sim", "odom", "nav_msgs/Odometry", NODE)
    assert call(master.uri, "registerPublisher", *register) == []
    assert call(master.uri, "registerSubscriber", "/echo", "/odom", "*", "http://x:2/") == [NODE]
    assert call(master.uri, "registerPublisher", *register) == ["http://x:2/"]
    assert call(master.uri, "getPublishedTopics", "/x", "") == [["/odom", "nav_msgs/Odometry"]]
    assert call(master.uri, "getTopicTypes", "/x") == [["/odom", "nav_msgs/Odometry"]]
    assert call(master.uri, "lookupNode", "/x", "/sim") == NODE
    assert call(master.uri, "getSystemState", "/x") == [
        [["/odom", ["/sim"]]],
        [["/odom", ["/echo"]]],
        [],
    ]
    assert call(master.uri, "unregisterPublisher", "/sim", "/odom", NODE) == 1
    assert call(master.uri, "unregisterPublisher", "/sim", "/odom", NODE) == 0
    assert call(master.uri, "getPublishedTopics", "/x", "") == []


def test_a_node_takes_back_all_at_once_as_rospy_does_when_it_ends(master: Master) -> None:
    call(master.uri, "registerPublisher", "/sim", "/odom", "nav_msgs/Odometry", NODE)
    call(master.uri, "registerSubscriber", "/sim", "/cmd", "geometry_msgs/Pose", NODE)
    with xmlrpc.client.ServerProxy(master.uri) as proxy:
        leave = xmlrpc.client.MultiCall(proxy)
        leave.unregisterPublisher("/sim", "/odom", NODE)
        leave.unregisterSubscriber("/sim", "/cmd", NODE)
        assert [code for code, _, _ in leave()] == [1, 1]
    assert call(master.uri, "getSystemState", "/x") == [[], [], []]


def test_services_are_found(master: Master) -> None:
    call(master.uri, "registerService", "/sim", "/reset", "rosrpc://127.0.0.1:5", NODE)
    assert call(master.uri, "lookupService", "/x", "/reset") == "rosrpc://127.0.0.1:5"
    call(master.uri, "unregisterService", "/sim", "/reset", "rosrpc://127.0.0.1:5")
    with pytest.raises(RefusedCall, match="no provider"):
        call(master.uri, "lookupService", "/x", "/reset")


def test_subscribers_hear_of_new_publishers(master: Master, lines: list[str]) -> None:
    arrivals: list[tuple[Any, ...]] = []

    def update(*arguments: Any) -> Answer:
        arrivals.append(arguments)
        return [1, "", 0]

    node = XmlRpcServer(
        "127.0.0.1", 0, {"publisherUpdate": update}, Log("test", lines.append), "node"
    )
    uri = f"http://127.0.0.1:{node.port}/"
    call(master.uri, "registerSubscriber", "/echo", "/odom", "*", uri)
    call(master.uri, "registerPublisher", "/sim", "/odom", "nav_msgs/Odometry", NODE)
    wait_until(lambda: arrivals)
    assert arrivals[0] == ("/master", "/odom", [NODE])
    node.close()


def test_a_second_node_of_the_same_name_ends_the_first(master: Master, lines: list[str]) -> None:
    reasons: list[tuple[Any, ...]] = []

    def shutdown(*arguments: Any) -> Answer:
        reasons.append(arguments)
        return [1, "", 0]

    node = XmlRpcServer("127.0.0.1", 0, {"shutdown": shutdown}, Log("test", lines.append), "node")
    uri = f"http://127.0.0.1:{node.port}/"
    call(master.uri, "registerPublisher", "/sim", "/a", "std_msgs/String", uri)
    call(master.uri, "registerPublisher", "/sim", "/b", "std_msgs/String", NODE)
    wait_until(lambda: reasons)
    assert "/sim" in reasons[0][1]
    assert call(master.uri, "getPublishedTopics", "/x", "") == [["/b", "std_msgs/String"]]
    node.close()


def test_parameters_are_a_tree(master: Master) -> None:
    uri = master.uri
    call(uri, "setParam", "/sim", "/g500/num_actuators", 5)
    call(uri, "setParam", "/g500/control", "dynamics", {"mass": 98.0})
    call(uri, "setParam", "/sim", "~seed", 3)
    assert call(uri, "getParam", "/x", "/g500") == {"num_actuators": 5, "dynamics": {"mass": 98.0}}
    assert call(uri, "getParam", "/x", "/sim/seed") == 3
    assert call(uri, "getParam", "/g500/control", "dynamics/mass") == 98.0
    assert call(uri, "hasParam", "/x", "/g500/dynamics/mass") is True
    assert call(uri, "searchParam", "/g500/control", "num_actuators") == "/g500/num_actuators"
    assert call(uri, "getParamNames", "/x") == [
        "/g500/dynamics/mass",
        "/g500/num_actuators",
        "/sim/seed",
    ]
    call(uri, "deleteParam", "/x", "/g500/dynamics")
    assert call(uri, "hasParam", "/x", "/g500/dynamics") is False
    with pytest.raises(RefusedCall, match="is not set"):
        call(uri, "getParam", "/x", "/g500/dynamics")
    with pytest.raises(RefusedCall, match="not set"):
        call(uri, "deleteParam", "/x", "/nothing")
    with pytest.raises(RefusedCall, match="Cannot find"):
        call(uri, "searchParam", "/x", "nothing")


def test_a_subscriber_of_a_parameter_hears_of_its_change(master: Master, lines: list[str]) -> None:
    arrivals: list[tuple[Any, ...]] = []

    def update(*arguments: Any) -> Answer:
        arrivals.append(arguments)
        return [1, "", 0]

    node = XmlRpcServer("127.0.0.1", 0, {"paramUpdate": update}, Log("test", lines.append), "node")
    uri = f"http://127.0.0.1:{node.port}/"
    assert call(master.uri, "subscribeParam", "/x", uri, "/gain") == {}
    call(master.uri, "setParam", "/x", "/gain", 0.5)
    wait_until(lambda: arrivals)
    assert arrivals[0] == ("/master", "/gain/", 0.5)
    assert call(master.uri, "unsubscribeParam", "/x", uri, "/gain") == 1
    node.close()


@pytest.mark.parametrize(
    "data",
    [
        b"\x00\xff" * 50,
        b"POST / HTTP/1.1\r\nContent-Length: 5\r\n\r\n<a><b",
        b"POST / HTTP/1.1\r\nContent-Length: many\r\n\r\n",
        b"POST / HTTP/1.1\r\nContent-Length: %d\r\n\r\n" % (MAX_REQUEST + 1),
        b"POST / HTTP/1.1\r\nContent-Length: 100\r\n\r\nshort",
        b"GET / HTTP/1.1\r\n\r\n",
    ],
)
def test_garbage_does_not_end_it(master: Master, data: bytes) -> None:
    port = int(master.uri.rsplit(":", 1)[1].strip("/"))
    with socket.create_connection(("127.0.0.1", port), LIMIT) as peer, suppress(OSError):
        peer.sendall(data)  # the master may leave before all is read: broken, reset, not connected
        peer.shutdown(socket.SHUT_WR)
        while peer.recv(4096):
            pass
    assert call(master.uri, "getUri", "/x") == master.uri


def test_what_is_no_answer_of_ros_is_one_clean_error(lines: list[str]) -> None:
    odd_server: dict[str, Any] = {"getUri": lambda caller: "hello", "getPid": lambda caller: 1 / 0}
    server = XmlRpcServer("127.0.0.1", 0, odd_server, Log("test", lines.append), "node")
    uri = f"http://127.0.0.1:{server.port}/"
    for method in ("getUri", "getPid", "nothing"):
        with pytest.raises(PeerError, match="does not answer as ROS"):
            call(uri, method, "/x")
    server.close()
    with pytest.raises(PeerError, match="does not answer"):
        call(uri, "getUri", "/x")


INVALID_CALLS: dict[str, tuple[str, tuple[Any, ...], str, object]] = {
    "no caller": ("getPid", (), "missing required caller_id parameter", -1),
    "a number for a caller": ("getPid", (5,), "caller_id must be a string", -1),
    "too few": ("registerPublisher", ("/x", "/odom"), "wrong number of arguments (2); expec", []),
    "too many": ("getUri", ("/x", 1), "wrong number of arguments (2); expected caller_id", ""),
    "a number for a topic": (
        "registerSubscriber",
        ("/x", 5, "*", NODE),
        "parameter [topic] must be a non-empty string",
        [],
    ),
    "a space": (
        "registerPublisher",
        ("/x", "/a b", "*", NODE),
        "parameter [topic] contains illegal chars",
        [],
    ),
    "no topic": (
        "unregisterPublisher",
        ("/x", "/", NODE),
        "parameter [topic] cannot be the global namespace",
        0,
    ),
    "a type": (
        "registerPublisher",
        ("/x", "/a", "Odometry", NODE),
        "parameter [topic_type] is not a valid package resource name",
        [],
    ),
    "an address": (
        "registerService",
        ("/x", "/a", "rosrpc://127.0.0.1:1", "here"),
        "parameter [caller_api] is not an RPC URI",
        0,
    ),
    "a list for a key": ("getParam", ("/x", []), "parameter [key] must be a non-empty string", 0),
    "no value": ("setParam", ("/x", "/a", None), "parameter [value] must be specified", 0),
    "an endless caller": (
        "searchParam",
        ("a/" * 1000, "x"),
        "caller_id has more than 1000 characters",
        0,
    ),
    "an endless key": (
        "getParam",
        ("/x", "a/" * 1000),
        "parameter [key] has more than 1000 characters",
        0,
    ),
    "an endless address": (
        "registerService",
        ("/x", "/a", "rosrpc://" + "a" * 1000, NODE),
        "parameter [service_api] has more than 1000 characters",
        0,
    ),
    "an object": (
        "lookupNode",
        ("/x", {"a": 1}),
        "parameter [node] must be a non-empty string",
        "",
    ),
}


@pytest.mark.parametrize("case", INVALID_CALLS)
def test_a_wrong_call_is_answered_with_a_code_and_what_was_expected(
    master: Master, case: str
) -> None:
    method, arguments, message, value = INVALID_CALLS[case]
    with xmlrpc.client.ServerProxy(master.uri, allow_none=True) as proxy:
        code, text, actual = getattr(proxy, method)(*arguments)
    assert (code, actual) == (-1, value)
    assert text.startswith(message)


def test_a_method_that_is_none_is_a_fault_that_names_it(master: Master) -> None:
    with xmlrpc.client.ServerProxy(master.uri) as proxy:
        with pytest.raises(xmlrpc.client.Fault, match="method 'registerAll' is not supported"):
            proxy.registerAll("/x")
        with pytest.raises(xmlrpc.client.Fault) as excinfo:
            proxy.registerAll("/x")
    assert "class" not in excinfo.value.faultString


def test_the_last_update_that_a_subscriber_gets_is_the_newest(
    master: Master, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where the first one is slow, and another thread sends the second."""
    updates: list[list[str]] = []
    is_newest_sent = threading.Event()

    def slow(
        uri: str, method: str, caller: str, topic: str, publishers: list[str], *, max_length: int
    ) -> Answer:
        if len(publishers) == 1:
            is_newest_sent.wait(0.5)
        updates.append(publishers)
        if len(publishers) == 2:
            is_newest_sent.set()
        return [1, "", 0]

    monkeypatch.setattr("uwsim.middleware.ros1.master.call", slow)
    kind = "std_msgs/Float64"
    call(master.uri, "registerSubscriber", "/sim", "/corners", kind, NODE)
    call(master.uri, "registerPublisher", "/one", "/corners", kind, "http://x:1/")
    time.sleep(0.1)  # the first update has begun
    call(master.uri, "registerPublisher", "/two", "/corners", kind, "http://x:2/")
    wait_until(lambda: updates and len(updates[-1]) == 2 and is_newest_sent.is_set())
    time.sleep(0.1)
    assert updates[-1] == ["http://x:1/", "http://x:2/"]
