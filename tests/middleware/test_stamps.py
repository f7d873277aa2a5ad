"""Stamps on the clock of ROS, which begins at 1 s."""

from __future__ import annotations

from uwsim import messages
from uwsim.messages import TFMessage, Time, TransformStamped, header
from uwsim.middleware.stamps import clock_time, to_ros_time, to_sim_time


def test_the_clock_begins_at_one_second() -> None:
    assert clock_time(0.0) == Time(sec=1, nanosec=0)
    assert clock_time(2.25) == Time(sec=3, nanosec=250_000_000)


def test_stamps_go_out_later_and_come_back_as_they_were() -> None:
    message = messages.Odometry(header=header(2.25, "world"))
    sent_messages = to_ros_time(message)
    assert sent_messages.header.stamp == Time(sec=3, nanosec=250_000_000)
    assert message.header.stamp.sec == 2
    assert to_sim_time(sent_messages).header == message.header


def test_every_stamp_of_a_list_is_moved() -> None:
    message = TFMessage(transforms=[TransformStamped(header=header(float(i))) for i in range(3)])
    assert [entry.header.stamp.sec for entry in to_ros_time(message).transforms] == [1, 2, 3]


def test_a_stamp_that_was_not_set_stays_so_on_its_way_in() -> None:
    assert to_sim_time(messages.TwistStamped()).header.stamp == Time()
    early_stamp = messages.TwistStamped(header=messages.Header(stamp=Time(sec=0, nanosec=5)))
    assert to_sim_time(early_stamp).header.stamp == Time()


def test_a_message_without_a_header_is_the_same_object() -> None:
    message = messages.Twist()
    assert to_ros_time(message) is message
