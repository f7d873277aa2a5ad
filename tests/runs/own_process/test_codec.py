"""Frames keep every number, and only values and messages that are known come out of them."""

from __future__ import annotations

import json
import math
import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from uwsim.messages import Image, Odometry, Pose, String
from uwsim.runs.own_process.codec import MAX_DEPTH, FrameError, decode, encode

VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**70), 2**70) | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.tuples(inner, inner) | st.dictionaries(st.text(), inner),
    max_leaves=10,
)


def same(a: Any, b: Any) -> bool:
    if isinstance(a, float) and math.isnan(a):
        return isinstance(b, float) and math.isnan(b)
    if isinstance(a, list | tuple):
        return type(a) is type(b) and len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict):
        return list(a) == list(b) and all(same(a[key], b[key]) for key in a)
    return type(a) is type(b) and bool(a == b)


@settings(max_examples=100, deadline=None, suppress_health_check=list(HealthCheck))
@given(VALUES)
def test_values_come_out_as_they_went_in(value: object) -> None:
    assert same(value, decode(encode(value)))


@pytest.mark.parametrize("dtype", ["f4", "f8", "u1", "i8", ">f8", "bool"])
def test_arrays_and_their_scalars_keep_type_and_shape(dtype: str) -> None:
    array = np.arange(6).reshape(2, 3).astype(dtype)
    read, scalar = decode(encode([array, array[1, 1]]))
    assert read.dtype == array.dtype
    assert np.array_equal(read, array)
    assert not read.flags.writeable
    assert type(scalar) is type(array[1, 1])
    assert scalar == array[1, 1]


def test_a_message_comes_out_in_its_class_with_all_in_it() -> None:
    message = Odometry(child_frame_id="base")
    message.pose.pose.position.x = 0.1 + 0.2
    image = Image(height=2, width=1, data=np.array([1, 2], dtype=np.uint8))
    read, other = decode(encode([message, image]))
    assert type(read) is Odometry
    assert read.pose.pose.position.x == 0.1 + 0.2
    assert np.array_equal(read.pose.covariance, message.pose.covariance)
    assert other.data.tolist() == [1, 2]


def test_a_value_that_cannot_leave_is_shown_as_it_was() -> None:
    read = decode(encode({"a": {1, 2}}))["a"]
    assert repr(read) == "{1, 2}"
    assert type(read).__name__ == "set"


def test_an_object_of_no_class_cannot_leave_either() -> None:
    value = object()
    assert repr(decode(encode([value]))[0]) == repr(value)


@pytest.mark.parametrize(("depth", "left"), [(50, 50), (10_000, MAX_DEPTH + 1)])
def test_a_value_that_is_nested_too_deep_is_cut_off(depth: int, left: int) -> None:
    value: list[object] = []
    for _ in range(depth):
        value = [value]
    read, n = decode(encode(value)), 0
    while isinstance(read, list) and read:
        read, n = read[0], n + 1
    assert n == left


def test_a_dict_that_holds_itself_is_cut_off() -> None:
    value: dict[str, object] = {}
    value["in"] = value
    assert "{...}" in repr(decode(encode(value)))


def frame(head: object, tail: bytes = b"") -> bytes:
    text = json.dumps(head).encode()
    return struct.pack("<I", len(text)) + text + tail


@pytest.mark.parametrize(
    "bad",
    [
        b"",
        b"\xff\xff\xff\xff",
        b"\x00\x00\x00\x05nasty",
        frame(1, b"more"),
        frame({"x": 1}),
        frame({"m": ["os:system"]}),
        frame({"m": ["uwsim.runs.planning.plan:Plan"]}),
        frame({"c": "subprocess:Popen"}),
        frame({"m": ["uwsim.messages.std_msgs:String"]}),
        frame({"a": ["|O", 1]}, b"12345678"),
        frame({"a": ["<f8", 2**40]}, b"12345678"),
        frame({"a": ["<f8", -1]}, b"12345678"),
        frame({"a": ["<f8", 0, 2**70]}),
        frame({"a": ["f8,,"]}),
        frame({"m": [5]}),
        frame({"c": 5}),
        frame({"b": math.inf}),
        b"\x00\xea\x00\x00" + b"[" * 60_000,
    ],
    ids=range(18),
)
def test_bytes_that_are_no_frame_are_refused(bad: bytes) -> None:
    assert String.__module__ == "uwsim.messages.std_msgs"
    with pytest.raises(FrameError):
        decode(bad)


def test_fields_are_set_without_running_code() -> None:
    assert decode(frame({"m": ["uwsim.messages.std_msgs:String", "x"]})) == String(data="x")
    assert type(decode(encode(Pose()))) is Pose
