import numpy as np
import pytest

from uwsim.bus import Bus
from uwsim.errors import BadSetting, UnknownName, UwsimError
from uwsim.messages import Bool, Empty, EmptyResponse, Float32MultiArray, String, floats


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
    with pytest.raises(BadSetting, match="std_msgs/msg/Bool"):
        publish(Bool(data=True))  # type: ignore[arg-type]


def test_two_callbacks_that_answer_each_other_for_ever_are_stopped() -> None:
    bus = Bus()
    publish = bus.publisher("a", String)
    bus.subscribe("a", String, publish)
    publish(String(data="echo"))
    with pytest.raises(UwsimError, match="without end"):
        bus.deliver()


def test_an_unknown_service_names_the_nearest_one() -> None:
    bus = Bus()
    bus.serve("startBench", Empty, lambda request: EmptyResponse())
    with pytest.raises(UnknownName, match="Did you mean 'startBench'"):
        bus.call("startBensh", Empty())
    assert bus.call("/startBench", Empty()) == EmptyResponse()


def test_a_closed_inbox_costs_the_publisher_nothing() -> None:
    bus = Bus()
    inbox = bus.inbox("a", Float32MultiArray)
    inbox.close()
    assert not bus.has_readers("a")
    assert inbox.last is None
    assert np.array_equal(floats([1.0]).data, [1.0])


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
