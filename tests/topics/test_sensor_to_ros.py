"""``<u:sensorToROS>`` publishes any sensor by its name, with the sensor's own message."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from tests.topics.test_every_interface import COMMS, MODEM, PARTS
from uwsim.checks import check_file
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene
from uwsim.sensors.sensor import find_message_type
from uwsim.topics.sensor_topic import SensorToROSSpec

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <CustomCommsChannel> <id>0</id> </CustomCommsChannel>
  <AcousticCommsChannel> <id>0</id> </AcousticCommsChannel>
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-2</z> </position>
    {parts}
  </vehicle>
  <rosInterfaces>
    {interfaces}
  </rosInterfaces>
</UWSimScene>
"""
SONAR = "<relativeTo>base_link</relativeTo> <range>10</range>"
OURS = f"""
    <objectPicker> <name>picker</name> <relativeTo>base_link</relativeTo> <range>1</range>
    </objectPicker>
    <u:imagingSonar> <name>fls</name> {SONAR} </u:imagingSonar>
    <u:scanningSonar> <name>mss</name> {SONAR} </u:scanningSonar>
    <u:sideScanSonar> <name>sss</name> {SONAR} </u:sideScanSonar>
    <u:usbl> <name>usbl</name> <relativeTo>base_link</relativeTo> <beacon>rov</beacon> </u:usbl>
    <u:battery> <name>battery</name> <capacity>100</capacity> <voltage>16</voltage> </u:battery>
    <u:motorCurrents> <name>currents</name> <voltage>16</voltage> </u:motorCurrents>
    <CustomCommsDevice> {COMMS} </CustomCommsDevice>
    <AcousticCommsDevice> {MODEM} </AcousticCommsDevice>
"""


def interface(name: str, topic: str = "", rate: float = 20, tag: str = "u:sensorToROS") -> str:
    topic = topic or f"/t/{name}"
    return f"<{tag}> <name>{name}</name> <topic>{topic}</topic> <rate>{rate}</rate> </{tag}>"


def scene_file(folder: Path, parts: str, *interfaces: str) -> Path:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(parts=parts, interfaces="\n    ".join(interfaces)))
    return path


def errors(path: Path) -> list[str]:
    found = [each for each in check_file(path) if each.severity == "error"]
    return [str(each).removeprefix(f"{path}:") for each in found]


def test_every_sensor_and_device_that_measures_is_published_as_its_own_message(
    tmp_path: Path,
) -> None:
    path = scene_file(tmp_path, PARTS + OURS)
    [vehicle] = read_scene(path).vehicles
    sensors = {
        str(getattr(part, "name", "")): (element, find_message_type(type(part)))
        for element, part in vehicle.all_parts()
        if element in SensorToROSSpec.sources
    }
    assert {element for element, _ in sensors.values()} == set(SensorToROSSpec.sources)
    path = scene_file(tmp_path, PARTS + OURS, *(interface(name, rate=100) for name in sensors))
    assert errors(path) == []
    with open_scene(read_scene(path), is_blind=True) as simulation:
        for name in sensors:
            simulation.latest_message(f"/t/{name}")
        simulation.advance(0.02)
        for name, (element, type_) in sensors.items():
            assert type(simulation.latest_message(f"/t/{name}")) is type_, element


def test_it_publishes_what_the_older_element_publishes(tmp_path: Path) -> None:
    noisy = "<pressureSensor> <name>depth</name> <relativeTo>base_link</relativeTo> "
    noisy += "<std>0.1</std> </pressureSensor>"
    found = []
    for tag in ("u:sensorToROS", "PressureSensorToROS"):
        path = scene_file(tmp_path, noisy, interface("depth", tag=tag))
        with open_scene(read_scene(path), is_blind=True) as simulation:
            simulation.latest_message("/t/depth")
            simulation.advance(0.1)
            found.append(simulation.latest_message("/t/depth"))
    assert found[0] == found[1]
    assert found[0].pressure != 2.0


def test_a_depth_camera_measures_only_for_readers(tmp_path: Path) -> None:
    path = scene_file(tmp_path, PARTS, interface("depth"))
    with open_scene(read_scene(path), is_blind=True) as simulation:
        [topic] = simulation.world.interfaces
        taken = []
        sensor = topic._sensor
        sample = sensor.sample
        sensor.sample = lambda time: taken.append(time) or sample(time)
        simulation.bus.keeps_unread_messages = False
        simulation.advance(0.1)
        assert taken == []
        simulation.bus.subscribe("/t/depth", type(sample(0.0)), lambda message: None)
        simulation.advance(0.1)
        assert np.allclose(taken, [0.15, 0.2])


@pytest.mark.parametrize(
    ("name", "error"),
    [
        (
            "presure",
            "no sensor is called 'presure'; expected the name of a sensor, or of a device that "
            "measures. Did you mean 'pressure'? Sensors: depth, dvl, echo, force, gps, imu, "
            "multibeam, pressure, profiler, sonar",
        ),
        (
            "camera",
            "'camera' is a <virtualCamera>, which <VirtualCameraToROSImage> publishes; expected "
            "the name of a sensor, or of a device that measures. Sensors: depth, dvl, echo, force, "
            "gps, imu, multibeam, pressure, profiler, sonar",
        ),
    ],
)
def test_a_name_that_is_none_of_a_sensor_is_an_error_with_its_line(
    name: str, error: str, tmp_path: Path
) -> None:
    path = scene_file(tmp_path, PARTS, interface("imu"), interface(name))
    line = path.read_text().splitlines().index(f"    {interface(name)}") + 1
    assert errors(path) == [f"{line}: <u:sensorToROS>: {error}"]
    with pytest.raises(SceneError, match="<u:sensorToROS>: "), open_scene(read_scene(path)):
        pass


def test_a_name_of_two_kinds_of_sensors_is_an_error(tmp_path: Path) -> None:
    twice = "<relativeTo>base_link</relativeTo>"
    parts = f"<imu> <name>a</name> {twice} </imu> <gpsSensor> <name>a</name> {twice} </gpsSensor>"
    [error] = errors(scene_file(tmp_path, parts, interface("a")))
    assert error.endswith(
        "<u:sensorToROS>: 'a' is the name of a <gpsSensor> and of a <imu>; expected the "
        "name of one sensor"
    )


def test_two_types_on_one_topic_are_an_error(tmp_path: Path) -> None:
    topics = interface("imu", "/a"), interface("dvl", "/a"), interface("imu", "/b")
    [error] = errors(scene_file(tmp_path, PARTS, *topics))
    assert "the topic '/a' carries underwater_sensor_msgs/msg/DVL, but " in (error)


def test_a_fault_of_a_sensor_finds_its_fields(tmp_path: Path) -> None:
    fault = "<u:sensor>imu</u:sensor> <u:kind>bias</u:kind> <u:size>1</u:size>"
    parts = f"{PARTS} <u:fault> {fault} <u:field>{{}}</u:field> </u:fault>"
    assert errors(scene_file(tmp_path, parts.format("angular_velocity.z"), interface("imu"))) == []
    [error] = errors(scene_file(tmp_path, parts.format("pressure"), interface("imu")))
    assert "No field of numbers is called 'pressure'" in error
