"""Specs know where they were read, and keep it when they are changed."""

from __future__ import annotations

import dataclasses
import pickle
from pathlib import Path

from uwsim.assets.bundled import scene_file
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import find_vehicle
from uwsim.scene.reader import read_scene
from uwsim.scene.urdf.reader import read_urdf
from uwsim.schema import line_of

ROBOT = """<robot name="r">
  <link name="base"/>
  <link name="arm"/>
  <joint name="j" type="revolute">
    <parent link="base"/> <child link="arm"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
"""


def line_with(path: Path, text: str) -> int:
    lines = path.read_text().splitlines()
    return next(number for number, line in enumerate(lines, 1) if text in line)


def test_a_spec_of_a_scene_has_its_line_and_those_of_its_elements() -> None:
    path = scene_file("visibility-scene")
    scene = read_scene(path)
    [vehicle] = scene.vehicles
    assert vehicle.source_line is not None
    assert vehicle.source_line.file == str(path)
    assert line_of(vehicle) == line_with(path, "<vehicle>")
    assert line_of(vehicle, "file") == line_with(path, ".urdf</file>")
    assert line_of(vehicle, "nothing") == line_of(vehicle)


def test_the_line_survives_a_change_and_a_pickle_and_is_not_compared() -> None:
    [vehicle] = read_scene(scene_file("visibility-scene")).vehicles
    moved = dataclasses.replace(vehicle, position=(1.0, 2.0, 3.0))
    assert line_of(moved) == line_of(vehicle) is not None
    assert line_of(pickle.loads(pickle.dumps(moved))) == line_of(vehicle)
    assert dataclasses.replace(vehicle, source_line=None) == vehicle
    assert "source_line" not in repr(vehicle)


def test_links_and_joints_of_a_robot_have_their_lines(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(ROBOT)
    robot = read_urdf(path)
    assert [line_of(link) for link in robot.links] == [2, 3]
    [joint] = robot.joints
    assert (line_of(robot), line_of(joint), line_of(joint, "limit")) == (1, 4, 7)


def test_bodies_and_thrusters_of_a_hydrodynamics_file_have_their_lines() -> None:
    path = find_vehicle("bluerov2_heavy")
    vehicle = read_vehicle(path)
    assert line_of(vehicle.bodies[0]) == line_with(path, "<body ")
    assert line_of(vehicle.thrusters[0]) == line_with(path, "<thruster ")
    assert line_of(vehicle.thrusters[0], "forward") == line_with(path, "<forward>")
