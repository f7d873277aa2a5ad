"""A bus in a ROS 1 graph: topics both ways, services both ways, clock, parameters, restarts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from tests.middleware.ros1.nodes import TIMESTEP, Graph
from tests.support.waiting import wait_until
from uwsim.errors import UwsimError
from uwsim.messages import (
    DVL,
    EmptyResponse,
    Float64,
    GTpublish,
    GTpublishResponse,
    Image,
    Marker,
    MarkerArray,
    Odometry,
    Time,
    TwistStamped,
    header,
    image,
)
from uwsim.messages.services import Empty
from uwsim.middleware.ros1 import Master
from uwsim.middleware.ros1.xmlrpc import call
from uwsim.middleware.types import message_class


@pytest.fixture
def graph() -> Iterator[Graph]:
    new_graph = Graph()
    yield new_graph
    new_graph.close()


def heard_by(node: Any, topic: str, kind: type) -> list[Any]:
    actual: list[Any] = []
    node.bus.subscribe(topic, kind, actual.append)
    return actual


@pytest.mark.parametrize(
    "message",
    [
        Odometry(header=header(2.5, "world"), child_frame_id="g500"),
        DVL(header=header(2.5), bi_x_axis=0.25, bi_status="A"),
        image(np.arange(320 * 240 * 3, dtype=np.uint8).reshape(240, 320, 3), time=2.5),
    ],
    ids=lambda message: type(message).__name__,
)
def test_a_message_arrives_as_it_was_sent(graph: Graph, message: Any) -> None:
    sim, other = graph.node(), graph.node("/other")
    publish = sim.bus.publisher("/topic", type(message))
    actual = heard_by(other, "topic", type(message))
    graph.wait_until_ready()
    graph.wait_for_connections("/topic")
    publish(message)
    wait_until(lambda: actual, graph.step)
    assert actual[0].header == message.header
    assert repr(actual[0]) == repr(message)


def test_a_topic_without_subscribers_outside_is_not_read(graph: Graph) -> None:
    sim, other = graph.node(), graph.node("/other")
    sim.bus.publisher("camera", Image)
    graph.wait_until_ready()
    assert not sim.bus.has_subscribers("camera")
    stop = other.bus.subscribe("camera", Image, print)
    graph.wait_until_ready()
    graph.wait_for_connections("/camera")
    stop()
    wait_until(lambda: not sim.bus.has_subscribers("camera"), graph.step)


def test_a_topic_that_a_track_withholds_is_not_in_the_graph_and_is_named(graph: Graph) -> None:
    sim = graph.node()
    for topic in ("rov/odom", "rov/depth"):
        sim.bus.publisher(topic, Odometry)
    sim.bus.hide_topic("rov/odom", "(PATToROSOdom) is not in track 'a'")
    graph.wait_until_ready()
    topics = [name for name, _ in call(graph.master.uri, "getPublishedTopics", "/x", "")]
    assert "/rov/depth" in topics
    assert "/rov/odom" not in topics
    assert any("/rov/odom is not sent: it (PATToROSOdom)" in line for line in graph.lines)


def test_a_command_from_outside_arrives_with_its_stamp_in_simulation_time(graph: Graph) -> None:
    sim, other = graph.node(), graph.node("/other")
    actual = heard_by(sim, "twist", TwistStamped)
    publish = other.bus.publisher("twist", TwistStamped)
    graph.wait_until_ready()
    wait_until(lambda: other.bus.has_subscribers("twist"), graph.step)
    for i in range(20):
        publish(TwistStamped(header=header(0.5 + i)))
    wait_until(lambda: len(actual) == 20, graph.step)
    assert [entry.header.stamp for entry in actual] == [
        Time(sec=i, nanosec=500_000_000) for i in range(20)
    ]


def test_the_clock_begins_at_one_second(graph: Graph) -> None:
    sim, other = graph.node(), graph.node("/other")
    clock = message_class("rosgraph_msgs/Clock")
    actual = heard_by(other, "clock", clock)
    graph.wait_until_ready()
    wait_until(lambda: sim.n_connected("/clock") and actual, graph.step)
    assert actual[0].clock.sec >= 1


def test_the_clock_comes_at_every_step_while_it_is_read(graph: Graph) -> None:
    """The loop of a node with a period of one step is not slowed down by the clock."""
    sim, other = graph.node(), graph.node("/other")
    actual = heard_by(other, "clock", message_class("rosgraph_msgs/Clock"))
    graph.wait_until_ready()
    wait_until(lambda: sim.n_connected("/clock") and actual, graph.step)
    first_time = sim.bus.step
    for _ in range(25):
        graph.step()
    wait_until(lambda: _step_of(actual[-1]) >= sim.bus.step, other.step)
    steps = [_step_of(message) for message in actual]
    assert steps[-25:] == list(range(first_time + 1, first_time + 26))


def _step_of(message: Any) -> int:
    """The step at which a message of ``/clock`` was sent."""
    time = message.clock.sec - 1 + message.clock.nanosec * 1e-9
    return round(time / TIMESTEP)


def test_a_service_is_called_from_outside(graph: Graph) -> None:
    sim, other = graph.node(), graph.node("/other")
    requests: list[Any] = []

    def answer(request: GTpublish) -> GTpublishResponse:
        requests.append(request)
        return GTpublishResponse()

    sim.bus.services.serve("vision/init", GTpublish, answer)
    graph.wait_until_ready()
    assert other.bus.services.is_offered("/vision/init")
    import threading

    results: list[object] = []
    request = GTpublish(np.arange(8, dtype=np.float32))
    caller = threading.Thread(
        target=lambda: results.append(other.bus.services.call("vision/init", request)), daemon=True
    )
    caller.start()
    wait_until(lambda: results, sim.step)
    assert results == [GTpublishResponse()]
    assert requests[0].groundTruth.tolist() == list(range(8))


def test_a_service_that_fails_is_an_error_of_the_caller(graph: Graph) -> None:
    sim, other = graph.node(), graph.node("/other")

    def answer(request: Empty) -> EmptyResponse:
        raise UwsimError("the arm is stuck")

    sim.bus.services.serve("reset", Empty, answer)
    graph.wait_until_ready()
    import threading

    errors: list[str] = []

    def ask() -> None:
        try:
            other.bus.services.call("reset", Empty())
        except UwsimError as error:
            errors.append(str(error))

    threading.Thread(target=ask, daemon=True).start()
    wait_until(lambda: errors, sim.step)
    assert "the arm is stuck" in errors[0]


def test_a_service_of_another_type_is_refused(graph: Graph) -> None:
    sim, other = graph.node(), graph.node("/other")
    sim.bus.services.serve("reset", Empty, lambda request: EmptyResponse())
    graph.wait_until_ready()
    with pytest.raises(UwsimError, match="service is std_srvs/Empty"):
        other.bus.services.call("reset", GTpublish(np.zeros(8, np.float32)))


def test_a_service_that_nobody_has_is_not_served(graph: Graph) -> None:
    sim = graph.node()
    graph.wait_until_ready()
    assert not sim.bus.services.is_offered("nothing")


def test_a_topic_of_another_type_is_refused_on_both_sides(graph: Graph) -> None:
    sim, other = graph.node(), graph.node("/other")
    sim.bus.publisher("depth", Float64)
    other.bus.subscribe("depth", Odometry, print)
    graph.wait_until_ready()
    wait_until(lambda: any("topic /depth carries std_msgs/Float64" in x for x in graph.lines))
    assert sim.n_connected("/depth") == 0


def test_parameters_are_set_while_the_node_is_there_and_put_back(graph: Graph) -> None:
    call(graph.master.uri, "setParam", "/x", "/use_sim_time", False)
    sim = graph.node(parameters={"/use_sim_time": True, "/uwsim/seed": 7})
    graph.wait_until_ready()
    wait_until(lambda: call(graph.master.uri, "hasParam", "/x", "/uwsim/seed"))
    assert call(graph.master.uri, "getParam", "/x", "/uwsim/seed") == 7
    assert call(graph.master.uri, "getParam", "/x", "/use_sim_time") is True
    sim.close()
    graph.nodes.clear()
    assert call(graph.master.uri, "getParam", "/x", "/use_sim_time") is False
    assert call(graph.master.uri, "hasParam", "/x", "/uwsim/seed") is False
    assert call(graph.master.uri, "getSystemState", "/x") == [[], [], []]


def test_a_master_that_is_restarted_knows_the_node_again(graph: Graph) -> None:
    sim = graph.node()
    sim.bus.publisher("depth", Float64)
    graph.wait_until_ready()
    port = int(graph.master.uri.rsplit(":", 1)[1].strip("/"))
    graph.master.close()
    wait_until(lambda: any("is tried again" in line for line in graph.lines))
    graph.step()
    graph.master = Master(graph.log, port=port)
    wait_until(lambda: _topics(graph.master) == ["/clock", "/depth", "/rosout"])
    assert any("restarted" in line for line in graph.lines)


def _topics(master: Master) -> list[str]:
    return [name for name, _ in call(master.uri, "getPublishedTopics", "/x", "")]


def test_a_node_whose_name_is_taken_leaves_the_graph(graph: Graph) -> None:
    first_node = graph.node()
    graph.wait_until_ready()
    second = graph.node()
    wait_until(lambda: any("leave" in line for line in graph.lines), graph.step)
    wait_until(lambda: call(graph.master.uri, "lookupNode", "/x", "/uwsim") == second.uri)
    first_node.step()


def test_what_happens_is_on_rosout(graph: Graph) -> None:
    from uwsim.middleware.ros1.tcpros import encode_header, open_connection, read_frame, read_header

    sim = graph.node()
    graph.wait_until_ready()
    place = call(sim.uri, "requestTopic", "/x", "/rosout", [["TCPROS"]])
    peer = open_connection(place[1], place[2], 60.0)
    peer.sendall(encode_header({"callerid": "/x", "md5sum": "*", "topic": "/rosout", "type": "*"}))
    assert read_header(peer)["type"] == "rosgraph_msgs/Log"
    wait_until(lambda: sim.n_connected("/rosout"))
    sim.log.report("something happened")
    frame = read_frame(peer)
    assert frame is not None
    assert b"something happened" in frame
    peer.close()


def test_a_late_node_gets_the_newest_message_of_a_latched_topic(graph: Graph) -> None:
    uwsim, other = graph.node(), graph.node("/other")
    say = uwsim.bus.publisher("scene", MarkerArray)
    say(MarkerArray(markers=[Marker(ns="first")]))
    graph.wait_until_ready()
    say(MarkerArray(markers=[Marker(ns="second", text="x")]))
    graph.step()
    arrivals = heard_by(other, "scene", MarkerArray)
    wait_until(lambda: arrivals, graph.step)
    assert [entry.ns for entry in arrivals[-1].markers] == ["second"]


def test_a_topic_whose_name_is_none_of_ros_is_told_and_the_others_are_there(graph: Graph) -> None:
    sim, other = graph.node(), graph.node("/other")
    for name in ("a b", "tiefe-µ", "two//slashes"):
        sim.bus.publisher(name, Float64)
        sim.bus.subscribe(f"{name}/command", Float64, print)
    publish = sim.bus.publisher("zz", Float64)
    actual = heard_by(other, "zz", Float64)
    graph.wait_until_ready()
    graph.wait_for_connections("/zz")
    publish(Float64(data=1.0))
    wait_until(lambda: actual, graph.step)
    reports = [line for line in graph.lines if "not on the graph" in line]
    assert len(reports) == 6
    assert "uwsim: test: not on the graph: /a b: " in reports[0]
    assert "parameter [topic] contains illegal chars" in reports[0]
    assert not any("tried again" in line for line in graph.lines)
