"""Messages as bytes of ROS 1 and ROS 2, and back."""

from __future__ import annotations

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from tests.middleware.test_types import MESSAGES
from uwsim import messages
from uwsim.errors import BadMessage
from uwsim.messages.services import SERVICES
from uwsim.middleware.encodings import from_cdr, from_ros1, to_cdr, to_ros1


def info() -> messages.CameraInfo:
    return messages.CameraInfo(
        header=messages.header(2.5, "bowtech1"),
        height=240,
        width=320,
        k=np.arange(9.0),
        p=np.arange(12.0),
    )


@pytest.mark.parametrize("kind", MESSAGES, ids=lambda kind: kind.__name__)
def test_every_message_survives_both_encodings(kind: type) -> None:
    empty_message = kind()
    back = from_cdr(kind, bytes(to_cdr(empty_message)))
    assert type(back) is kind
    assert bytes(to_cdr(back)) == bytes(to_cdr(empty_message))
    if kind in (messages.MeshFile, messages.UVCoordinate):
        with pytest.raises(BadMessage, match="ROS 1 has no type"):
            to_ros1(empty_message)
        return
    second_data = from_ros1(kind, bytes(to_ros1(empty_message)))
    assert type(second_data) is kind
    assert bytes(to_cdr(second_data)) == bytes(to_cdr(empty_message))


@pytest.mark.parametrize("name", SERVICES)
def test_both_halves_of_every_service_survive(name: str) -> None:
    service_type = SERVICES[name]
    for half in (service_type.request, service_type.response):
        values = {
            "GTpublish": {"groundTruth": np.arange(8, dtype=np.float32)},
            "SpawnMarker": {"marker": messages.Marker(id=3)},
            "SpawnMarkerResponse": {"success": True, "status_message": "done"},
        }.get(half.__name__, {})
        message = half(**values)
        assert bytes(to_cdr(from_cdr(half, bytes(to_cdr(message))))) == bytes(to_cdr(message))
        assert bytes(to_ros1(from_ros1(half, bytes(to_ros1(message))))) == bytes(to_ros1(message))


def test_an_empty_request_is_one_byte_in_ros_2_and_none_in_ros_1() -> None:
    assert bytes(to_cdr(messages.Empty())) == b"\x00\x01\x00\x00\x00"
    assert bytes(to_ros1(messages.Empty())) == b""


def test_the_header_of_ros_1_has_a_sequence_number() -> None:
    actual = get_typestore(Stores.ROS1_NOETIC).deserialize_ros1(
        to_ros1(info(), seq=7), "sensor_msgs/msg/CameraInfo"
    )
    assert (actual.header.seq, actual.header.stamp.sec, actual.header.frame_id) == (
        7,
        2,
        "bowtech1",
    )
    assert actual.K.tolist() == list(range(9))


def test_a_message_of_ros_1_loses_nothing_that_ros_2_has() -> None:
    back = from_ros1(messages.CameraInfo, bytes(to_ros1(info())))
    assert back.header == info().header
    assert back.p.tolist() == list(range(12))


def test_an_array_of_another_dtype_is_converted() -> None:
    message = messages.JointState(name=["a"], position=np.array([1, 2]))
    assert from_cdr(messages.JointState, to_cdr(message)).position.tolist() == [1.0, 2.0]
    assert from_ros1(messages.JointState, to_ros1(message)).position.tolist() == [1.0, 2.0]


@pytest.mark.parametrize("data", [b"", b"\x00", b"\xff" * 3, b"\x00\x01\x00\x00" + b"\xff" * 40])
def test_bytes_that_do_not_fit_are_refused(data: bytes) -> None:
    with pytest.raises(BadMessage):
        from_cdr(messages.JointState, data)
    with pytest.raises(BadMessage):
        from_ros1(messages.JointState, data)


def test_a_class_without_a_definition_is_refused() -> None:
    with pytest.raises(BadMessage, match="dict"):
        to_cdr({})
