"""Messages have ROS's defaults, and the fields and constants that rosbags has for them."""

from __future__ import annotations

import dataclasses
import typing

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from uwsim import messages
from uwsim.base import message_fields
from uwsim.base.message_fields import find_invalid_field
from uwsim.bus import Bus
from uwsim.errors import BadMessage
from uwsim.messages import (
    geometry_msgs,
    nav_msgs,
    sensor_msgs,
    std_msgs,
    tf2_msgs,
    visualization_msgs,
)

STORE = get_typestore(Stores.ROS2_JAZZY)
PACKAGES = (std_msgs, geometry_msgs, sensor_msgs, nav_msgs, tf2_msgs, visualization_msgs)
CLASSES = [
    kind
    for package in PACKAGES
    for kind in vars(package).values()
    if getattr(kind, "__module__", "") == package.__name__ and dataclasses.is_dataclass(kind)
]


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.__name__)
def test_a_message_is_made_without_an_argument_and_is_what_ros_reads_from_zeros(
    kind: type,
) -> None:
    message = kind()
    assert find_invalid_field(message) is None
    name = kind.__msgtype__  # type: ignore[attr-defined]
    back = STORE.deserialize_cdr(STORE.serialize_cdr(message, name), name)
    assert back.__class__ is STORE.types[name]
    assert are_equal(message, back)


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.__name__)
def test_fields_and_constants_are_those_of_the_definition(kind: typing.Any) -> None:
    constants, fields = STORE.fielddefs[kind.__msgtype__]
    assert [field.name for field in dataclasses.fields(kind)] == [name for name, _ in fields]
    actual = {name: value for name, value in vars(kind).items() if name.isupper()}
    assert actual == {name: value for name, _, value in constants}


def are_equal(first: object, other: object) -> bool:
    """Whether two messages hold the same, whatever their classes."""
    if dataclasses.is_dataclass(first):
        names = [field.name for field in dataclasses.fields(first)]
        return all(are_equal(getattr(first, name), getattr(other, name)) for name in names)
    if isinstance(first, np.ndarray):
        return first.dtype == np.asarray(other).dtype and np.array_equal(first, np.asarray(other))
    return first == other


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.__name__)
def test_every_number_is_zero_but_the_w_of_no_rotation(kind: type) -> None:
    def numbers(message: object, path: str = "") -> typing.Iterator[tuple[str, object]]:
        for field in dataclasses.fields(typing.cast("typing.Any", message)):
            value = getattr(message, field.name)
            if dataclasses.is_dataclass(value):
                yield from numbers(value, f"{path}{field.name}.")
            elif "ClassVar" not in str(field.type):
                yield f"{path}{field.name}", value

    for path, value in numbers(kind()):
        expected = path == "w" or path.endswith(("orientation.w", "rotation.w"))
        assert np.all(value == expected) or value in ("", []), path


def test_messages_share_nothing() -> None:
    first_message, other = messages.Odometry(), messages.Odometry()
    first_message.twist.twist.linear.x = 1.0
    first_message.pose.covariance[0] = 1.0
    assert other.twist.twist.linear.x == other.pose.covariance[0] == 0.0
    assert first_message.pose.covariance.shape == (36,)


def test_every_message_type_that_is_public_has_defaults() -> None:
    kinds = {getattr(messages, name) for name in messages.__all__}
    type_names = {
        *CLASSES,
        *(messages.PingInfo, messages.SonarImageData, messages.ProjectedSonarImage),
        *(messages.DVL, messages.LedLight, messages.Pressure),
    }
    assert {kind for kind in kinds if "/msg/" in getattr(kind, "__msgtype__", "")} == type_names


def test_the_class_of_another_package_is_named_by_its_package() -> None:
    cls = STORE.types["std_msgs/msg/Bool"]
    publish = Bus().publisher("on", messages.Bool)
    text = r"carries std_msgs/msg/Bool, the class of uwsim\.messages\.std_msgs, not that of rosbags"
    with pytest.raises(BadMessage, match=text):
        publish(typing.cast("messages.Bool", cls(data=True)))


@pytest.mark.parametrize(
    ("value", "error"),
    [
        ("fast", "twist.angular.y is 'fast', expected a number"),
        (None, "twist.angular.y is None, expected a number"),
        (1, None),
        (np.float32(1.0), None),
        (True, None),
    ],
)
def test_a_number_in_a_message_in_a_message_is_checked(value: object, error: str | None) -> None:
    message = messages.TwistStamped()
    message.twist.angular.y = typing.cast("float", value)
    assert find_invalid_field(message) == error


def test_a_message_of_another_type_in_a_message_is_named() -> None:
    message = messages.TwistStamped()
    message.twist.angular = typing.cast("messages.Vector3", messages.Quaternion())
    assert str(find_invalid_field(message)).startswith("twist.angular is Quaternion(")


def test_a_message_of_rosbags_own_class_fits() -> None:
    message = messages.TwistStamped()
    own_names = STORE.types["geometry_msgs/msg/Vector3"](x=1.0, y=0.0, z=0.0)
    message.twist.linear = typing.cast("messages.Vector3", own_names)
    assert find_invalid_field(message) is None


@pytest.mark.parametrize("kind", [messages.TwistStamped, messages.PoseStamped, messages.Bool])
def test_a_message_without_arrays_has_nothing_to_freeze(kind: type) -> None:
    assert message_fields._array_fields(kind) == ()
