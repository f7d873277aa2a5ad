"""Scene files: every element of UWSim's dialect, old names, frames, and errors all at once."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from tests.support.check_text import check_text
from uwsim.base.geometry import Pose
from uwsim.checks import check_file
from uwsim.currents import UwsimSinusoidSpec
from uwsim.devices.comms.custom_comms_device import CustomCommsDeviceSpec
from uwsim.devices.echo import EchoSpec, SimulatedDevicesSpec
from uwsim.devices.structured_light_projector import StructuredLightProjectorSpec
from uwsim.errors import SceneError
from uwsim.scene import SceneSpec, read_scene
from uwsim.scene.object import ObjectSpec
from uwsim.scene.sim_params import ShowTrajectorySpec
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.urdf.reader import read_urdf
from uwsim.scene.writer import write_scene
from uwsim.schema import NAMESPACE, Diagnostics, Field, fields_of
from uwsim.sensors.sonar.multibeam_sensor import MultibeamSensorSpec
from uwsim.sensors.sonar.profiling_sonar import ProfilingSonarSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec
from uwsim.topics import INTERFACES
from uwsim.topics.comms_device_ros import CustomCommsDeviceROSSpec
from uwsim.topics.ros_odom_to_pat import ROSOdomToPATSpec
from uwsim.topics.sensor_topic import EchoROSSpec, ProfilingSonarROSSpec
from uwsim.topics.simulated_device_ros import SimulatedDeviceROSSpec

EVERY = Path(__file__).parent / "every-element.xml"
DATA = Path(__file__).parents[2] / "src" / "uwsim" / "data" / "scenes"
BUNDLED = sorted(DATA.glob("*.xml"))
ORIGINALS = os.environ.get("UWSIM_ORIGINALS")

needs_originals = pytest.mark.skipif(ORIGINALS is None, reason="UWSIM_ORIGINALS is not set")


def originals(pattern: str) -> list[Path]:
    return sorted(Path(ORIGINALS).rglob(pattern)) if ORIGINALS else []


def written(text: str, folder: Path) -> Path:
    file = folder / "scene.xml"
    file.write_text(text)
    return file


def scene_of(inside: str, folder: Path) -> tuple[SceneSpec, list[str]]:
    """Read a scene with this inside; also every error and warning of its reading."""
    file = written(f"<UWSimScene>{inside}</UWSimScene>", folder)
    said = [
        diagnostic.message
        for diagnostic in check_text(file)
        if not diagnostic.message.startswith("read, not simulated ")
    ]
    return read_scene(file), said


def diagnostics(inside: str, folder: Path) -> list[str]:
    file = written(f"<UWSimScene>{inside}</UWSimScene>", folder)
    return [diagnostic.message for diagnostic in check_text(file) if diagnostic.severity == "error"]


VEHICLE = "<vehicle><name>g</name><file>data/scenes/g500ARM5.urdf</file>{}</vehicle>"


def all_fields(cls: type) -> Iterator[Field]:
    """Every field of a spec and of the specs in it."""
    for field in fields_of(cls):
        yield field
        if field.kind == "spec":
            yield from all_fields(field.type)
        elif field.kind == "choice":
            for spec in field.type.values():
                yield from all_fields(spec)


def test_the_scene_with_every_element_holds_every_element() -> None:
    root = etree.parse(EVERY).getroot()
    names = {str(node.tag) for node in root.iter("*")}
    names |= {str(name) for node in root.iter("*") for name in node.attrib}
    assert {field.tag for field in all_fields(SceneSpec)} - names == set()
    assert set(INTERFACES) - names == set()


def test_no_value_of_the_scene_with_every_element_is_a_default() -> None:
    """In at least one place each: a fault has a thruster or a sensor, for example."""
    given: dict[str, bool] = {}

    def check(spec: object, route: str) -> None:
        for field in fields_of(type(spec)):
            value = getattr(spec, field.name)
            place = f"{route}.{type(spec).__name__}.{field.name}"
            given[place] = given.get(place, False) or value != field.default
            for part in value if field.is_repeated else (value,):
                if dataclasses.is_dataclass(part):
                    check(part, place)

    check(read_scene(EVERY), "scene")
    assert [place for place, is_given in given.items() if not is_given] == []


@pytest.mark.parametrize("path", [EVERY, *BUNDLED], ids=lambda path: path.stem)
def test_reading_what_was_written_gives_the_same_scene(path: Path, tmp_path: Path) -> None:
    scene = read_scene(path)
    again = read_scene(written(write_scene(scene), tmp_path))
    assert again == scene


def without_extensions(scene: SceneSpec) -> str:
    """The text of a scene without what has the namespace ``u``, as the original reads it."""
    root = etree.fromstring(write_scene(scene).encode())
    mark = f"{{{NAMESPACE}}}"
    for node in list(root.iter("*")):
        for name in [name for name in node.attrib if str(name).startswith(mark)]:
            del node.attrib[name]
        parent = node.getparent()
        if str(node.tag).startswith(mark) and parent is not None:
            parent.remove(node)
    etree.cleanup_namespaces(root)
    doctype = f'<!DOCTYPE {root.tag} SYSTEM "{root.tag}.dtd">'
    return etree.tostring(root, encoding="unicode", doctype=doctype)


@pytest.mark.parametrize("path", [EVERY, *BUNDLED], ids=lambda path: path.stem)
def test_dropping_the_extensions_gives_a_scene_in_the_originals_order(
    path: Path, tmp_path: Path
) -> None:
    text = without_extensions(read_scene(path))
    assert "urn:uwsim" not in text
    said = check_file(written(text, tmp_path), is_strict=True)
    wrong = {diagnostic.message for diagnostic in said if diagnostic.severity == "error"}
    assert wrong <= {
        "<ProfilingSonar> is not in the original grammar",
        "<ProfilingSonarROS> is not in the original grammar",
    }


@needs_originals
@pytest.mark.parametrize("path", [EVERY, *BUNDLED], ids=lambda path: path.stem)
def test_dropping_the_extensions_gives_a_valid_original(path: Path) -> None:
    assert ORIGINALS is not None
    root = etree.fromstring(without_extensions(read_scene(path)).encode())
    for parent, name in (
        ("vehicle", "ProfilingSonar"),
        ("rosInterfaces", "ProfilingSonarROS"),
        ("objectPicker", "visible"),  # read by the original, refused by its grammar
    ):
        for node in root.findall(f".//{parent}/{name}"):
            node.getparent().remove(node)  # type: ignore[union-attr]
    dtd = etree.DTD(str(next(Path(ORIGINALS).rglob("UWSimScene.dtd"))))
    assert dtd.validate(root), dtd.error_log.filter_from_errors()


@needs_originals
@pytest.mark.parametrize(
    "path", [*originals("*.xml"), *originals("*.urdf")], ids=lambda path: path.name
)
def test_every_original_file_is_without_errors(path: Path) -> None:
    assert [diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"] == []


@needs_originals
@pytest.mark.parametrize("path", originals("*[sS]cene.xml"), ids=lambda path: path.name)
def test_every_original_scene_is_in_the_originals_order(path: Path) -> None:
    assert [f for f in check_file(path, is_strict=True) if f.severity == "error"] == []


@pytest.mark.parametrize("path", BUNDLED, ids=lambda path: path.stem)
def test_every_bundled_scene_is_without_errors_and_in_order(path: Path) -> None:
    assert [f for f in check_file(path, is_strict=True) if f.severity == "error"] == []


def camera_in_l(scene: SceneSpec) -> tuple[np.ndarray, np.ndarray]:
    """Centre of the first camera in L [m], and the pixel of the second object's origin."""
    vehicle = scene.vehicles[0]
    camera = vehicle.parts_of(VirtualCameraSpec)[0]
    robot = read_urdf(DATA / "g500ARM5.urdf")
    base_from_link = link_poses(robot, vehicle.joint_values)[camera.relative_to]
    l_from_camera = (
        vehicle.localized_from_base
        @ base_from_link
        @ Pose.from_rpy(camera.position, camera.orientation)
    )
    box = scene.objects[1].localized_from_object.position
    pixel = camera.intrinsics().project(l_from_camera.inverse().transform(box[None]))[0]
    return l_from_camera.position, pixel


