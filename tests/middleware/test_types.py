"""Message types outside the process: names, sums and hashes that ROS's own tools give."""

from __future__ import annotations

import pytest

from uwsim import messages
from uwsim.errors import UnknownName
from uwsim.messages.services import EMPTY_SERVICE, GT_PUBLISH, SPAWN_MARKER
from uwsim.middleware.types import message_class, service, service_of, wire_service, wire_type

MD5 = {
    messages.Twist: "9f195f881246fdfa2798d1d3eebca84a",
    messages.Odometry: "cd5e73d190d741a2f92e81eda573aca7",
    messages.Image: "060021388200f6f0f447d0fcd9c64743",
    messages.CameraInfo: "c9a58c1b0b154e0e6da7578cb991d214",
    messages.TFMessage: "94810edda583a504dfda3829e70d7eec",
    messages.Marker: "4048c9de2a16f4ae8e0538085ebf1b97",
    messages.DVL: "c455f331872552e620e26fc7caad335d",
}
"""As ``rosmsg md5`` prints them; those of our own types are genmsg's of the same text."""
HASHES = {
    messages.Bool: "RIHS01_feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9",
}
"""As ``ros2 topic info -v`` prints them."""
TYPES = sorted(
    (each for each in map(messages.__dict__.get, messages.__all__) if isinstance(each, type)),
    key=lambda each: each.__name__,
)
MESSAGES = [each for each in TYPES if "/msg/" in getattr(each, "__msgtype__", "")]


@pytest.mark.parametrize("kind", MD5, ids=lambda kind: kind.__name__)
def test_the_md5_sum_is_that_of_ros_1(kind: type) -> None:
    actual = wire_type(kind)
    assert actual is not None
    assert actual.md5 == MD5[kind]


@pytest.mark.parametrize("kind", HASHES, ids=lambda kind: kind.__name__)
def test_the_hash_is_that_of_ros_2(kind: type) -> None:
    actual = wire_type(kind)
    assert actual is not None
    assert actual.type_hash == HASHES[kind]


@pytest.mark.parametrize("kind", MESSAGES, ids=lambda kind: kind.__name__)
def test_every_message_has_names_and_a_definition(kind: type) -> None:
    actual = wire_type(kind)
    assert actual is not None
    assert actual.ros2_name.replace("/msg/", "/") == actual.ros1_name
    assert actual.ros2_definition
    assert bool(actual.ros1_definition) == (kind not in (messages.MeshFile, messages.UVCoordinate))


def test_a_class_has_both_names() -> None:
    assert message_class("geometry_msgs/Twist") is messages.Twist
    assert message_class("geometry_msgs/msg/Twist") is messages.Twist


def test_a_type_that_only_ros_has_is_found_too() -> None:
    assert message_class("std_msgs/Int32")(data=3).data == 3


def test_an_unknown_type_names_the_nearest() -> None:
    with pytest.raises(UnknownName, match="geometry_msgs/msg/Twist"):
        message_class("geometry_msgs/Twits")


def test_a_class_without_a_definition_has_no_type() -> None:
    assert wire_type(dict) is None


@pytest.mark.parametrize(
    ("wire", "name", "md5"),
    [
        (EMPTY_SERVICE, "std_srvs/Empty", "d41d8cd98f00b204e9800998ecf8427e"),
        (GT_PUBLISH, "underwater_sensor_msgs/GTpublish", "0b412ada447d72a7ae228bb70b64a2cb"),
        (SPAWN_MARKER, "underwater_sensor_msgs/SpawnMarker", "a7395a01b635e68c485c6bc7fed0b5a1"),
    ],
)
def test_a_service_has_its_name_and_sum_in_ros_1(
    wire: messages.Service, name: str, md5: str
) -> None:
    actual = wire_service(wire)
    assert (actual.ros1_name, actual.md5) == (name, md5)
    assert service(name) is wire
    assert service(wire.name) is wire
    assert service_of(wire.request) is wire
    assert actual.request.ros1_name == f"{name}Request"


def test_an_unknown_service_names_the_nearest() -> None:
    with pytest.raises(UnknownName, match="std_srvs/srv/Empty"):
        service("std_srvs/Emtpy")
