"""Frames of SDF: poses that are relative to others, nested and merged models, joints."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.importing.sdf_files import import_text, link, matrix, write_in_model, write_in_world
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.urdf.reader import read_urdf

WELD = '<joint name="{0}_{1}" type="fixed"> <parent>{0}</parent> <child>{1}</child> </joint>'


def poses(folder: Path, text: str, name: str = "m", joint_values: tuple[float, ...] = ()) -> dict:
    """Return the pose of each link in the root link after an import, (4, 4)."""
    result = import_text(folder, text)
    robot = read_urdf(result.scene.parent / f"{name}.urdf")
    return {key: pose.matrix for key, pose in link_poses(robot, joint_values).items()}


def test_poses_are_relative_to_frames_links_and_joints(tmp_path: Path) -> None:
    text = write_in_model(
        link("a")
        + '<frame name="f" attached_to="a"> <pose degrees="true">1 0 0 0 0 90</pose> </frame>'
        + '<link name="b"> <pose relative_to="f">0 2 0 0.1 0.2 0.3</pose> </link>'
        + '<link name="c"> <pose relative_to="b" rotation_format="quat_xyzw">'
        "0 0 1 0 0 0.6 0.8</pose> </link>" + WELD.format("a", "b") + WELD.format("b", "c")
    )
    matrices = poses(tmp_path, text)
    b = matrix(1, 0, 0, 0, 0, math.pi / 2) @ matrix(0, 2, 0, 0.1, 0.2, 0.3)
    assert matrices["b"] == pytest.approx(b, abs=1e-8)
    c = b @ matrix(0, 0, 1, 0, 0, 2 * math.atan2(0.6, 0.8))
    assert matrices["c"] == pytest.approx(c, abs=1e-8)


def test_nested_model_is_placed_by_its_placement_frame(tmp_path: Path) -> None:
    arm = (
        '<model name="arm" placement_frame="tip"> <pose>1 2 3 0 0 0.5</pose>'
        + link("root")
        + link("tip", "0.5 0 0.2 0 0.4 0")
        + WELD.format("root", "tip")
        + "</model>"
    )
    joint = (
        '<joint name="mount" type="fixed"> <parent>hull</parent> <child>arm::root</child> </joint>'
    )
    matrices = poses(tmp_path, write_in_model(link("hull") + arm + joint))
    tip = matrix(1, 2, 3, 0, 0, 0.5)
    assert matrices["arm_tip"] == pytest.approx(tip, abs=1e-8)
    root = tip @ np.linalg.inv(matrix(0.5, 0, 0.2, 0, 0.4, 0))
    assert matrices["arm_root"] == pytest.approx(root, abs=1e-8)


def test_link_turns_about_a_joint_that_is_not_at_its_origin(tmp_path: Path) -> None:
    joint = (
        '<joint name="hinge" type="revolute"> <parent>a</parent> <child>b</child>'
        "<pose>0 0.3 0 0 0 0</pose> <axis> <xyz expressed_in='__model__'>0 0 1</xyz>"
        "<limit> <lower>-1</lower> <upper>1</upper> </limit> </axis> </joint>"
    )
    text = write_in_model(link("a") + link("b", "1 0 0 0.2 0 0.7") + joint)
    matrices = poses(tmp_path, text, joint_values=(0.6,))
    link_from_joint = matrix(0, 0.3, 0, 0, 0, 0)
    start = matrix(1, 0, 0, 0.2, 0, 0.7) @ link_from_joint
    turn = matrix(0, 0, 0, 0, 0, 0.6)  # about z of the model, through the joint
    expected = start.copy()
    expected[:3, :3] = turn[:3, :3] @ start[:3, :3]
    assert matrices["b"] == pytest.approx(expected, abs=1e-8)  # its frame is at the joint


def test_parts_of_a_link_with_a_moved_frame_stay_where_they_are(tmp_path: Path) -> None:
    joint = (
        '<joint name="hinge" type="revolute"> <parent>a</parent> <child>b</child>'
        "<pose>0 0.3 0 0 0 0</pose> <axis> <xyz>0 0 1</xyz> </axis> </joint>"
    )
    result = import_text(tmp_path, write_in_model(link("a") + link("b", "1 0 0 0 0 0") + joint))
    robot = read_urdf(result.scene.parent / "m.urdf")
    shifted_link = robot.link("b")
    assert shifted_link is not None
    assert shifted_link.centre_of_mass == pytest.approx((0.0, -0.3, 0.0))
    assert shifted_link.collisions[0].position == pytest.approx((0.0, -0.3, 0.0))


def test_axes_of_old_versions_are_in_the_frame_of_the_model(tmp_path: Path) -> None:
    joint = (
        '<joint name="hinge" type="revolute"> <parent>a</parent> <child>b</child>'
        "<axis> <xyz>0 0 1</xyz> </axis> </joint>"
    )
    text = write_in_model(link("a") + link("b", "0 0 0 0.5 0 0") + joint, version="1.4")
    result = import_text(tmp_path, text)
    axis = read_urdf(result.scene.parent / "m.urdf").joints[0].axis
    assert axis == pytest.approx((0.0, math.sin(0.5), math.cos(0.5)), abs=1e-8)


def test_colliding_names_are_told_apart(tmp_path: Path) -> None:
    arm = f'<model name="arm"> {link("wrist")} </model>'
    joints = "".join(
        f'<joint name="j{i}" type="fixed"> <parent>hull</parent> <child>{child}</child> </joint>'
        for i, child in enumerate(("arm::wrist", "arm_wrist"))
    )
    result = import_text(tmp_path, write_in_model(link("hull") + link("arm_wrist") + arm + joints))
    robot = read_urdf(result.scene.parent / "m.urdf")
    assert sorted(entry.name for entry in robot.links) == ["arm_wrist", "arm_wrist_2", "hull"]
    reasons = [row.reason for row in result.report.rows if row.element.startswith("link arm")]
    assert any("its name is arm_wrist" in reason for reason in reasons)


def test_models_of_one_name_become_vehicles_of_two_names(tmp_path: Path) -> None:
    model = f'<model name="rov"> {link("a")} {link("b")} {WELD.format("a", "b")} </model>'
    scene = read_scene(import_text(tmp_path, write_in_world(model + model)).scene)
    assert [vehicle.name for vehicle in scene.vehicles] == ["rov", "rov_2"]
    assert [vehicle.dynamics for vehicle in scene.vehicles] == ["rov", "rov_2"]


def write_model(folder: Path, name: str, content: str) -> None:
    """Write a model that others include as ``model://name``."""
    (folder / name).mkdir(parents=True)
    (folder / name / "model.config").write_text(
        '<model> <sdf version="1.6">old.sdf</sdf> <sdf version="1.9">model.sdf</sdf> </model>'
    )
    (folder / name / "model.sdf").write_text(write_in_model(content, name=name))