def test_the_camera_of_the_papers_scene_is_where_it_was(tmp_path: Path) -> None:
    scene, _ = scene_of(
        VEHICLE.format(
            "<position><x>2</x><y>0</y><z>2.5</z></position>"
            "<virtualCamera><name>c</name><relativeTo>part0</relativeTo>"
            "<resw>320</resw><resh>240</resh>"
            "<position><x>-0.2</x><y>-0.1</y><z>0</z></position>"
            "<orientation><r>0</r><p>3.14</p><y>1.57</y></orientation></virtualCamera>"
        )
        + "<object><name>terrain</name><file>f</file></object>"
        "<object><name>b</name><file>f</file>"
        "<position><x>2.0</x><y>0.35</y><z>4.72</z></position></object>",
        tmp_path,
    )
    centre, pixel = camera_in_l(scene)
    np.testing.assert_allclose(centre, [2.2, 0.1, 3.45], atol=1e-9)
    from_the_corner = np.array([210.20, 160.55])  # as the original counts
    np.testing.assert_allclose(pixel, [209.70, 160.05], atol=0.005)
    np.testing.assert_allclose(pixel + 0.5, from_the_corner, atol=0.005)


def test_the_camera_of_visibility_is_1_36_m_from_the_box() -> None:
    scene = read_scene(DATA / "visibility-scene.xml")
    centre, _ = camera_in_l(scene)
    box = scene.objects[1].localized_from_object.position
    np.testing.assert_allclose(centre, [2.2, -0.1, 3.465], atol=1e-9)
    assert np.linalg.norm(box - centre) == pytest.approx(1.36, abs=0.005)
    assert box[2] - 0.075 - centre[2] == pytest.approx(1.195, abs=0.001)


