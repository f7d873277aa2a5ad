from typing import TypeVar

import numpy as np
import pytest

from uwsim.bus import Bus
from uwsim.errors import BadMessage, BadSetting, UnknownName, UwsimError
from uwsim.messages import (
    Bool,
    Empty,
    EmptyResponse,
    Float32MultiArray,
    JointState,
    String,
    Twist,
    TwistStamped,
    Vector3,
    floats,
    header,
)

M = TypeVar("M")


def test_messages_wait_for_the_end_of_the_step_and_keep_their_order() -> None:
    bus = Bus()
    inbox = bus.inbox("/a", String)
    publish = bus.publisher("a", String)
    publish(String(data="first"))
    publish(String(data="second"))
    assert inbox.take() == []
    bus.deliver()
    assert [m.data for m in inbox.take()] == ["first", "second"]


def test_a_published_array_is_given_away() -> None:
    bus = Bus()
    bus.inbox("a", Float32MultiArray)
    message = floats([1.0, 2.0])
    bus.publisher("a", Float32MultiArray)(message)
    with pytest.raises(ValueError, match="read-only"):
        message.data[0] = 3.0


def test_publishing_without_readers_touches_nothing() -> None:
    bus = Bus()
    message = floats([1.0])
    bus.publisher("a", Float32MultiArray)(message)
    message.data[0] = 3.0
    inbox = bus.inbox("a", Float32MultiArray)
    bus.deliver()
    assert inbox.take() == []


def test_a_reader_of_any_type_hears_whatever_the_topic_carries_and_types_nothing() -> None:
    bus = Bus()
    early = bus.inbox("a", object)
    publish = bus.publisher("a", String)
    late = bus.inbox("/a", object)
    typed = bus.inbox("a", String)
    publish(String(data="x"))
    bus.deliver()
    assert early.take() == late.take() == typed.take() == [String(data="x")]
    with pytest.raises(BadSetting, match="carries std_msgs/msg/String"):
        bus.inbox("a", Bool)


def test_a_publisher_says_what_it_publishes() -> None:
    with pytest.raises(BadSetting, match="'a' is published without a message type"):
        Bus().publisher("a", object)


def test_a_topic_has_one_type() -> None:
    bus = Bus()
    bus.inbox("a", String)
    with pytest.raises(BadSetting, match=r"std_msgs/msg/String, not std_msgs/msg/Bool"):
        bus.publisher("a", Bool)


def test_a_message_of_another_type_is_refused() -> None:
    publish = Bus().publisher("a", String)
    with pytest.raises(BadMessage, match="std_msgs/msg/Bool"):
        publish(Bool(data=True))  # type: ignore[arg-type]


def test_two_callbacks_that_answer_each_other_for_ever_are_stopped() -> None:
    bus = Bus()
    publish = bus.publisher("a", String)
    bus.subscribe("a", String, publish)
    publish(String(data="echo"))
    with pytest.raises(UwsimError, match="in a loop"):
        bus.deliver()


def test_an_unknown_service_names_the_nearest_one() -> None:
    bus = Bus()
    bus.services.serve("startBench", Empty, lambda request: EmptyResponse())
    with pytest.raises(UnknownName, match="Did you mean 'startBench'"):
        bus.services.call("startBensh", Empty())
    assert bus.services.call("/startBench", Empty()) == EmptyResponse()


def test_a_closed_inbox_costs_the_publisher_nothing() -> None:
    bus = Bus()
    inbox = bus.inbox("a", Float32MultiArray)
    inbox.close()
    assert not bus.has_subscribers("a")
    assert inbox.last_message is None
    assert np.array_equal(floats([1.0]).data, [1.0])


def test_an_inbox_that_nobody_looks_into_keeps_the_newest(monkeypatch: pytest.MonkeyPatch) -> None:
    bus = Bus()
    inbox, publish = bus.inbox("a", String, max_messages=2), bus.publisher("a", String)

    def kept(*words: str) -> list[str]:
        for word in words:
            publish(String(data=word))
        bus.deliver()
        return [message.data for message in inbox.take()]

    assert kept("a", "b", "c") == ["b", "c"]
    monkeypatch.setattr("uwsim.base.inbox.MAX_BYTES", 200)
    assert kept("a", "b" * 150, "c" * 150) == ["c" * 150]
    assert kept("d" * 300) == ["d" * 300]
    assert kept("e", "f") == ["e", "f"]


def test_a_latched_inbox_begins_with_the_newest_message() -> None:
    bus = Bus()
    publish = bus.publisher("path", String)
    publish(String(data="before anybody asked"))
    bus.deliver()
    assert bus.inbox("path", String, latched=True).take() == []
    for word in ("first", "second"):
        publish(String(data=word))
    bus.deliver()
    inbox = bus.inbox("/path", String, latched=True)
    assert [m.data for m in inbox.take()] == ["second"]
    publish(String(data="third"))
    bus.deliver()
    assert [m.data for m in inbox.take()] == ["third"]
    assert bus.inbox("path", String).take() == []


@pytest.mark.parametrize(
    ("message", "said"),
    [
        (String(data=3), "data is 3, expected text"),
        (Bool(data="yes"), "data is 'yes', expected True or False"),
        (
            Float32MultiArray(layout=floats([]).layout, data=["a", "b"]),
            r"data is \['a', 'b'\], expected an array of numbers",
        ),
        (
            TwistStamped(header=header(0.0), twist=Twist(linear=Vector3(0, "x", 0), angular=None)),
            "twist.linear.y is 'x', expected a number",
        ),
        (TwistStamped(header=header(0.0), twist=None), "twist is None, expected a message"),
        (
            JointState(header=header(0.0), name=[1], position=[], velocity=[], effort=[]),
            r"name is \[1\], expected a list",
        ),
    ],
)
def test_a_field_that_holds_something_else_is_the_senders_error(message: M, said: str) -> None:
    bus = Bus()
    heard = bus.inbox("a", type(message))
    with pytest.raises(BadMessage, match=rf"^Topic 'a' carries .*: {said}.*\.$"):
        bus.publisher("a", type(message))(message)
    bus.deliver()
    assert heard.take() == []


def test_a_list_of_numbers_is_an_array_and_the_senders_own_no_more() -> None:
    bus = Bus()
    heard = bus.inbox("a", JointState)
    mine = [1, 2.5]
    bus.publisher("a", JointState)(
        JointState(header=header(0.0), name=["j"], position=mine, velocity=(), effort=np.zeros(0))
    )
    mine[0] = 9
    bus.deliver()
    (message,) = heard.take()
    assert message.position.tolist() == [1.0, 2.5]
    assert message.velocity.dtype == np.float64


def test_a_reader_may_refuse_what_it_can_do_nothing_with() -> None:
    def check(message: String) -> None:
        if not message.data:
            raise BadMessage("Say something.")

    bus = Bus()
    heard: list[String] = []
    stop = bus.subscribe("a", String, heard.append, check=check)
    publish = bus.publisher("a", String, delay_steps=3)
    with pytest.raises(BadMessage, match="Say something"):
        publish(String(data=""))
    stop()
    publish(String(data=""))
    assert heard == []


@pytest.mark.parametrize("data", [None, "?"])
def test_a_request_that_holds_something_else_is_the_callers_error(data: object) -> None:
    bus = Bus()
    bus.services.serve("s", Float32MultiArray, lambda request: request)
    request = floats(np.zeros(1))
    request.data = data
    with pytest.raises(BadMessage, match=r"Service 's' takes .*: data is"):
        bus.services.call("s", request)
