"""Messages as JSON of rosbridge, and back."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from uwsim.errors import BadMessage
from uwsim.messages import (
    DVL,
    Empty,
    GTpublish,
    Image,
    JointState,
    Marker,
    Odometry,
    TFMessage,
    TransformStamped,
    TwistStamped,
    floats,
    header,
)
from uwsim.middleware.json_encoding import from_json, to_json
from uwsim.middleware.types import message_class


def there_and_back(message: object) -> object:
    text = json.dumps(to_json(message), allow_nan=False)
    return from_json(type(message), json.loads(text))


def test_numbers_keep_all_digits() -> None:
    message = Odometry(header=header(0.1 + 0.2, "world"))
    message.pose.pose.position.x = 1.0 / 3.0
    message.pose.covariance = np.arange(36) / 7.0
    read = there_and_back(message)
    assert isinstance(read, Odometry)
    assert read.pose.pose.position.x == 1.0 / 3.0
    assert read.pose.pose.orientation.w == 1.0
    assert np.array_equal(read.pose.covariance, np.arange(36) / 7.0)
    assert read.header == message.header


@pytest.mark.parametrize(
    "message",
    [
        Image(height=1, width=2, encoding="mono8", step=2, data=np.array([1, 255], np.uint8)),
        JointState(name=["a", "b"], position=np.array([0.1, -0.0])),
        TFMessage(transforms=[TransformStamped(child_frame_id="c")]),
        GTpublish(groundTruth=np.array([0.1, 2.0], np.float32)),
        Marker(text="t"),
        DVL(),
        Empty(),
        floats([1.5]),
    ],
    ids=lambda message: type(message).__name__,
)
def test_every_kind_of_field_comes_back(message: object) -> None:
    assert json.dumps(to_json(there_and_back(message))) == json.dumps(to_json(message))


def test_what_is_not_finite_is_null() -> None:
    message = floats([math.inf, 1.0])
    assert to_json(message)["data"] == [None, 1.0]
    assert math.isnan(from_json(type(message), {"data": [None, 1.0]}).data[0])


def test_fields_may_be_left_out_or_named_as_in_ros_1() -> None:
    stamp = {"header": {"seq": 3, "stamp": {"secs": 2, "nsecs": 5}}, "twist": {"linear": {"x": 1}}}
    read = from_json(TwistStamped, stamp)
    assert (read.header.stamp.sec, read.header.stamp.nanosec) == (2, 5)
    assert read.twist.linear.x == 1.0
    assert from_json(GTpublish, {}).groundTruth.size == 0
    assert from_json(message_class("sensor_msgs/Joy"), {"axes": [1]}).buttons.size == 0
    assert from_json(Image, {"data": [1, 2]}).data.tolist() == [1, 2]


@pytest.mark.parametrize(
    ("cls", "values", "line"),
    [
        (TwistStamped, {"twits": {}}, "TwistStamped has no field twits; it has header, twist."),
        (TwistStamped, [], "geometry_msgs/msg/TwistStamped is []; expected an object."),
        (TwistStamped, {"twist": {"linear": {"x": "1"}}}, "twist.linear.x is '1'; expected"),
        (Image, {"height": -1}, "height is -1; expected a value of type uint32."),
        (Image, {"height": 1.5}, "height is 1.5; expected"),
        (Image, {"encoding": 3}, "encoding is 3; expected text."),
        (Image, {"data": "§"}, "data is '§'; expected base64."),
        (Image, {"data": [256]}, "data is [256]; expected numbers (uint8)."),
        (Odometry, {"pose": {"covariance": [1]}}, "pose.covariance has 1 values; expected 36."),
        (JointState, {"name": "a"}, "name is 'a'; expected a list."),
        (TFMessage, {"transforms": [3]}, "transforms[0] is 3; expected an object."),
    ],
)
def test_what_does_not_fit_is_one_line(cls: type, values: object, line: str) -> None:
    with pytest.raises(BadMessage) as excinfo:
        from_json(cls, values)
    assert line in str(excinfo.value)
    assert "\n" not in str(excinfo.value)


@pytest.mark.parametrize("text", ["1e309", "-1e309", "1" * 400, "-" + "1" * 400, "Infinity"])
@pytest.mark.parametrize(
    ("cls", "shape"),
    [
        (TwistStamped, '{"twist": {"linear": {"y": %s}}}'),
        (Odometry, '{"pose": {"pose": {"orientation": {"w": %s}}}}'),
        (Image, '{"height": %s}'),
        (Image, '{"data": [1, %s]}'),
        (JointState, '{"position": [0.5, %s]}'),
        (GTpublish, '{"groundTruth": [%s]}'),
        (TwistStamped, '{"header": {"stamp": {"sec": %s}}}'),
    ],
)
def test_a_number_beyond_its_type_is_one_line(cls: type, shape: str, text: str) -> None:
    with pytest.raises(BadMessage, match="expected") as excinfo:
        from_json(cls, json.loads(shape % text))
    assert "\n" not in str(excinfo.value)


@pytest.mark.parametrize("value", [1e39, -3.5e38, 10**39])
def test_a_number_beyond_float32_is_one_line_and_no_warning(value: float) -> None:
    with pytest.raises(BadMessage, match="groundTruth"):
        from_json(GTpublish, {"groundTruth": [0.5, value]})


def test_nested_lists_are_no_numbers() -> None:
    for values in ([[1.0, 2.0], [3.0, 4.0]], [[]], [1.0, [2.0]]):
        with pytest.raises(BadMessage, match="groundTruth"):
            from_json(GTpublish, {"groundTruth": values})