def test_the_usual_offset_is_north_east_down_to_east_north_up() -> None:
    w_from_l = read_scene(DATA / "visibility-scene.xml").world_from_localized
    np.testing.assert_allclose(
        w_from_l.transform(np.array([[1.0, 2.0, 3.0]])), [[2, 1, -3]], atol=1e-12
    )


def test_the_meshs_offset_puts_the_tank_where_the_original_has_it() -> None:
    tank = ObjectSpec(
        name="terrain", file="", offsetp=(-1.5, -3, 0), offsetr=(np.pi, 0, -np.pi / 2)
    )
    np.testing.assert_allclose(
        tank.object_from_mesh.transform(np.array([[1.0, 2.0, 3.0]])), [[5, 2.5, -3]], atol=1e-12
    )


def test_vehicles_and_objects_turn_in_opposite_orders(tmp_path: Path) -> None:
    turn = "<orientation><r>M_PI</r><p>0</p><y>1.57</y></orientation>"
    scene, _ = scene_of(
        VEHICLE.format(turn) + f"<object><name>o</name><file>f</file>{turn}</object>", tmp_path
    )
    heading_of_vehicle = scene.vehicles[0].localized_from_base.rotation[:, 0]
    heading_of_object = scene.objects[0].localized_from_object.rotation[:, 0]
    np.testing.assert_allclose(heading_of_vehicle, [0, -1, 0], atol=1e-3)
    np.testing.assert_allclose(heading_of_object, [0, 1, 0], atol=1e-3)


def test_an_empty_scene_has_the_originals_usual_water(tmp_path: Path) -> None:
    scene, said = scene_of("", tmp_path)
    assert said == []
    assert scene.ocean_state.fog.density == 0.1
    assert scene.ocean_state.attenuation == (0.015, 0.0075, 0.005)
    assert scene == SceneSpec()


def test_a_file_without_errors_may_have_a_doctype_or_none(tmp_path: Path) -> None:
    doctype = '<!DOCTYPE UWSimScene SYSTEM "UWSimScene.dtd">'
    assert read_scene(written(doctype + "<UWSimScene/>", tmp_path)) == SceneSpec()


def test_visualize_becomes_a_trajectory_of_its_vehicle(tmp_path: Path) -> None:
    scene, said = scene_of(
        VEHICLE.format("") + "<rosInterfaces><ROSOdomToPAT><topic>/t</topic>"
        "<vehicleName>g</vehicleName><visualize>3</visualize></ROSOdomToPAT></rosInterfaces>",
        tmp_path,
    )
    assert scene.sim_params.show_trajectory == (ShowTrajectorySpec(target="g", line_style=3),)
    assert scene.ros_interfaces == (ROSOdomToPATSpec(topic="/t", vehicle_name="g"),)
    assert len(said) == 1


def test_a_multibeam_of_2013_gets_angles(tmp_path: Path) -> None:
    scene, _ = scene_of(
        VEHICLE.format(
            "<multibeamSensor><name>m</name><relativeTo>part0</relativeTo><numpixels>121"
            "</numpixels><fieldOfView>120</fieldOfView><range>10</range></multibeamSensor>"
        ),
        tmp_path,
    )
    beams = scene.vehicles[0].parts_of(MultibeamSensorSpec)[0]
    assert (beams.init_angle, beams.final_angle, beams.angle_incr) == (-60, 60, 1)
    assert beams.n_beams == 121


