"""Pages in browsers, slow clients and hoarders at the ports of a master and of a node of ROS 1."""

from __future__ import annotations

import http.client
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import closing, suppress
from typing import Any

import pytest

from tests.middleware.ros1.nodes import Graph
from tests.support.waiting import LIMIT, wait_until
from uwsim.middleware.log import Log
from uwsim.middleware.ros1 import master as master_module
from uwsim.middleware.ros1 import parameters, xmlrpc
from uwsim.middleware.ros1.deadline import DeadlineReader
from uwsim.middleware.ros1.master import Master
from uwsim.middleware.ros1.origins import find_browser_sign, local_names
from uwsim.middleware.ros1.parameters import Parameters, measure_value
from uwsim.middleware.ros1.tcpros import encode_header
from uwsim.middleware.ros1.xmlrpc import RefusedCall, call

NODE = "http://127.0.0.1:1/"
SHUTDOWN = (
    "<?xml version='1.0'?><methodCall><methodName>{}</methodName><params>"
    "<param><value><string>/page</string></value></param>"
    "<param><value><string>{}</string></value></param>"
    "<param><value><string>bye</string></value></param></params></methodCall>"
)


@pytest.fixture
def master() -> Iterator[Master]:
    new_master = Master(Log("test", lambda line: None))
    yield new_master
    new_master.close()


def port_of(uri: str) -> int:
    return int(uri.rsplit(":", 1)[1].strip("/"))


def status_of(port: int, body: str, headers: dict[str, str]) -> int:
    """Send a request as a browser does, which does not ask before."""
    with closing(http.client.HTTPConnection("127.0.0.1", port, timeout=LIMIT)) as connection:
        connection.putrequest("POST", "/", skip_host="Host" in headers)
        for name, value in {"Content-Length": str(len(body)), **headers}.items():
            connection.putheader(name, value)
        connection.endheaders(body.encode())
        return connection.getresponse().status


PAGES = [
    {"Origin": "https://example.org"},
    {"origin": "null"},
    {"Origin": "http://localhost:8000", "Content-Type": "text/plain"},
    {"Sec-Fetch-Site": "cross-site"},
    {"Host": "rebound.example.org:11311"},
    {"Host": "127.0.0.1.example.org"},
]


@pytest.mark.parametrize("headers", PAGES)
def test_a_page_in_a_browser_sets_no_parameter_and_ends_no_node(headers: dict[str, str]) -> None:
    graph = Graph()
    with closing(graph):
        sim = graph.node()
        graph.wait_until_ready()
        body = SHUTDOWN.format("setParam", "/use_sim_time")
        assert status_of(port_of(graph.master.uri), body, headers) == 403
        assert status_of(port_of(sim.uri), SHUTDOWN.format("shutdown", "bye"), headers) == 403
        assert call(graph.master.uri, "hasParam", "/x", "/use_sim_time") is False
        assert not any("requests that this node leaves" in line for line in graph.lines)
        assert any("a request is refused" in line for line in graph.lines)


@pytest.mark.parametrize(
    "host",
    [
        *("127.0.0.1:11311", "localhost", "[::1]:11311", "192.168.7.9:11311", "fe80::1"),
        *("robot:11311", "robot.local:11311", "ROBOT.LAN", socket.gethostname()),
        *("auv.example.org:11311", ""),
    ],
)
def test_nodes_on_this_and_other_computers_are_served(host: str) -> None:
    headers = {"host": host, "content-type": "text/xml"}
    assert find_browser_sign(headers, local_names("auv.example.org")) is None


def test_the_refusal_names_what_was_found_and_what_is_expected() -> None:
    text = find_browser_sign({"host": "evil.example.org:11311"}, local_names("10.0.0.4"))
    assert text is not None
    for part in ("evil.example.org:11311", "10.0.0.4", "localhost"):
        assert part in text


def drips(connection: socket.socket, data: bytes, seconds: float) -> bool:
    """Send a byte again and again; whether the other side left before all was sent."""
    try:
        for byte in data:
            connection.sendall(bytes([byte]))
            time.sleep(seconds)
            connection.setblocking(False)
            with suppress(BlockingIOError):
                if connection.recv(4096) == b"":
                    return True
            connection.setblocking(True)
    except OSError:
        return True
    return False


