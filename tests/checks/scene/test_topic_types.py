"""A topic of a device with another type of message is an error before a run."""

from __future__ import annotations

from pathlib import Path

import pytest

import uwsim
from tests.devices.streams.stream_scenes import SCENE


def errors_of(folder: Path, streams: str) -> list[str]:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(streams=streams, depth=1.5, x=2.0))
    return [str(d) for d in uwsim.check(path) if d.severity == "error"]


@pytest.mark.parametrize(
    ("device", "problem"),
    [
        (
            "<u:ardupilot> <battery>/imu</battery> </u:ardupilot>",
            "<u:ardupilot>: <battery>: the topic '/imu' of <ImuToROSImu> carries "
            "sensor_msgs/msg/Imu; expected sensor_msgs/msg/BatteryState",
        ),
        (
            "<u:ardupilot> <rangefinder>depth</rangefinder> </u:ardupilot>",
            "expected sensor_msgs/msg/Range, as on '/altitude'",
        ),
        (
            "<u:mavlink> <dvl>/imu</dvl> </u:mavlink>",
            "expected underwater_sensor_msgs/msg/DVL, as on '/dvl'",
        ),
        (
            "<u:mavlink> <odometry>/mavlink/arm</odometry> </u:mavlink>",
            "the topic '/mavlink/arm' of <u:mavlink> carries std_msgs/msg/Bool",
        ),
        (
            "<u:instrumentStream> <name>a</name> <format>PD4</format> <topic>/imu</topic>"
            "</u:instrumentStream>",
            "<topic>: the topic '/imu' of <ImuToROSImu> carries",
        ),
    ],
)
def test_a_topic_of_another_type_is_an_error(tmp_path: Path, device: str, problem: str) -> None:
    (message,) = errors_of(tmp_path, device)
    assert "scene.xml:17: " in message
    assert problem in message


def test_topics_of_the_right_type_are_no_error(tmp_path: Path) -> None:
    device = "<u:mavlink> <dvl>/dvl</dvl> <range>altitude</range> </u:mavlink>"
    assert errors_of(tmp_path, device) == []