def test_a_multibeam_of_2013_without_a_range_measures_as_far_as_those_of_the_original(
    tmp_path: Path,
) -> None:
    scene, said = scene_of(
        VEHICLE.format(
            "<multibeamSensor><name>m</name><relativeTo>part0</relativeTo><numpixels> 121 "
            "</numpixels><fieldOfView> 120 </fieldOfView></multibeamSensor>"
        ),
        tmp_path,
    )
    beams = scene.vehicles[0].parts_of(MultibeamSensorSpec)[0]
    assert (beams.n_beams, beams.range) == (121, 10)
    assert "10 m" in said[0]


PROFILER = (
    "<ProfilingSonar><name>p</name><relativeTo>part0</relativeTo><initAngle>45</initAngle>"
    "<finalAngle>135</finalAngle><angleIncr>0.45</angleIncr><range>10</range><fov>1</fov>"
    "</ProfilingSonar>"
)
MODEM = "<CommsDevice><name>c</name><relativeTo>part0</relativeTo><mac>3</mac></CommsDevice>"
ECHO = "<echo><name>e</name><info>hello</info></echo>"
TELL_PROFILER = "<ProfilingSonarROS><name>p</name><topic>/p</topic></ProfilingSonarROS>"
TELL_MODEM = "<CommsDeviceROS><name>c</name><topic>/c</topic></CommsDeviceROS>"
TELL_ECHO = "<echoROS><name>e</name><topic>/e</topic></echoROS>"


@pytest.mark.parametrize("devices", ["simulatedDevices", "simulatedDevice"])
@pytest.mark.parametrize("topics", ["SimulatedDeviceROS", "SimulatedDevicesROS"])
def test_devices_and_their_topics_may_stand_in_wrappers_of_either_name(
    devices: str, topics: str, tmp_path: Path
) -> None:
    scene, said = scene_of(
        VEHICLE.format(f"<{devices}>{PROFILER}{ECHO}{MODEM}</{devices}>")
        + f"<rosInterfaces><{topics}>{TELL_ECHO}{TELL_PROFILER}{TELL_MODEM}</{topics}>"
        "</rosInterfaces>",
        tmp_path,
    )
    vehicle = scene.vehicles[0]
    wrapped = [echo for box in vehicle.parts_of(SimulatedDevicesSpec) for echo in box.echo]
    assert [sonar.name for sonar in vehicle.parts_of(ProfilingSonarSpec)] == ["p"]
    assert [modem.dccomms_id for modem in vehicle.parts_of(CustomCommsDeviceSpec)] == ["c"]
    assert [echo.name for echo in (*vehicle.parts_of(EchoSpec), *wrapped)] == ["e"]
    interfaces = {type(interface) for interface in scene.ros_interfaces}
    assert {ProfilingSonarROSSpec, CustomCommsDeviceROSSpec} < interfaces
    assert interfaces & {EchoROSSpec, SimulatedDeviceROSSpec}
    assert not [message for message in said if "no " in message and "is called" in message]


def test_several_wrappers_on_one_vehicle_are_read_as_one(tmp_path: Path) -> None:
    wrapper = "<simulatedDevices>{}</simulatedDevices>"
    other = ECHO.replace("<name>e<", "<name>f<")
    scene, _ = scene_of(
        VEHICLE.format(wrapper.format(ECHO) + wrapper.format(other) + wrapper.format(""))
        + f"<rosInterfaces><SimulatedDeviceROS>{TELL_ECHO}{TELL_ECHO.replace('>e<', '>f<')}"
        "</SimulatedDeviceROS></rosInterfaces>",
        tmp_path,
    )
    vehicle = scene.vehicles[0]
    (box,) = vehicle.parts_of(SimulatedDevicesSpec)
    assert {echo.name for echo in (*vehicle.parts_of(EchoSpec), *box.echo)} == {"e", "f"}
    assert len(scene.ros_interfaces) == 2


def test_a_wrapper_with_echoes_alone_stays_as_the_original_has_it(tmp_path: Path) -> None:
    scene, said = scene_of(
        VEHICLE.format(f"<simulatedDevices>{ECHO}</simulatedDevices>")
        + f"<rosInterfaces><SimulatedDeviceROS>{TELL_ECHO}</SimulatedDeviceROS></rosInterfaces>",
        tmp_path,
    )
    assert said == []
    assert scene.vehicles[0].parts_of(EchoSpec) == ()


