"""Peers that send garbage, stall, flood or die: the simulation goes on and the log says it."""

from __future__ import annotations

import socket
import struct
import threading
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from select import select
from typing import Any

import numpy as np
import pytest

from tests.middleware.ros1.nodes import Graph
from tests.support.waiting import LIMIT, wait_until
from uwsim.messages import Empty, EmptyResponse, Float64, Image, JointState, image
from uwsim.middleware.admission import SingleProgram
from uwsim.middleware.encodings import to_ros1
from uwsim.middleware.log import Log
from uwsim.middleware.ros1 import subscription
from uwsim.middleware.ros1.bridge import Ros1Bridge
from uwsim.middleware.ros1.publication import QUEUE_BYTES, QUEUE_LENGTH
from uwsim.middleware.ros1.tcpros import add_length, encode_header, read_header
from uwsim.middleware.ros1.xmlrpc import Answer, XmlRpcServer, call
from uwsim.middleware.types import wire_type


@pytest.fixture
def graph() -> Iterator[Graph]:
    new_graph = Graph()
    yield new_graph
    new_graph.close()


def port_of(node: Ros1Bridge, topic: str = "/clock") -> int:
    return int(call(node.uri, "requestTopic", "/x", topic, [["TCPROS"]])[2])


def connect(port: int) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), LIMIT)


def subscribe(node: Ros1Bridge, topic: str) -> socket.socket:
    peer = connect(port_of(node, topic))
    fields = {"callerid": "/x", "md5sum": "*", "topic": topic, "type": "*"}
    peer.sendall(encode_header(fields))
    read_header(peer)
    return peer


class FakePublisher:
    """A node that publishes a topic with bytes of the test's choice."""

    def __init__(self, graph: Graph, topic: str, kind: type) -> None:
        self.server = socket.create_server(("127.0.0.1", 0))
        self.server.settimeout(LIMIT)
        port = self.server.getsockname()[1]

        def request(*arguments: Any) -> Answer:
            return [1, "", ["TCPROS", "127.0.0.1", port]]

        self.node = XmlRpcServer(
            "127.0.0.1", 0, {"requestTopic": request}, Log("test", print), "publisher"
        )
        uri = f"http://127.0.0.1:{self.node.port}/"
        actual = wire_type(kind)
        assert actual is not None
        self.type = actual
        call(graph.master.uri, "registerPublisher", "/x", topic, actual.ros1_name, uri)

    def accept(self) -> socket.socket:
        connection, _ = self.server.accept()
        connection.settimeout(LIMIT)
        read_header(connection)
        fields = {"callerid": "/x", "md5sum": self.type.md5, "type": self.type.ros1_name}
        connection.sendall(encode_header(fields))
        return connection

    def close(self) -> None:
        self.server.close()
        self.node.close()


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"", "without a header"),
        (b"\xde\xad\xbe\xef" * 100, "announces"),
        (b"\x10\x00\x00\x00abc", "after 3 of 16 bytes"),
        (encode_header({"topic": "/nothing"}), "is not published here"),
        (encode_header({"service": "/nothing"}), "is not offered here"),
        (encode_header({"topic": "/depth", "md5sum": "0" * 32}), "carries std_msgs/Float64"),
        (encode_header({"no": "thing"}), "is not published here"),
    ],
)
def test_garbage_on_the_port_is_reported(graph: Graph, data: bytes, text: str) -> None:
    sim = graph.node()
    sim.bus.publisher("depth", Float64)
    graph.wait_until_ready()
    with connect(port_of(sim)) as peer, suppress(OSError):
        peer.sendall(data)  # the node may leave before all is read: broken, reset, not connected
        peer.shutdown(socket.SHUT_WR)
        while peer.recv(4096):
            pass
    wait_until(lambda: any(text in line for line in graph.lines), graph.step)
    assert call(sim.uri, "getPid", "/x") > 0


