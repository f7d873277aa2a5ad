"""Where sensors stand and look: Euler angles, u:lookAt, and the words of `uwsim check`."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from uwsim import schema
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.checks import check_file
from uwsim.devices.object_picker import ObjectPickerSpec
from uwsim.scene.mounts import MountFrames, describe_axis
from uwsim.scene.reader import read_scene
from uwsim.scene.settings import apply_setting
from uwsim.scene.urdf.robot import JointSpec, LinkSpec, RobotSpec, VisualSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors import SENSORS
from uwsim.sensors.dvl_sensor import DvlSensorSpec
from uwsim.sensors.gps_sensor import GpsSensorSpec
from uwsim.sensors.imu import ImuSpec
from uwsim.sensors.pressure_sensor import PressureSensorSpec
from uwsim.sensors.range_sensor import RangeSensorSpec
from uwsim.sensors.usbl import UsblSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec

NED = Pose.from_xyz((0.0, 0.0, 0.0), (math.pi, 0.0, -math.pi / 2.0))
ASKEW = VisualSpec(kind="box", rpy=(math.pi, 0.0, 0.0))
ROBOT = RobotSpec(
    name="r",
    root="base",
    links=(LinkSpec(name="base"), LinkSpec(name="arm", visuals=(ASKEW,))),
    joints=(
        JointSpec(
            name="j", kind="continuous", parent="base", child="arm", position=(0.5, 0.2, 0.1),
            rpy=(0.3, 0.4, 0.5), axis=(0.0, 1.0, 0.0), lower=-3.0, upper=3.0,
        ),
    ),
)  # fmt: skip
VEHICLE = VehicleSpec(
    name="v", file="r.urdf", joint_values=(0.7,), position=(1.0, 2.0, 3.0),
    orientation=(0.1, 0.2, 1.0),
)  # fmt: skip
BELLY_UP = replace(VEHICLE, position=(1.0, 2.0, -3.0), orientation=(math.pi, 0.0, 0.5))
Z_UP_BASE = replace(VEHICLE, position=(1.0, 2.0, -3.0), orientation=(0.0, 0.1, 0.5))
STANDS = {
    "z down, L is NED": MountFrames(VEHICLE, ROBOT, NED),
    "z down, L is z up": MountFrames(BELLY_UP, ROBOT, Pose.identity()),
    "z up": MountFrames(Z_UP_BASE, ROBOT, Pose.identity()),
}


def camera(look_at: object, **given: object) -> VirtualCameraSpec:
    made = {"name": "c", "relative_to": "arm", "position": (0.1, 0.2, 0.3)} | given
    return VirtualCameraSpec(look_at=look_at, **made)  # type: ignore[arg-type]


@pytest.mark.parametrize("stand", STANDS.values(), ids=STANDS)
def test_the_directions_of_a_vehicle_are_a_sailors(stand: MountFrames) -> None:
    words = stand.directions
    assert words["down"][2] < 0.0 < words["up"][2]
    assert np.cross(words["down"], words["forward"]) == pytest.approx(words["starboard"])
    heading = words["forward"][:2]
    right = words["starboard"][:2]
    assert heading[0] * right[1] - heading[1] * right[0] < 0.0  # clockwise, seen from above


@pytest.mark.parametrize("stand", STANDS.values(), ids=STANDS)
@pytest.mark.parametrize("visual", [False, True])
@pytest.mark.parametrize(
    ("word", "top"),
    [
        ("forward", "up"), ("aft", "up"), ("port", "up"), ("starboard", "up"),
        ("down", "forward"), ("up", "aft"),
    ],
)  # fmt: skip
def test_a_camera_looks_where_the_word_says_with_the_top_of_its_image_as_nodding_leaves_it(
    word: str, top: str, visual: bool, stand: MountFrames
) -> None:
    ahead, up = stand.viewing_axes(camera(word), visual=visual)
    assert ahead == pytest.approx(stand.directions[word], abs=1e-12)
    assert up == pytest.approx(stand.directions[top], abs=1e-12)


@pytest.mark.parametrize("stand", STANDS.values(), ids=STANDS)
@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (2.0, 0.5, 3.0)])
def test_a_camera_looks_at_a_point_of_l_with_the_worlds_up_on_top(
    stand: MountFrames, scale: tuple[float, float, float]
) -> None:
    stand = replace(stand, vehicle=replace(stand.vehicle, scale_factor=scale))
    point = (4.0, -2.0, 5.0)
    spec = camera(point)
    ahead, up = stand.viewing_axes(spec)
    base = stand.world_from_base
    base_from_eye = base.inverse() @ stand.world_from_link("arm")
    eye = base.transform(np.array(scale) * base_from_eye.transform(np.array([spec.position])))[0]
    target = stand.world_from_localized.transform(np.array([point]))[0]
    assert ahead == pytest.approx((target - eye) / np.linalg.norm(target - eye))
    assert up[2] > 0.0
    assert np.cross(ahead, up)[2] == pytest.approx(0.0, abs=1e-12)  # the horizon is level


def test_a_camera_that_looks_straight_down_at_a_point_has_the_bow_on_top() -> None:
    stand = MountFrames(replace(VEHICLE, orientation=(0.0, 0.0, 0.6)), ROBOT, NED)
    eye = NED.inverse() @ stand.world_from_link("base")
    x, y, z = eye.position
    ahead, up = stand.viewing_axes(camera((x, y, z + 2.0), relative_to="base", position=(0.0,) * 3))
    assert ahead == pytest.approx([0.0, 0.0, -1.0])
    assert up == pytest.approx(stand.directions["forward"])


@pytest.mark.parametrize(
    "spec",
    [
        RangeSensorSpec(name="s", relative_to="arm", range=1.0, look_at="down"),
        ObjectPickerSpec(name="p", relative_to="arm", range=1.0, look_at="down"),
    ],
)
def test_a_ray_along_x_looks_there_too(spec: RangeSensorSpec | ObjectPickerSpec) -> None:
    stand = STANDS["z down, L is NED"]
    pose = stand.world_from_link("arm") @ stand.frame_from_mounted(spec)
    assert pose.rotation[:, 0] == pytest.approx(stand.directions["down"])
    assert np.linalg.det(pose.rotation) == pytest.approx(1.0)


def test_without_lookat_the_angles_say() -> None:
    spec = camera(None, orientation=(0.1, 0.2, 0.3))
    pose = STANDS["z up"].frame_from_mounted(spec)
    assert pose.position == pytest.approx(spec.position)
    assert pose.rotation == pytest.approx(rotation_from_rpy(0.1, 0.2, 0.3))


def test_a_point_in_the_camera_itself_is_no_direction_and_no_nan() -> None:
    stand = MountFrames(replace(VEHICLE, position=(0.0,) * 3), ROBOT, Pose.identity())
    ahead, _ = stand.viewing_axes(camera((0.0, 0.0, 0.0), relative_to="base", position=(0.0,) * 3))
    assert ahead == pytest.approx(stand.directions["forward"])


def test_words_for_directions_say_how_far_off() -> None:
    words = {"forward": np.array([1.0, 0.0, 0.0]), "down": np.array([0.0, 0.0, -1.0])}

    def nodded(degrees: float) -> str:
        angle = math.radians(degrees)
        return describe_axis(np.array([math.cos(angle), 0.0, -math.sin(angle)]), words)

    assert [nodded(angle) for angle in (0.0, 2.0, 45.0, 70.0)] == [
        "forward", "forward, 2 deg off", "between forward and down", "down, 20 deg off"
    ]  # fmt: skip


SCENE = """<UWSimScene xmlns:u="urn:uwsim:1"><vehicle><name>g</name>
<file>data/scenes/g500ARM5.urdf</file><virtualCamera><name>eye</name>
<relativeTo>part0</relativeTo>{}</virtualCamera></vehicle></UWSimScene>"""


def said(folder: Path, inside: str) -> list[str]:
    file = folder / "scene.xml"
    file.write_text(SCENE.format(inside))
    return [diagnostic.message for diagnostic in check_file(file) if "eye" in diagnostic.message]


@pytest.mark.parametrize(
    ("inside", "word"),
    [
        ("<u:lookAt>down</u:lookAt>", "down"),
        ("<u:lookAt> starboard </u:lookAt>", "starboard"),
        ("<u:lookAt><x>9</x><y>0</y><z>0</z></u:lookAt>", "forward"),
        ("<orientation><r>0</r><p>M_PI_2</p><y>0</y></orientation>", "forward"),
    ],
)
def test_check_says_where_a_camera_looks(inside: str, word: str, tmp_path: Path) -> None:
    (message,) = said(tmp_path, inside)
    assert f"'eye' looks {word}" in message


def test_check_says_that_an_orientation_beside_a_lookat_is_not_used(tmp_path: Path) -> None:
    turned = "<orientation><r>1</r><p>0</p><y>0</y></orientation><u:lookAt>down</u:lookAt>"
    assert any("<orientation> is not used" in message for message in said(tmp_path, turned))


def test_a_direction_that_is_none_is_an_error_with_the_nearest_and_the_other_way(
    tmp_path: Path,
) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(SCENE.format("<u:lookAt>donw</u:lookAt>"))
    (diagnostic,) = [each for each in check_file(file) if each.severity == "error"]
    assert "expected one of 'forward'" in diagnostic.message
    assert "or <x> <y> <z>" in diagnostic.message
    assert "Did you mean 'down'?" in diagnostic.message


def test_where_a_camera_looks_can_be_set_from_the_command_line(tmp_path: Path) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(SCENE.format(""))
    scene = read_scene(file)
    for value, expected in (("down", "down"), ("1 2 3", (1.0, 2.0, 3.0))):
        found = apply_setting(scene, "vehicle.virtualCamera.lookAt", value)
        assert found.vehicles[0].parts_of(VirtualCameraSpec)[0].look_at == expected


OF_2013 = """<?xml version="1.0"?><!DOCTYPE UWSimScene SYSTEM "UWSimScene.dtd">
<UWSimScene><simParams><offsetr><x>3.14</x><y>0</y><z>-1.57</z></offsetr></simParams><vehicle>
<name>g</name><file>data/scenes/g500ARM5.urdf</file><virtualCamera><name>bowtech</name>
<relativeTo>part0</relativeTo><orientation><r>0</r><p>{}</p><y>1.57</y></orientation>
</virtualCamera></vehicle></UWSimScene>"""


@pytest.mark.parametrize(("pitch", "is_old"), [("0", True), ("3.14", False), ("1.57", False)])
def test_a_scene_of_before_july_2014_is_reported_with_the_switch_that_turns_its_cameras(
    pitch: str, is_old: bool, tmp_path: Path
) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(OF_2013.format(pitch))
    messages = [diagnostic.message for diagnostic in check_file(file)]
    assert any("--compat visual-frames" in message for message in messages) is is_old


def test_the_recipes_of_the_conventions_page_look_where_they_say() -> None:
    page = (Path(__file__).parents[2] / "docs" / "conventions.md").read_text()
    table = page.split("| looks | top of the image |")[1].split("\n\n")[0].splitlines()[2:]
    for row in table:
        looks, top, *columns = (cell.strip() for cell in row.strip("|").split("|"))
        for column, stand in zip(columns, ("z down, L is NED", "z up"), strict=True):
            r, p, y = (schema.parse_number(word.strip()) for word in column.split(","))
            spec = camera(None, orientation=(r, p, y), relative_to="base")
            ahead, up = STANDS[stand].viewing_axes(spec)
            words = STANDS[stand].directions
            if looks in words:
                assert ahead == pytest.approx(words[looks], abs=1e-9), row
                assert up == pytest.approx(words[top], abs=1e-9), row
            else:
                assert "30 deg" in looks
                expected = math.cos(math.pi / 6) * words["forward"] + 0.5 * words["down"]
                assert ahead == pytest.approx(expected, abs=1e-4), row
    assert len(table) == 7


@pytest.mark.parametrize("stand", STANDS.values(), ids=STANDS)
@pytest.mark.parametrize(
    ("word", "top"),
    [("forward", "up"), ("starboard", "up"), ("down", "forward"), ("up", "aft")],
)
def test_the_z_axis_of_a_dvl_points_where_the_word_says(
    word: str, top: str, stand: MountFrames
) -> None:
    """Its x axis is where the top of a camera's image would be."""
    spec = DvlSensorSpec(name="d", relative_to="arm", position=(0.1, 0.2, 0.3), look_at=word)  # type: ignore[arg-type]
    axes = stand.world_from_mounted(spec).rotation
    assert axes[:, 2] == pytest.approx(stand.directions[word], abs=1e-12)
    assert axes[:, 0] == pytest.approx(stand.directions[top], abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)