CURRENT_OF_2013 = (
    "<oceanState><current><forceModule> 0.1 </forceModule>"
    "<sphericalDirection><theta>1.57</theta><phi>0.5</phi></sphericalDirection>"
    "<forceVariation>0.01</forceVariation><forcePeriod>4</forcePeriod>"
    "<directionVariation><theta>0</theta><phi>0.7</phi></directionVariation>"
    "<directionPeriod><theta>0</theta><phi>30</phi></directionPeriod>"
    "<random>0.02</random></current></oceanState>"
)


def test_a_current_of_2013_in_the_ocean_is_a_sinusoid(tmp_path: Path) -> None:
    scene, said = scene_of(CURRENT_OF_2013, tmp_path)
    assert scene.ocean_state.currents == (
        UwsimSinusoidSpec(
            speed=0.1, speed_variation=0.01, speed_period=4.0, theta=1.57,
            phi=0.5, phi_variation=0.7, phi_period=30.0, random=0.02,
        ),
    )  # fmt: skip
    assert len(said) == 1
    assert "uwsimSinusoid" in said[0]


def test_a_word_in_a_current_of_2013_is_reported_at_its_line(tmp_path: Path) -> None:
    said = diagnostics(CURRENT_OF_2013.replace(" 0.1 ", "strong"), tmp_path)
    assert len(said) == 1
    assert "strong" in said[0]


@pytest.mark.parametrize(
    ("parent", "dropped"),
    [
        ("simParams", "<disableTextures>0</disableTextures>"),
        ("rosInterfaces", "<ArmToROSJointState><topic>/t</topic><vehicleName>g</vehicleName>"
         "<includesFixedAndMimic>1</includesFixedAndMimic></ArmToROSJointState>"),
    ],
)  # fmt: skip
def test_what_has_no_effect_any_more_is_dropped_with_a_warning(
    parent: str, dropped: str, tmp_path: Path
) -> None:
    _, said = scene_of(f"<{parent}>{dropped}</{parent}>" + VEHICLE.format(""), tmp_path)
    assert len(said) == 1
    assert "ignored" in said[0]


def test_factors_of_2013_lock_axes(tmp_path: Path) -> None:
    scene, _ = scene_of(
        "<object><name>o</name><file>f</file><physics><mass>1</mass>"
        "<linearFactor><x>0</x><y>1</y><z>1</z></linearFactor></physics></object>",
        tmp_path,
    )
    physics = scene.objects[0].physics
    assert physics is not None
    assert (physics.min_linear_limit, physics.max_linear_limit) == ((0, 1, 1), (0, 0, 0))


def test_a_comms_device_of_2017_becomes_a_custom_one(tmp_path: Path) -> None:
    scene, said = scene_of(
        VEHICLE.format(
            "<CommsDevice><name>modem</name><relativeTo>part0</relativeTo><mac>3</mac>"
            "<maxBitRate>100</maxBitRate><bitrateSd>1</bitrateSd><trTime>2</trTime>"
            "<minPktErrRatio>0.1</minPktErrRatio>"
            "<pktErrRatioIncPerMeter>0.01</pktErrRatioIncPerMeter>"
            "<macProtocol>ALOHA</macProtocol></CommsDevice>"
        ),
        tmp_path,
    )
    device = scene.vehicles[0].parts_of(CustomCommsDeviceSpec)[0]
    assert (device.dccomms_id, device.mac, device.bitrate) == ("modem", 3, 100)
    assert device.intrinsic_delay == 2
    assert device.rate_error_model is not None
    assert device.rate_error_model.error_rate_expr == "0.1+0.01*m"
    assert device.mac_protocol is not None
    assert device.mac_protocol.name == "ALOHA"
    assert len(said) >= 5


def test_physics_water_and_an_old_visible_are_dropped_with_a_warning(tmp_path: Path) -> None:
    scene, said = scene_of(
        "<simParams><physicsWater><size><minX>1</minX></size></physicsWater></simParams>"
        + VEHICLE.format(
            "<structuredLightProjector><name>l</name><relativeTo>part0</relativeTo><fov>21</fov>"
            "<image_name>a.png</image_name><visible>1</visible></structuredLightProjector>"
        ),
        tmp_path,
    )
    assert len(said) == 2
    assert scene.vehicles[0].parts_of(StructuredLightProjectorSpec)[0].laser


