"""Elements of forks and of the first versions of UWSim are read with a warning."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.checks import check_file
from uwsim.devices.echo import EchoSpec, SimulatedDevicesSpec
from uwsim.errors import Diagnostic
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.topics.sensor_topic import EchoROSSpec
from uwsim.topics.simulated_device_ros import unwrap_interfaces

VEHICLE = "<vehicle><name>g</name><file>data/scenes/g500ARM5.urdf</file>{}</vehicle>"


def scene_of(folder: Path, body: str) -> tuple[SceneSpec, list[Diagnostic]]:
    file = folder / "scene.xml"
    file.write_text(f"<UWSimScene>\n{body}\n</UWSimScene>")
    return read_scene(file), check_file(file)


@pytest.mark.parametrize(
    "body",
    [
        "<camera><freeMotion>0</freeMotion><oculus>1</oculus><fov>50</fov></camera>",
        "<camera><windshield>1</windshield></camera>",
        "<oceanState><reflection>1</reflection></oceanState>",
        "<simParams><groundTruth><type>0</type><gt_shader>1</gt_shader></groundTruth></simParams>",
        "<rosInterfaces><OceanSurfaceToROSOceanVehicle><topic>/w</topic><vehicleName>g</vehicleName>"
        "<linkName>base_link</linkName></OceanSurfaceToROSOceanVehicle></rosInterfaces>",
        "<rosInterfaces><ObjectPickedToROS><name>p</name><topic>/p</topic></ObjectPickedToROS>"
        "</rosInterfaces>",
        VEHICLE.format("<vehiclePhysics><name>p</name></vehiclePhysics><vehicleMass/>"),
    ],
)
def test_elements_of_known_forks_are_left_out_with_a_warning(body: str, tmp_path: Path) -> None:
    _, found = scene_of(tmp_path, body)
    assert {each.severity for each in found} == {"warning"}
    assert any("fork" in each.message for each in found)


@pytest.mark.parametrize(
    ("device", "topic"),
    [
        (
            "<name>e1</name><echo><info>hello</info></echo>",
            "<name>e1</name><topic>/t</topic><rate>2</rate><echoROS/>",
        ),
        ("<echo><info>hello</info></echo><name>e1</name>", "<name>e1</name><echoROS>{t}</echoROS>"),
        (
            "<name>box</name><echo><name>e1</name><info>hello</info></echo>",
            "<echoROS>{n}{t}</echoROS>",
        ),
        (
            "<name>e1</name><type>echo</type><info>hello</info>",
            "<name>e1</name><type>echoROS</type><topic>/t</topic><rate>2</rate>",
        ),
    ],
)
@pytest.mark.parametrize("wrapper", ["simulatedDevice", "simulatedDevices"])
def test_a_named_wrapper_of_june_2013_names_the_device_in_it(
    wrapper: str, device: str, topic: str, tmp_path: Path
) -> None:
    inside = topic.format(n="<name>e1</name>", t="<topic>/t</topic><rate>2</rate>")
    scene, found = scene_of(
        tmp_path,
        VEHICLE.format(f"<{wrapper}>{device}</{wrapper}>")
        + f"<rosInterfaces><SimulatedDeviceROS>{inside}</SimulatedDeviceROS></rosInterfaces>",
    )
    assert {each.severity for each in found} == {"warning"}
    (vehicle,) = scene.vehicles
    wrapped = [echo for box in vehicle.parts_of(SimulatedDevicesSpec) for echo in box.echo]
    (echo,) = [*vehicle.parts_of(EchoSpec), *wrapped]
    (interface,) = unwrap_interfaces(scene.ros_interfaces)
    assert isinstance(interface, EchoROSSpec)
    assert (echo.name, echo.info) == ("e1", "hello")
    assert (interface.name, interface.topic, interface.rate) == ("e1", "/t", 2.0)


def test_a_wrapper_with_a_name_and_no_device_is_an_error(tmp_path: Path) -> None:
    file = tmp_path / "scene.xml"
    wrapper = "<simulatedDevice><name>e</name></simulatedDevice>"
    file.write_text(f"<UWSimScene>\n{VEHICLE.format(wrapper)}</UWSimScene>")
    (error,) = [each for each in check_file(file) if each.severity == "error"]
    assert (error.line, error.message) == (
        2,
        "<name> in <simulatedDevice>, which has no device",
    )