def test_a_header_that_comes_byte_by_byte_has_a_deadline() -> None:
    graph = Graph()
    with closing(graph):
        sim = graph.node(header=0.2)
        graph.wait_until_ready()
        data = encode_header({"callerid": "/slow", "topic": "/clock", "md5sum": "*", "type": "*"})
        with socket.create_connection(("127.0.0.1", sim._listener.port), LIMIT) as peer:
            assert drips(peer, data, 0.02)
        wait_until(lambda: sim._listener.n_connections == 0)


@pytest.mark.parametrize("data", [b"POST / HTTP/1.0\r\nX: " + b"x" * 200, b"POST" * 50])
def test_a_request_that_comes_byte_by_byte_has_a_deadline(
    monkeypatch: pytest.MonkeyPatch, data: bytes
) -> None:
    monkeypatch.setattr(xmlrpc, "READ_TIMEOUT", 0.2)
    server = Master(Log("test", lambda line: None))
    with closing(server):
        with socket.create_connection(("127.0.0.1", port_of(server.uri)), LIMIT) as peer:
            assert drips(peer, data, 0.02)
        assert call(server.uri, "getUri", "/x") == server.uri


def test_a_reader_with_a_deadline_reads_what_comes_in_time_and_leaves_the_timeout() -> None:
    local_end, remote_end = socket.socketpair()
    with local_end, remote_end:
        local_end.settimeout(7.0)
        reader = DeadlineReader(local_end, 0.3)
        threading.Timer(0.05, remote_end.sendall, (b"tide",)).start()
        assert reader.read(10) == b"tide"
        assert local_end.gettimeout() == 7.0
        with pytest.raises(TimeoutError):
            reader.read(1)


@pytest.mark.parametrize(
    "value", ["x" * 40_000, ["x" * 4_000] * 10, {"a": {"b": "x" * 40_000}}, [0.5] * 5_000]
)
def test_parameters_have_a_limit_on_their_total_size(
    master: Master, monkeypatch: pytest.MonkeyPatch, value: Any
) -> None:
    monkeypatch.setattr(parameters, "MAX_BYTES", 200_000)
    for n in range(4):
        call(master.uri, "setParam", "/x", f"/p{n}", value)
    with pytest.raises(RefusedCall, match="200000 bytes"):
        call(master.uri, "setParam", "/x", "/q", [value, value])
    for _ in range(5):  # in the place of another it has room
        call(master.uri, "setParam", "/x", "/p0", value)
    call(master.uri, "deleteParam", "/x", "/p0")
    call(master.uri, "setParam", "/x", "/q", value)
    assert measure_value(call(master.uri, "getParam", "/x", "/"))[2] < 200_000


def test_parameters_have_a_limit_on_their_number_and_depth(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parameters, "MAX_VALUES", 200)
    kept_values = Parameters()
    codes = [kept_values.set_param("/x", f"/n/p{n}", n)[0][0] for n in range(300)]
    assert 0 < codes.count(1) < 200
    assert kept_values.get_param("/x", "/n/p0")[0][0] == 1
    assert [kept_values.set_param("/x", "/n/p0", n)[0][0] for n in range(300)] == [1] * 300
    deep_value: Any = 1.0
    for _ in range(100):
        deep_value = {"a": deep_value}
    assert Parameters().set_param("/x", "/deep", deep_value)[0][0] == -1
    assert Parameters().set_param("/x", "/a" * 100, 1.0)[0][0] == -1


def test_a_master_keeps_a_limited_number_of_entries_and_forgets_nodes_that_have_left(
    master: Master, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(master_module, "MAX_ENTRIES", 20)
    for n in range(60):  # each leaves again
        call(master.uri, "registerPublisher", f"/n{n}", f"/t{n}", "std_msgs/String", NODE)
        call(master.uri, "unregisterPublisher", f"/n{n}", f"/t{n}", NODE)
        call(master.uri, "registerService", f"/s{n}", f"/s{n}", "rosrpc://127.0.0.1:1", NODE)
        call(master.uri, "unregisterService", f"/s{n}", f"/s{n}", "rosrpc://127.0.0.1:1")
    with pytest.raises(RefusedCall):
        call(master.uri, "lookupNode", "/x", "/n3")
    for n in range(20):
        call(master.uri, "registerSubscriber", "/a", f"/t{n}", "std_msgs/String", NODE)
    with pytest.raises(RefusedCall, match="are kept"):
        call(master.uri, "registerSubscriber", "/a", "/more", "std_msgs/String", NODE)
