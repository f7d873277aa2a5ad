"""Sensors of one name on two vehicles: interfaces find the last, as in the original."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.cli import main
from uwsim.messages import Pressure
from uwsim.scene.reader import read_scene
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob

VEHICLE = """
  <vehicle> <name>{name}</name> <file>data/scenes/g500ARM5.urdf</file>
    <position> <x>{x}</x> <y>0</y> <z>-{depth}</z> </position>
    <virtualCamera> <name>eye</name> <relativeTo>{link}</relativeTo> </virtualCamera>
    <pressureSensor> <name>pressure</name> <relativeTo>base_link</relativeTo> </pressureSensor>
  </vehicle>"""
INTERFACES = """
  <rosInterfaces>
    <PressureSensorToROS> <name>pressure</name> <topic>/depth</topic> </PressureSensorToROS>
    <VirtualCameraToROSImage> <cameraName>eye</cameraName>
      <imageTopic>/eye</imageTopic> <infoTopic>/eye_info</infoTopic> </VirtualCameraToROSImage>
  </rosInterfaces>"""


def scene(folder: Path, *, link_of_last: str = "part0") -> Path:
    """Two vehicles at 1 m and 5 m depth; x of the second is 3 m."""
    file = folder / "scene.xml"
    first = VEHICLE.format(name="one", x=0, depth=1, link="part0")
    last = VEHICLE.format(name="two", x=3, depth=5, link=link_of_last)
    file.write_text(f"<UWSimScene>{first}{last}{INTERFACES}</UWSimScene>")
    return file


def test_a_topic_carries_the_sensor_of_the_last_vehicle(tmp_path: Path) -> None:
    depths: list[float] = []
    with open_scene(read_scene(scene(tmp_path)), is_blind=True) as simulation:
        simulation.bus.subscribe(
            "/depth", Pressure, lambda message: depths.append(message.pressure)
        )
        simulation.advance(0.1)
        assert depths == pytest.approx([5.0, 5.0])
        assert simulation.world.sensors.camera("eye").world_from_camera.position[0] > 2.0
        (camera,) = scene_head(simulation, "", Blob())["cameras"]
        assert camera["body"].startswith("two/")


def test_a_camera_that_is_left_out_hides_no_other(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = scene(tmp_path, link_of_last="nowhere")
    assert main(["info", str(file), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [each["topics"] for each in found["cameras"]] == [["/eye"], []]
    assert not any("2 cameras" in warning for warning in found["warnings"])
    with open_scene(read_scene(file), is_blind=True) as simulation:
        assert simulation.world.sensors.camera("eye").world_from_camera.position[0] < 2.0
        (camera,) = scene_head(simulation, "", Blob())["cameras"]
        assert camera["body"].startswith("one/")


def test_two_vehicles_of_one_name_are_warned_of_at_the_second(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = scene(tmp_path)
    file.write_text(file.read_text().replace("<name>two<", "<name>one<"))
    assert main(["check", str(file)]) == 0
    assert f"{file}:7: warning: several vehicles are called 'one'" in capsys.readouterr().out


def test_the_first_of_two_cameras_is_on_no_topic(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = scene(tmp_path)
    assert main(["info", str(file), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [each["topics"] for each in found["cameras"]] == [[], ["/eye"]]
    assert main(["check", str(file)]) == 0
    said = capsys.readouterr().out
    assert f"{file}:9: warning: 2 cameras are called 'eye'; interfaces and benchmarks use" in said
    assert "<pressureSensor>: several are called 'pressure'; interfaces find the last" in said