def test_included_model_has_the_pose_name_and_sensors_of_the_include(tmp_path: Path) -> None:
    two = link("a", "0 0 1 0 0 0") + link("b") + WELD.format("a", "b")
    write_model(tmp_path / "models", "base", two)
    include = """<include merge="true"> <uri>model://base</uri> <pose>0 0 5 0 0 1.5</pose>
      <experimental:params> <sensor element_id="a" action="add" name="imu" type="imu"/>
      <link element_id="a" action="remove"/> </experimental:params> </include>"""
    (tmp_path / "outer").mkdir()
    text = write_in_model(include + link("tool") + WELD.format("a", "tool"), name="rov")
    result = import_text(tmp_path / "outer", text, folders=(tmp_path / "models",))
    robot = read_urdf(result.scene.parent / "rov.urdf")
    tool = link_poses(robot)["tool"] if robot.root == "a" else link_poses(robot)["tool"].inverse()
    a = matrix(0, 0, 5, 0, 0, 1.5) @ matrix(0, 0, 1, 0, 0, 0)
    assert tool.matrix == pytest.approx(np.linalg.inv(a), abs=1e-8)
    vehicle = read_scene(result.scene).vehicles[0]
    assert vehicle.sensor_names == ("imu",)
    reasons = {row.element: row.reason for row in result.report.rows if row.status == "left out"}
    assert "only sensors" in reasons["params link"]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (link("a") + '<link name="b"> <pose relative_to="aa"/> </link>', "Did you mean a"),
        ('<link name="a"> <pose relative_to="a"/> </link>', "depends on itself"),
        (
            '<link name="a"> <pose relative_to="b"/> </link> <link name="b">'
            '<pose relative_to="a"/> </link>',
            "depends on itself",
        ),
        (link("a") + WELD.format("a", "bb"), "there is no link 'bb'"),
    ],
)
def test_frames_that_do_not_exist_are_errors(tmp_path: Path, content: str, message: str) -> None:
    with pytest.raises(SceneError, match=message):
        import_text(tmp_path, write_in_model(content))


def test_loops_and_loose_links_are_left_out_and_reported(tmp_path: Path) -> None:
    text = write_in_model(
        "".join(map(link, "abcd"))
        + WELD.format("a", "b")
        + WELD.format("b", "c")
        + WELD.format("a", "c")
    )
    result = import_text(tmp_path, text)
    reasons = {row.element: row.reason for row in result.report.rows if row.status == "left out"}
    assert "loop" in reasons["joint b_c"]
    assert "no joint connects it" in reasons["link d"]