def test_a_scene_with_a_wrong_root_says_what_was_expected(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="the root element is <scene>; expected <UWSimScene>"):
        read_scene(written("<scene/>", tmp_path))


def test_a_misspelt_camera_is_an_error_with_file_and_line(tmp_path: Path) -> None:
    file = written("<UWSimScene>\n" + VEHICLE.format("<virtualCamra/>") + "</UWSimScene>", tmp_path)
    with pytest.raises(SceneError) as caught:
        read_scene(file)
    assert str(caught.value) == (
        f"{file}:2: <virtualCamra> is not an element of <vehicle>. Did you mean virtualCamera?"
    )


def test_a_topic_of_a_sensor_that_is_not_there_is_a_warning_as_in_the_original(
    tmp_path: Path,
) -> None:
    inside = "<virtualCamera><name>bowtech1</name><relativeTo>part0</relativeTo></virtualCamera>"
    _, said = scene_of(
        VEHICLE.format(inside)
        + "<rosInterfaces><VirtualCameraToROSImage><cameraName>bowtech2</cameraName>"
        "<imageTopic>/i</imageTopic><infoTopic>/c</infoTopic></VirtualCameraToROSImage>"
        "</rosInterfaces>",
        tmp_path,
    )
    assert said == [
        "<VirtualCameraToROSImage>: no virtualCamera or virtualRangeImage is called 'bowtech2'. "
        "Did you mean bowtech1? The interface is ignored, as in the original"
    ]


def test_depth_of_a_colour_camera_is_an_error_because_the_original_crashes(tmp_path: Path) -> None:
    camera = "<virtualCamera><name>c</name><relativeTo>part0</relativeTo></virtualCamera>"
    said = diagnostics(
        VEHICLE.format(camera)
        + "<rosInterfaces><VirtualCameraToROSImage><cameraName>c</cameraName><imageTopic>/i"
        "</imageTopic><infoTopic>/c</infoTopic><depth>1</depth></VirtualCameraToROSImage>"
        "</rosInterfaces>",
        tmp_path,
    )
    assert said == ["<VirtualCameraToROSImage>: <depth> 1 needs a virtualRangeImage; 'c' is none"]


def checked(inside: str, folder: Path, doctype: str = "") -> list[tuple[str, str]]:
    file = written(f"{doctype}<UWSimScene>{inside}</UWSimScene>", folder)
    return [
        (diagnostic.severity, diagnostic.message)
        for diagnostic in check_file(file)
        if not diagnostic.message.startswith("read, not simulated ")
    ]


def test_a_sensor_on_an_unknown_link_is_a_warning_and_a_force_sensor_an_error(
    tmp_path: Path,
) -> None:
    said = checked(
        VEHICLE.format(
            "<imu><name>i</name><relativeTo>part9</relativeTo></imu>"
            "<ForceSensor><name>f</name><target>base</target></ForceSensor>"
        ),
        tmp_path,
    )
    assert [severity for severity, _ in said] == ["warning", "error"]
    assert "'part9' is no link of data/scenes/g500ARM5.urdf. Did you mean part" in said[0][1]


def test_a_force_sensor_on_a_link_without_mass_is_a_warning(tmp_path: Path) -> None:
    sensor = VEHICLE.format("<ForceSensor><name>f</name><target>part4_jaw1</target></ForceSensor>")
    physics = "<simParams><enablePhysics>1</enablePhysics></simParams>"
    said = checked(physics + sensor, tmp_path)
    assert ("warning", "<ForceSensor>: its link 'part4_jaw1' has no mass") in said
    assert {severity for severity, _ in said} == {"warning"}


def test_a_model_that_is_nowhere_is_an_error_that_names_the_folders(tmp_path: Path) -> None:
    thing = "<object><name>o</name><file>objects/mermaid.osg</file></object>"
    ((severity, message),) = checked(thing, tmp_path)
    assert severity == "error"
    assert str(tmp_path) in message
    ((severity, _),) = checked(thing, tmp_path, '<!DOCTYPE UWSimScene SYSTEM "UWSimScene.dtd">')
    assert severity == "warning"


