"""Names and topics that parts of a scene share are reported by check, and before a run."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.checks import check_file, model_warnings
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-2</z> </position>
    <imu> <name>imu</name> <relativeTo>base_link</relativeTo> </imu>
    {parts}
  </vehicle>
  <rosInterfaces>
    <ImuToROSImu> <name>imu</name> <topic>/imu</topic> <rate>{rate}</rate> </ImuToROSImu>
    {interfaces}
  </rosInterfaces>
</UWSimScene>
"""


def said(folder: Path, *, parts: str = "", interfaces: str = "", rate: object = 10) -> list[str]:
    """What check says, which is what a run says if the scene runs at all."""
    scene = folder / "scene.xml"
    scene.write_text(SCENE.format(parts=parts, interfaces=interfaces, rate=rate))
    found = check_file(scene)
    if not any(each.severity == "error" for each in found):
        with open_scene(read_scene(scene), is_blind=True) as simulation:
            assert model_warnings(simulation.world.model) == found
    else:
        with pytest.raises(SceneError):
            open_scene(read_scene(scene), is_blind=True)
    return [f"{each.severity} {each.line}: {each.message}" for each in found]


def test_what_is_right_is_silent(tmp_path: Path) -> None:
    assert said(tmp_path) == []


def test_a_sensor_on_a_link_that_is_not_there(tmp_path: Path) -> None:
    lost = "<imu> <name>b</name> <relativeTo>base_lonk</relativeTo> </imu>"
    (message,) = said(tmp_path, parts=lost)
    assert message == (
        "warning 5: <imu>: 'base_lonk' is no link of bluerov2_heavy.urdf. Did you mean base_link? "
        "It is ignored, as in the original"
    )


def test_two_sensors_of_one_name(tmp_path: Path) -> None:
    (message,) = said(
        tmp_path, parts="<imu> <name>imu</name> <relativeTo>base_link</relativeTo> </imu>"
    )
    assert message == "warning 5: <imu>: several are called 'imu'; interfaces find the last"
    other = "<pressureSensor> <name>imu</name> <relativeTo>base_link</relativeTo> </pressureSensor>"
    (message,) = said(tmp_path, parts=other)
    assert message.startswith("warning 5: <pressureSensor>: 'imu' is the name of a <imu>")


def test_one_interface_twice_on_a_topic(tmp_path: Path) -> None:
    again = "<ImuToROSImu> <name>imu</name> <topic>imu</topic> </ImuToROSImu>"
    (message,) = said(tmp_path, interfaces=again)
    assert message.startswith("warning 9: <ImuToROSImu>: the topic 'imu' of 'imu' carries 'imu'")


@pytest.mark.parametrize("topic", ["/", "/a b", "/1st", "/a//b", "/a-b", "/é"])
def test_a_topic_that_ros_cannot_name(topic: str, tmp_path: Path) -> None:
    again = f"<PATToROSOdom> <topic>{topic}</topic> <vehicleName>rov</vehicleName> </PATToROSOdom>"
    (message,) = said(tmp_path, interfaces=again)
    assert (
        message == f"warning 9: <PATToROSOdom>: the topic {topic!r} is no valid topic name in ROS"
    )


def test_a_topic_that_is_heard_has_a_name_too(tmp_path: Path) -> None:
    heard = "<ROSTwistToPAT> <topic>/a b</topic> <vehicleName>rov</vehicleName> </ROSTwistToPAT>"
    (message,) = said(tmp_path, interfaces=heard)
    assert message.endswith("<ROSTwistToPAT>: the topic '/a b' is no valid topic name in ROS")


def test_a_rate_that_nothing_has(tmp_path: Path) -> None:
    (message,) = said(tmp_path, rate=10**9)
    assert message == (
        "error 8: <rate> is '1000000000'; expected a number >= 0.001 and <= 10000 [Hz]"
    )


@pytest.mark.parametrize(
    ("fault", "expected"),
    [
        ("<u:kind>latency</u:kind>", "latency without <u:delay>"),
        ("<u:kind>bias</u:kind>", "bias without <u:size>"),
        (
            "<u:kind>bias</u:kind> <u:size>1</u:size> <u:field>angular_velcity.x</u:field>",
            "Did you mean 'angular_velocity.x'?",
        ),
    ],
)
def test_a_fault_that_would_do_nothing(tmp_path: Path, fault: str, expected: str) -> None:
    (message,) = said(tmp_path, parts=f"<u:fault> <u:sensor>imu</u:sensor> {fault} </u:fault>")
    assert message.startswith("error 5: ")
    assert expected in message


def test_a_field_of_a_message_of_an_interface_is_one(tmp_path: Path) -> None:
    fault = "<u:kind>bias</u:kind> <u:size>1</u:size> <u:field>angular_velocity.x</u:field>"
    assert said(tmp_path, parts=f"<u:fault> <u:sensor>imu</u:sensor> {fault} </u:fault>") == []
