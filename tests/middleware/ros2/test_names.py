"""Names of ROS 2 on DDS."""

from __future__ import annotations

from uwsim.middleware.ros2.names import (
    is_legal,
    reply_name,
    request_name,
    topic_name,
    type_hash_data,
    type_name,
)


def test_topics_services_and_types_have_the_names_that_ros_2_gives_them() -> None:
    assert topic_name("/a/b") == topic_name("a/b") == "rt/a/b"
    assert request_name("a/b") == "rq/a/bRequest"
    assert reply_name("/a/b") == "rr/a/bReply"
    assert type_name("sensor_msgs/msg/Image") == "sensor_msgs::msg::dds_::Image_"
    assert type_hash_data("RIHS01_0") == b"typehash=RIHS01_0;"


def test_a_name_has_letters_digits_and_underscores_between_slashes() -> None:
    assert all(map(is_legal, ("a", "uwsim/camera1", "_a/b_2", "x" * 240)))
    illegal_names = ("", "a b", "a//b", "/a", "a/", "a/1", "1", "µ", "~a", "{a}", "a\n", "x" * 241)
    assert not any(map(is_legal, illegal_names))