def test_a_client_that_sends_no_header_is_left(graph: Graph) -> None:
    sim = graph.node(header=0.05)
    graph.wait_until_ready()
    with connect(port_of(sim)) as peer:
        assert peer.recv(1) == b""
    wait_until(lambda: any("sends nothing" in line for line in graph.lines), graph.step)


def test_a_subscriber_that_stalls_costs_bounded_memory(graph: Graph) -> None:
    sim = graph.node(send=LIMIT)
    publish = sim.bus.publisher("camera", Image)
    graph.wait_until_ready()
    with subscribe(sim, "/camera"):
        graph.wait_for_connections("/camera")
        (queue,) = sim._publications["/camera"]._queues
        pixels = np.zeros((480, 640, 3), np.uint8)
        for i in range(200):
            publish(image(pixels, time=float(i)))
            graph.step()
            assert len(queue) * pixels.nbytes <= QUEUE_BYTES
        assert any("too slowly" in line for line in graph.lines)


def test_a_subscriber_that_stalls_is_left(graph: Graph) -> None:
    sim = graph.node(send=0.2)
    publish = sim.bus.publisher("camera", Image)
    graph.wait_until_ready()
    message = image(np.zeros((480, 640, 3), np.uint8), time=0.0)

    def step() -> None:
        publish(message)
        graph.step()

    with subscribe(sim, "/camera"):
        wait_until(lambda: any("does not read" in line for line in graph.lines), step)
        wait_until(lambda: not sim.bus.has_subscribers("camera"), graph.step)


def test_a_subscriber_killed_in_mid_transfer_is_forgotten(graph: Graph) -> None:
    sim = graph.node()
    publish = sim.bus.publisher("camera", Image)
    graph.wait_until_ready()
    peer = subscribe(sim, "/camera")
    graph.wait_for_connections("/camera")
    publish(image(np.zeros((480, 640, 3), np.uint8), time=0.0))
    graph.step()
    assert peer.recv(1000)
    peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    peer.close()  # with a reset
    wait_until(lambda: not sim.bus.has_subscribers("camera"), graph.step)


@pytest.mark.slow
def test_a_flood_of_messages_is_bounded(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subscription, "LINK_SHARE", 1e3)  # read as fast as it comes
    monkeypatch.setattr(subscription, "ALL_SHARE", 1e3)
    sim = graph.node()
    actual: list[Float64] = []
    sim.bus.subscribe("cmd", Float64, actual.append)
    graph.wait_until_ready()
    publisher = FakePublisher(graph, "/cmd", Float64)
    connection = publisher.accept()
    frames = b"".join(add_length(to_ros1(Float64(data=float(i)))) for i in range(100_000))
    connection.sendall(frames)
    last_value = 99_999.0
    wait_until(lambda: _newest_value(sim, "cmd") == last_value)
    graph.step()
    assert actual[-1].data == last_value
    assert len(actual) <= 1000
    assert any("faster than the simulation reads them" in line for line in graph.lines)
    connection.close()
    publisher.close()


N_FLOOD = 3000


