"""Degrees where radians belong are asked about, with what they would be."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.check_text import check_text
from uwsim.checks import check_file, scene_warnings
from uwsim.scene.reader import read_scene
from uwsim.scene.settings import apply_setting

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <simParams> <offsetr> <x>180</x> <y>0</y> <z>-90</z> </offsetr> </simParams>
  <vehicle> <name>rov</name> <file>rov.urdf</file>
    <orientation> <r>0</r> <p>0</p> <y>90</y> </orientation>
    <virtualCamera> <name>eye</name> <relativeTo>base_link</relativeTo>
      <orientation> <r>0</r> <p>180</p> <y>M_PI_2</y> </orientation> </virtualCamera>
    <u:sway> <u:axis>yaw</u:axis> <u:amplitude>0.1</u:amplitude> <u:period>5</u:period>
      <u:phase>20</u:phase> </u:sway>
  </vehicle>
</UWSimScene>"""
ROBOT = """<robot name="rov"> <link name="base_link"/> <link name="arm"/>
<joint name="a" type="revolute"> <origin rpy="0 0 90"/>
<parent link="base_link"/> <child link="arm"/>
<limit lower="{}" upper="{}"/> </joint> </robot>"""


def test_angles_beyond_a_turn_are_reported_as_degrees_and_within_a_turn(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(SCENE)
    said = {diagnostic.line: diagnostic.message for diagnostic in check_text(path)}
    assert said == {
        2: "<offsetr> is 180 0 -90 in radians, more than a turn; if these are degrees write 3.1416 "
        "0 -1.5708, else write -2.2124 0 -2.0354, which is equal",
        4: "<orientation> is 0 0 90 in radians, more than a turn; if these are degrees write 0 "
        "0 1.5708, else write 0 0 2.0354, which is equal",
        6: "<orientation> is 0 180 1.5708 in radians, more than a turn; if these are degrees write "
        "0 3.1416 0.027416, else write 0 -2.2124 1.5708, which is equal",
    }


@pytest.mark.parametrize(
    ("lower", "upper", "is_asked"),
    [(-90, 90, True), (0, 360, True), (-6.28, 6.28, False), (-1000, 1000, False), (-7.5, 7, False)],
)
def test_limits_of_a_robot_that_look_like_degrees_are_asked_about(
    lower: float, upper: float, is_asked: bool, tmp_path: Path
) -> None:
    path = tmp_path / "rov.urdf"
    path.write_text(ROBOT.format(lower, upper))
    said = [diagnostic.message for diagnostic in check_file(path)]
    assert said[0].startswith("rpy of <origin> is 0 0 90 in radians, more than a turn")
    assert [message.split(";")[0] for message in said[1:]] == (
        [f"joint 'a' turns from {lower} to {upper} rad"] if is_asked else []
    )


def test_angles_of_a_scene_that_was_set_are_asked_about_at_the_lines_of_its_file(
    tmp_path: Path,
) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(SCENE)
    (tmp_path / "rov.urdf").write_text('<robot name="rov"> <link name="base_link"/> </robot>')
    scene = apply_setting(read_scene(path), "vehicle[rov].orientation", "0 0 1.57")
    assert [
        (diagnostic.line, diagnostic.message[:30]) for diagnostic in scene_warnings(scene, ())
    ] == [
        (2, "<offsetr> is 180 0 -90 in radi"),
        (6, "<orientation> is 0 180 1.5708 "),
    ]
