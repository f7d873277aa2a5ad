"""What viewers ask a rosbridge server for: rosapi, raw messages, compressed images, transforms."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

import cv2
import numpy as np
import pytest

from tests.middleware.web.test_web import Setting, receive, send
from tests.support.waiting import LIMIT
from uwsim.base.geometry import Pose, rotation_about
from uwsim.messages import (
    CompressedImage,
    Empty,
    EmptyResponse,
    Image,
    Odometry,
    Quaternion,
    TFMessage,
    Transform,
    TransformStamped,
    TwistStamped,
    Vector3,
    header,
)
from uwsim.middleware.encodings import from_cdr
from uwsim.middleware.web.rosapi import SERVICES

ODOMETRY = ("nav_msgs/Odometry", "nav_msgs/msg/Odometry")


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Iterator[Setting]:
    monkeypatch.setattr("uwsim.middleware.web.server.CLOSE_TIMEOUT", 0.2)  # [s]
    new_setting = Setting()
    new_setting.bus.publisher("a/odom", Odometry)
    new_setting.bus.publisher("b/odom", Odometry)
    new_setting.bus.publisher("twist", TwistStamped)
    new_setting.bus.services.serve("reset", Empty, lambda request: EmptyResponse())
    new_setting.bridge.step()
    yield new_setting
    new_setting.close()


@pytest.mark.parametrize("type", ODOMETRY)
def test_topics_for_a_type_by_either_spelling(setting: Setting, type: str) -> None:
    requests = {"service": "/rosapi/topics_for_type", "args": {"type": type}}
    assert setting.ask(setting.client(), **requests)["values"] == {"topics": ["/a/odom", "/b/odom"]}


@pytest.mark.parametrize("type", ["std_srvs/Empty", "std_srvs/srv/Empty"])
def test_services_for_a_type_by_either_spelling(setting: Setting, type: str) -> None:
    requests = {"service": "/rosapi/services_for_type", "args": {"type": type}}
    assert setting.ask(setting.client(), **requests)["values"]["services"] == ["/reset"]


@pytest.mark.parametrize("type", ODOMETRY)
def test_the_details_of_a_message_have_all_types_inside_it(setting: Setting, type: str) -> None:
    requests = {"service": "/rosapi/message_details", "args": {"type": type}}
    typedefs = setting.ask(setting.client(), **requests)["values"]["typedefs"]
    by_name = {entry["type"]: entry for entry in typedefs}
    assert typedefs[0]["fieldnames"] == ["header", "child_frame_id", "pose", "twist"]
    assert typedefs[0]["fieldarraylen"] == [-1, -1, -1, -1]
    covariance = by_name["geometry_msgs/msg/PoseWithCovariance"]
    assert (covariance["fieldtypes"][1], covariance["fieldarraylen"][1]) == ("float64", 36)
    assert by_name["builtin_interfaces/msg/Time"]["fieldtypes"] == ["int32", "uint32"]


def test_raw_types_are_the_definitions_with_the_types_inside(setting: Setting) -> None:
    values = setting.ask(setting.client(), service="/rosapi/topics_and_raw_types")["values"]
    assert len(values["topics"]) == len(values["types"]) == len(values["typedefs_full_text"])
    number = values["topics"].index("/a/odom")
    assert values["types"][number] == "nav_msgs/msg/Odometry"
    assert "MSG: geometry_msgs/Twist" in values["typedefs_full_text"][number]
    assert "rcl_interfaces/msg/Log" in values["types"]  # by which viewers know ROS 2


def test_publishers_and_subscribers_are_the_simulation_and_the_clients(setting: Setting) -> None:
    client = setting.client()
    send(client, op="advertise", topic="/mine", type="std_msgs/String")
    send(client, op="subscribe", topic="/twist")
    setting.step_until(lambda: setting.bus.has_subscribers("twist"))
    ask = {"service": "/rosapi/publishers", "args": {"topic": "/twist"}}
    assert setting.ask(client, **ask)["values"]["publishers"] == ["/uwsim"]
    ask = {"service": "/rosapi/publishers", "args": {"topic": "/mine"}}
    (publisher,) = setting.ask(client, **ask)["values"]["publishers"]
    assert publisher.startswith("/client_")
    ask = {"service": "/rosapi/subscribers", "args": {"topic": "/twist"}}
    assert publisher in setting.ask(client, **ask)["values"]["subscribers"]
    assert setting.ask(client, service="/rosapi/nodes")["values"] == {"nodes": ["/uwsim"]}
    ask = {"service": "/rosapi/node_details", "args": {"node": "/uwsim"}}
    assert "/a/odom" in setting.ask(client, **ask)["values"]["publishing"]


@pytest.mark.parametrize("name", sorted(SERVICES))
@pytest.mark.parametrize("args", [{}, {"type": "no/Such"}, [], {"topic": 3, "service": None}])
def test_every_service_of_rosapi_answers_any_arguments(
    setting: Setting, name: str, args: Any
) -> None:
    answer = setting.ask(setting.client(), service=f"/{name}", args=args)
    assert isinstance(answer["values"], dict if answer["result"] else str)


def test_a_message_is_sent_as_cdr(setting: Setting) -> None:
    say = setting.bus.publisher("twist", TwistStamped)
    client = setting.client()
    send(client, op="subscribe", topic="/twist", compression="cbor-raw")
    setting.step_until(lambda: setting.bus.has_subscribers("twist"))
    message = TwistStamped(header=header(0.25))
    message.twist.angular.z = 1.0 / 3.0
    say(message)
    setting.bus.deliver()
    frame = client.recv(timeout=LIMIT)
    assert isinstance(frame, bytes)
    start = frame.index(b"\x00\x01\x00\x00")  # CDR, little-endian
    actual = from_cdr(TwistStamped, frame[start:])
    assert actual.twist.angular.z == 1.0 / 3.0
    assert (actual.header.stamp.sec, actual.header.stamp.nanosec) == (1, 250_000_000)


@pytest.mark.parametrize("encoding", ["rgb8", "mono8"])
def test_every_topic_of_images_has_one_of_compressed_images(
    setting: Setting, encoding: str
) -> None:
    name = f"camera/{encoding}"
    say = setting.bus.publisher(name, Image)
    setting.bridge.step()
    client = setting.client()
    actual = setting.ask(client, service="/rosapi/topics")["values"]
    number = actual["topics"].index(f"/{name}/compressed")
    assert actual["types"][number] == CompressedImage.__msgtype__
    assert not setting.bus.has_subscribers(name)
    kind = "sensor_msgs/CompressedImage"
    send(client, op="subscribe", topic=f"/{name}/compressed", type=kind, compression="cbor")
    setting.step_until(lambda: setting.bus.has_subscribers(name))
    n = 3 if encoding == "rgb8" else 1
    rows = np.arange(48, dtype=np.uint8)[:, None, None] * np.array([5, 2, 1], np.uint8)[:n]
    pixels = np.broadcast_to(rows, (48, 64, n))
    data = np.ascontiguousarray(pixels).reshape(-1)
    image = Image(header(0.0), 48, 64, encoding, 0, 64 * n, data)
    say(image)
    setting.bus.deliver()
    frame = client.recv(timeout=LIMIT)
    assert isinstance(frame, bytes)
    jpeg = np.frombuffer(frame[frame.index(b"\xff\xd8\xff") :], np.uint8)
    read = cv2.imdecode(jpeg, cv2.IMREAD_UNCHANGED)
    assert read is not None
    read = read[..., ::-1] if n == 3 else read[..., None]
    assert np.abs(read.astype(int) - pixels.astype(int)).mean() < 3.0
    send(client, op="unsubscribe", topic=f"/{name}/compressed")
    setting.step_until(lambda: not setting.bus.has_subscribers(name))


def stamped_transform(parent: str, child: str, pose: Pose) -> TransformStamped:
    w, x, y, z = pose.quaternion.tolist()
    result = Transform(Vector3(*pose.position.tolist()), Quaternion(x, y, z, w))
    return TransformStamped(header(0.0, parent), child, result)


def test_transforms_are_republished_between_the_requested_frames(setting: Setting) -> None:
    say = setting.bus.publisher("tf", TFMessage)
    client = setting.client()
    args = {"source_frames": ["/camera", "nowhere"], "target_frame": "/robot", "rate": 5.0}
    args |= {"angular_thres": 0.01, "trans_thres": 0.01, "timeout": {"secs": 1, "nsecs": 0}}
    answer = setting.ask(client, service="/republish_tfs", args=args)
    topic = answer["values"]["topic_name"]
    send(client, op="subscribe", topic=topic, type="tf2_web_republisher/TFArray")
    setting.step_until(lambda: topic.strip("/") in setting.bridge._readers)
    setting.step_until(lambda: setting.bus.has_subscribers("tf"))
    z = np.array([0.0, 0.0, 1.0])
    world_from_robot = Pose(np.array([1.0, 2.0, 0.0]), rotation_about(z, math.pi / 2))
    arm_from_camera = Pose(np.array([0.0, 0.0, 0.3]), np.eye(3))
    robot_from_arm = Pose(np.array([0.5, 0.0, 0.0]), rotation_about(z, 0.4))
    tree = [
        stamped_transform("world", "robot", world_from_robot),
        stamped_transform("arm", "camera", arm_from_camera),
        stamped_transform("robot", "arm", robot_from_arm),
    ]
    for step in range(20):  # 2 s of simulation time; the camera does not move
        setting.time = 0.1 * step
        say(TFMessage(transforms=list(tree)))
        setting.bus.deliver()
    (transform,) = receive(client)["msg"]["transforms"]
    assert transform["header"]["frame_id"] == "robot"
    assert transform["child_frame_id"] == "camera"
    expected = robot_from_arm @ arm_from_camera
    place = [transform["transform"]["translation"][axis] for axis in "xyz"]
    assert place == pytest.approx(expected.position.tolist())
    with pytest.raises(TimeoutError):
        client.recv(timeout=0.1)  # nothing moves
    client.close()
    setting.step_until(lambda: not setting.bus.has_subscribers("tf"))


@pytest.mark.parametrize(
    "args",
    [
        *(None, {}, {"source_frames": "x", "target_frame": "y"}, {"source_frames": [1]}),
        {"source_frames": ["a"] * 1000, "target_frame": "y"},
    ],
)
def test_a_request_for_transforms_that_is_not_valid_is_refused(setting: Setting, args: Any) -> None:
    client = setting.client()
    send(client, op="call_service", service="/republish_tfs", args=args, id="r")
    frame = json.loads(client.recv(timeout=LIMIT))
    assert frame["op"] == "status"
    assert "republish_tfs" in frame["msg"]


def test_transforms_are_the_feedback_of_a_goal_until_it_is_cancelled(setting: Setting) -> None:
    say = setting.bus.publisher("tf", TFMessage)
    client = setting.client()
    action = "/tf2_web_republisher"
    kind = "tf2_web_republisher/TFSubscriptionAction"
    send(client, op="advertise", topic=f"{action}/goal", type=f"{kind}Goal")
    send(client, op="subscribe", topic=f"{action}/feedback", type=f"{kind}Feedback")
    goal = {"source_frames": ["robot"], "target_frame": "world", "rate": 10.0}
    msg = {"goal_id": {"stamp": {"secs": 0, "nsecs": 0}, "id": "goal_7"}, "goal": goal}
    send(client, op="publish", topic=f"{action}/goal", msg=msg)
    setting.step_until(lambda: setting.bus.has_subscribers("tf"))
    pose = Pose(np.array([1.0, 2.0, 3.0]), np.eye(3))
    say(TFMessage(transforms=[stamped_transform("world", "robot", pose)]))
    setting.bus.deliver()
    frame = receive(client)
    assert (frame["op"], frame["topic"]) == ("publish", f"{action}/feedback")
    assert frame["msg"]["status"]["goal_id"]["id"] == "goal_7"
    (transform,) = frame["msg"]["feedback"]["transforms"]
    assert transform["transform"]["translation"] == {"x": 1.0, "y": 2.0, "z": 3.0}
    send(client, op="publish", topic=f"{action}/cancel", msg={"id": "goal_7"})
    setting.ask(client, service="/rosapi/get_time")
    setting.time = 1.0
    say(TFMessage(transforms=[stamped_transform("world", "robot", pose)]))
    setting.bus.deliver()
    with pytest.raises(TimeoutError):
        client.recv(timeout=0.1)