@pytest.mark.parametrize("name", ["LINK", "ALL"])
def test_a_flood_of_messages_waits_in_the_sockets(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.setattr(subscription, f"{name}_BURST", 1e-3)  # [s]
    monkeypatch.setattr(subscription, f"{name}_SHARE", 1e-7)
    sim = graph.node()
    sim.bus.subscribe("cmd", Float64, print)
    graph.wait_until_ready()
    publisher = FakePublisher(graph, "/cmd", Float64)
    connection = publisher.accept()
    connection.sendall(add_length(to_ros1(Float64(data=1.0))) * N_FLOOD)
    wait_until(lambda: any("faster than uwsim reads" in line for line in graph.lines))
    assert 0 < sim.arrivals.n_arrived["cmd"] < N_FLOOD
    connection.close()
    publisher.close()


def test_a_node_that_the_run_waits_for_does_not_wait(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(subscription, "LINK_BURST", 1e-3)  # [s]
    monkeypatch.setattr(subscription, "LINK_SHARE", 1e-7)
    sim = graph.node()
    sim.admission = SingleProgram(lambda sender, text: None)
    sim.admission.admit("node /x")
    sim.bus.subscribe("cmd", Float64, print)
    graph.wait_until_ready()
    publisher = FakePublisher(graph, "/cmd", Float64)
    connection = publisher.accept()
    connection.sendall(add_length(to_ros1(Float64(data=1.0))) * N_FLOOD)
    wait_until(lambda: sim.arrivals.n_arrived["cmd"] == N_FLOOD)
    connection.close()
    publisher.close()


def _newest_value(sim: Ros1Bridge, topic: str) -> float | None:
    queue = sim.arrivals._queues.get(topic)
    items = list(queue._items) if queue else []
    return items[-1][0][0].data if items else None  # type: ignore[attr-defined]


def test_garbage_from_a_publisher_is_reported_and_the_next_message_is_read(graph: Graph) -> None:
    sim = graph.node()
    actual: list[JointState] = []
    sim.bus.subscribe("joints", JointState, actual.append)
    graph.wait_until_ready()
    publisher = FakePublisher(graph, "/joints", JointState)
    connection = publisher.accept()
    connection.sendall(
        add_length(b"\xff" * 100) + add_length(b"") + add_length(to_ros1(JointState(name=["a"])))
    )
    wait_until(lambda: actual, graph.step)
    assert actual[0].name == ["a"]
    assert any("100 bytes are not a sensor_msgs/msg/JointState" in line for line in graph.lines)
    connection.close()
    publisher.close()


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"\xff\xff\xff\x7f", "announces 2147483647 bytes"),
        (b"\x10\x00\x00\x00abc", "after 3 of 16 bytes"),
        (b"\x10\x00", "in the middle of a length"),
    ],
)
def test_a_publisher_that_breaks_off_is_tried_again(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, data: bytes, text: str
) -> None:
    monkeypatch.setattr("uwsim.middleware.ros1.subscription.RETRY_INTERVAL", 0.05)  # [s]
    sim = graph.node()
    actual: list[Float64] = []
    sim.bus.subscribe("cmd", Float64, actual.append)
    graph.wait_until_ready()
    publisher = FakePublisher(graph, "/cmd", Float64)
    connection = publisher.accept()
    connection.sendall(data)
    connection.close()
    wait_until(lambda: any(text in line for line in graph.lines), graph.step)
    next_connection = publisher.accept()
    next_connection.sendall(add_length(to_ros1(Float64(data=3.0))))
    wait_until(lambda: actual, graph.step)
    next_connection.close()
    publisher.close()


def test_a_publisher_that_does_not_exist_is_reported(graph: Graph) -> None:
    sim = graph.node()
    sim.bus.subscribe("cmd", Float64, print)
    graph.wait_until_ready()
    call(graph.master.uri, "registerPublisher", "/x", "/cmd", "std_msgs/Float64", "http://[bad")
    call(graph.master.uri, "registerPublisher", "/y", "/cmd", "*", "http://127.0.0.1:1/")
    wait_until(lambda: sum("publisher http://" in line for line in graph.lines) >= 2, graph.step)


def test_a_client_of_a_service_that_sends_garbage_gets_an_error(graph: Graph) -> None:
    from uwsim.messages import GTpublish, GTpublishResponse

    sim = graph.node()
    sim.bus.services.serve("init", GTpublish, lambda request: GTpublishResponse())
    graph.wait_until_ready()
    with connect(port_of(sim)) as peer:
        peer.sendall(encode_header({"callerid": "/x", "md5sum": "*", "service": "/init"}))
        read_header(peer)
        peer.sendall(add_length(b"\xff\xff\xff\xff"))
        assert peer.recv(1) == b"\x00"