def test_a_joint_beyond_its_limit_is_a_warning(tmp_path: Path) -> None:
    joints = "<joint>0</joint><joint>0</joint><joint>2.2</joint>"
    ((severity, message),) = checked(
        VEHICLE.format(f"<jointValues>{joints}</jointValues>"), tmp_path
    )
    assert (severity, message) == ("warning", "joint 'Elbow' at 2.2 is limited to 2.15294")


def test_errors_of_the_robots_file_are_errors_of_its_scene(tmp_path: Path) -> None:
    (tmp_path / "bad.urdf").write_text('<robot name="r"><link/></robot>')
    ((_, message), *_) = checked("<vehicle><name>v</name><file>bad.urdf</file></vehicle>", tmp_path)
    assert message == "a <link> lacks the attribute name"


def test_what_is_not_simulated_yet_is_one_line_a_kind(tmp_path: Path) -> None:
    file = written(
        "<UWSimScene>\n"
        + VEHICLE.format(
            "\n<virtualCamera><name>a</name><relativeTo>part0</relativeTo>"
            "<showpath>1</showpath></virtualCamera>"
            "\n<virtualCamera><name>b</name><relativeTo>part0</relativeTo>"
            "<showpath>1</showpath></virtualCamera>"
        )
        + "</UWSimScene>",
        tmp_path,
    )
    assert [str(diagnostic) for diagnostic in check_text(file)] == [
        f"{file}:3: warning: read, not simulated yet: showpath (lines 3, 4)"
    ]


def test_contacts_and_solid_objects_are_simulated_where_no_vehicle_is(tmp_path: Path) -> None:
    contact = (
        "<contactSensorToROS><name>g</name><topic>/t</topic><rate>9</rate></contactSensorToROS>"
    )
    thing = "<object><name>o</name><file>a.obj</file><physics><mass>1</mass></physics></object>"
    scene = VEHICLE.format("") + thing + f"<rosInterfaces>{contact}</rosInterfaces>"
    file = written(f"<UWSimScene>{scene}</UWSimScene>", tmp_path)
    assert check_text(file) == []


def test_objects_that_a_search_never_finds_and_topics_of_two_are_named(tmp_path: Path) -> None:
    thing = "<object><name>{}</name><file>a.obj</file></object>\n"
    odom = "<PATToROSOdom><topic>/o</topic><vehicleName>g</vehicleName></PATToROSOdom>"
    file = written(
        "<UWSimScene>\n" + VEHICLE.format("") + "\n" + thing.format("a") * 3 + thing.format("g")
        + f"<rosInterfaces>{odom}\n{odom}</rosInterfaces></UWSimScene>",
        tmp_path,
    )  # fmt: skip
    assert [str(diagnostic) for diagnostic in check_text(file)] == [
        f"{file}:4: warning: the object 'a' has the name of an object before it; "
        "searches find the first",
        f"{file}:6: warning: the object 'g' has the name of a vehicle before it; "
        "searches find the first",
        f"{file}:8: warning: the topic '/o' carries 'g' and 'g'; readers get both",
    ]


SEEDS = [EVERY.read_bytes(), *(path.read_bytes() for path in BUNDLED)]
PIECES = [b"<", b">", b"/", b"&", b"nan", b"inf", b"1e999", b"-1", b"\0", b"\xff", b"]]>", b"<!--",
          b"<vehicle>", b"</vehicle>", b"<x>", b"M_PI/2", b"99999999999999999999"]  # fmt: skip


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_no_mutation_of_a_scene_raises_anything_but_a_scene_error(data: st.DataObject) -> None:
    text = bytearray(data.draw(st.sampled_from(SEEDS)))
    for _ in range(data.draw(st.integers(1, 5))):
        at = data.draw(st.integers(0, len(text)))
        piece = data.draw(st.sampled_from(PIECES) | st.binary(max_size=8))
        until = at + data.draw(st.integers(0, 40))
        text[at:until] = piece
    if data.draw(st.booleans()):
        del text[data.draw(st.integers(0, len(text))) :]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.xml"
        file.write_bytes(text)
        said = check_file(file)
        assert all(diagnostic.message for diagnostic in said)
        with contextlib.suppress(SceneError):
            assert isinstance(read_scene(file), SceneSpec)


def test_an_error_never_shows_a_long_value_whole() -> None:
    diagnostics = Diagnostics("f")
    diagnostics.report_unknown(etree.Element("a"), "what", "x" * 10_000, ["y"])
    assert len(diagnostics.to_list()[0].message) < 100
