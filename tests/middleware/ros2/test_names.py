"""Names of ROS 2 on DDS."""

from __future__ import annotations

from uwsim.middleware.ros2.names import (
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