def test_a_client_of_a_service_killed_in_the_middle_of_its_request_is_forgotten(
    graph: Graph,
) -> None:
    from uwsim.messages import GTpublish, GTpublishResponse

    sim = graph.node()
    requests: list[object] = []

    def answer(request: object) -> GTpublishResponse:
        requests.append(request)
        return GTpublishResponse()

    sim.bus.services.serve("init", GTpublish, answer)
    graph.wait_until_ready()
    fields = encode_header({"callerid": "/x", "md5sum": "*", "service": "/init"})
    request = add_length(to_ros1(GTpublish(groundTruth=np.ones(8, np.float32))))
    for data in (fields[:9], fields, fields + request[:5]):
        peer = connect(port_of(sim))
        peer.sendall(data)
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        peer.close()  # with a reset
    with connect(port_of(sim)) as peer:
        peer.sendall(fields + request)
        wait_until(lambda: requests, graph.step)
    wait_until(lambda: not sim._listener.n_connections, graph.step)
    assert len(requests) == 1


def ask_persistently(sim: Ros1Bridge) -> socket.socket:
    """Connect to a service for several requests; returns when the first of them is awaited."""
    peer = connect(port_of(sim))
    fields = {"callerid": "/x", "md5sum": "*", "service": "/reset", "persistent": "1"}
    peer.sendall(encode_header(fields))
    read_header(peer)
    port = peer.getsockname()[1]

    def is_awaited() -> bool:
        with sim._idle_clients._lock:
            return any(port == entry.getpeername()[1] for entry in sim._idle_clients._connections)

    wait_until(is_awaited)
    return peer


def test_of_too_many_clients_that_ask_nothing_the_longest_idle_is_left(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.middleware.ros1.services.MAX_IDLE", 2)
    sim = graph.node()
    sim.bus.services.serve("reset", Empty, lambda request: EmptyResponse())
    graph.wait_until_ready()
    with ExitStack() as stack:
        first_client, second, third_client = (
            stack.enter_context(ask_persistently(sim)) for _ in range(3)
        )
        assert first_client.recv(1) == b""
        fourth = stack.enter_context(ask_persistently(sim))
        assert second.recv(1) == b""
        for peer in (third_client, fourth, third_client):
            peer.sendall(add_length(b""))
            wait_until(lambda peer=peer: select([peer], [], [], 0.0)[0], graph.step)
            assert peer.recv(5, socket.MSG_WAITALL) == b"\x01" + bytes(4)
    wait_until(lambda: any("it is idle, like 2 newer connections" in line for line in graph.lines))


def test_many_connections_are_bounded(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("uwsim.middleware.ros1.listener.MAX_CONNECTIONS", 5)
    sim = graph.node()
    graph.wait_until_ready()
    port = port_of(sim)
    peers = [connect(port) for _ in range(8)]
    wait_until(
        lambda: any("more than 5 connections" in x or "one is refused" in x for x in graph.lines)
    )
    for peer in peers:
        peer.close()
    wait_until(lambda: not sim._listener.n_connections)
    assert QUEUE_LENGTH > 0


def test_many_connections_that_break_off_are_few_lines(graph: Graph) -> None:
    sim = graph.node()
    graph.wait_until_ready()
    port = port_of(sim)
    for n in range(1, 40):
        with connect(port) as peer:
            peer.sendall(struct.pack("<I", 100 + n) + bytes(n))
    wait_until(lambda: "further such lines" in "".join(graph.lines), graph.step)
    assert sum("it closed the connection after" in line for line in graph.lines) == 6


def test_a_thousand_publishers_of_a_topic_are_bounded(graph: Graph) -> None:
    sim = graph.node()
    actual: list[Float64] = []
    sim.bus.subscribe("cmd", Float64, actual.append)
    graph.wait_until_ready()
    value_before = threading.active_count()
    uris = [f"http://127.0.0.1:{port}/" for port in range(1, 1001)]
    call(sim.uri, "publisherUpdate", "/x", "/cmd", uris)
    wait_until(lambda: any("1000 publishers; 100" in line for line in graph.lines), graph.step)
    assert threading.active_count() - value_before < 110
    call(sim.uri, "publisherUpdate", "/x", "/cmd", [])
    wait_until(lambda: threading.active_count() <= value_before + 2, graph.step)