def test_every_sensor_with_a_direction_can_be_turned_by_a_word() -> None:
    """All but those that measure at a point or hear all around, whatever is added to the table."""
    undirected = {ImuSpec, GpsSensorSpec, PressureSensorSpec, UsblSpec}
    for spec in SENSORS.values():
        assert hasattr(spec, "look_at") == (spec not in undirected), spec


PARTS = {
    "<dvlSensor> <u:lookAt>down</u:lookAt>": "looks down; its x axis points forward",
    "<dvlSensor> <orientation> <r>0</r> <p>M_PI_2</p> <y>0</y> </orientation>": (
        "looks aft; its x axis points up"
    ),
    "<multibeamSensor> <initAngle>-60</initAngle> <finalAngle>60</finalAngle> "
    "<angleIncr>1</angleIncr> <range>9</range> <u:lookAt>down</u:lookAt>": (
        "looks down; its positive angles are towards forward"
    ),
    "<u:imagingSonar> <u:lookAt>starboard</u:lookAt>": "looks starboard; its top is up",
    "<u:sideScanSonar> <tilt>20</tilt> <u:lookAt>forward</u:lookAt>": (
        "looks port, 20 deg off and starboard, 20 deg off; its track is forward"
    ),
    "<rangeSensor> <range>9</range> <u:lookAt>up</u:lookAt>": "looks up",
    "<u:lamp> <u:lookAt>aft</u:lookAt>": "shines aft",
}


@pytest.mark.parametrize("part", PARTS)
def test_check_says_where_sensors_and_lamps_point(tmp_path: Path, part: str) -> None:
    tag = part[1:].partition(">")[0]
    begin, _, rest = part.partition("> ")
    u = "u:" if tag == "u:lamp" else ""
    text = f"{begin}> <{u}name>it</{u}name> <{u}relativeTo>part0</{u}relativeTo> {rest}</{tag}>"
    file = tmp_path / "scene.xml"
    file.write_text(
        '<UWSimScene xmlns:u="urn:uwsim:1"> <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>0</z> '
        "</offsetr> </simParams> <vehicle> <name>g</name> <file>data/scenes/g500ARM5.urdf</file> "
        f"{text} </vehicle></UWSimScene>"
    )
    found = [each.message for each in check_file(file) if each.message.startswith("'it' ")]
    assert found == [f"'it' {PARTS[part]}"]
