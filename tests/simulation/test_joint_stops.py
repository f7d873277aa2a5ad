"""Joints hold their place, and stop at their limits whatever pushes them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.messages import JointState
from uwsim.physics.joints import STOP_MARGIN, STOP_MARGIN_ANGLE

HULL = """
  <body link="hull">
    <mass>60</mass> <inertia>3 5 6 0 0 0</inertia> <volume>0.064</volume>
    <centreOfBuoyancy> <x>0</x> <y>0</y> <z>0.08</z> </centreOfBuoyancy>
    <addedMass>10 60 80 1 4 3</addedMass> <linearDamping>5 10 10 2 2 2</linearDamping>
    <quadraticDamping>30 150 200 5 20 20</quadraticDamping>
  </body>"""
SET = f"""<hydrodynamics name="lifter">
  <source>a test</source> <density>1000</density>{HULL}
</hydrodynamics>
"""
ROBOT = """<robot name="lifter">
  <link name="hull"> <visual> <geometry> <box size="1.2 0.4 0.3"/> </geometry> </visual> </link>
  <joint name="lift" type="prismatic">
    <parent link="hull"/> <child link="sled"/> <axis xyz="0 0 -1"/>
    <limit lower="0" upper="0.5" effort="200" velocity="0.2"/>
  </joint>
  <link name="sled"> <inertial> <mass value="10"/>
    <inertia ixx="0.2" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/> </inertial> </link>
</robot>
"""
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>lifter</name> <file>lifter.urdf</file>
    <jointValues> <joint>0.5</joint> </jointValues>
    <position> <x>0</x> <y>0</y> <z>-3</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <u:dynamics>lifter</u:dynamics> </vehicle>
  <rosInterfaces> <ROSJointStateToArm> <topic>/arm</topic> <vehicleName>lifter</vehicleName>
  </ROSJointStateToArm> </rosInterfaces>
</UWSimScene>
"""
TURNING = """<robot name="lifter">
  <link name="hull"> <visual> <geometry> <box size="1.2 0.4 0.3"/> </geometry> </visual> </link>
  <joint name="lift" type="KIND">
    <parent link="hull"/> <child link="sled"/> <axis xyz="0 1 0"/>
    LIMIT
  </joint>
  <link name="sled"> <inertial> <origin xyz="0.5 0 0"/> <mass value="10"/>
    <inertia ixx="0.2" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/> </inertial> </link>
</robot>
"""
LIMIT = '<limit lower="0" upper="0.5" effort="50" velocity="0.2"/>'


@pytest.fixture
def simulation(tmp_path: Path) -> uwsim.Simulation:
    return loaded(tmp_path, ROBOT)


def loaded(folder: Path, robot: str) -> uwsim.Simulation:
    (folder / "lifter.xml").write_text(SET)
    (folder / "lifter.urdf").write_text(robot)
    (folder / "scene.xml").write_text(SCENE)
    return uwsim.load(folder / "scene.xml")


def pull_down(simulation: uwsim.Simulation, newtons: float, seconds: float) -> float:
    """Pull the sled; how far it comes out [m]."""
    data, farthest = simulation.world.engine._data, 0.0
    data.xfrc_applied[-1, 2] = -newtons
    for _ in range(round(seconds / 0.01)):
        simulation.advance(0.01)
        farthest = max(farthest, float(simulation.world.vehicles.find("lifter").joints[0]))
    return farthest


def test_a_held_joint_stops_a_little_beyond_its_limit_when_more_pulls_than_its_servo_bears(
    simulation: uwsim.Simulation,
) -> None:
    assert 0.5 < pull_down(simulation, 400.0, 2.0) < 0.5 + 1.5 * STOP_MARGIN


def test_a_joint_that_is_let_go_stops_at_its_limit_and_a_saved_one_does_so_again(
    simulation: uwsim.Simulation,
) -> None:
    simulation.publish("/arm", JointState(name=["lift"], effort=np.array([0.0])))
    simulation.advance(0.1)
    saved = simulation.save()
    farthest = pull_down(simulation, 400.0, 2.0)
    assert farthest < 0.5 + 0.5 * STOP_MARGIN
    simulation.publish("/arm", JointState(name=["lift"], position=np.array([0.2])))
    simulation.advance(0.1)
    simulation.restore(saved)
    assert pull_down(simulation, 400.0, 2.0) == farthest


def test_a_lift_of_200_newtons_gives_way_by_millimetres_under_35(
    simulation: uwsim.Simulation,
) -> None:
    simulation.publish("/arm", JointState(name=["lift"], position=np.array([0.2])))
    simulation.advance(4.0)
    assert simulation.world.vehicles.find("lifter").joints[0] == pytest.approx(0.2, abs=0.001)
    assert pull_down(simulation, 35.0, 2.0) < 0.206


def turning(folder: Path, kind: str = "revolute", limit: str = LIMIT) -> uwsim.Simulation:
    return loaded(folder, TURNING.replace("KIND", kind).replace("LIMIT", limit))


def test_a_held_joint_that_turns_stops_a_little_beyond_its_limit_under_more_than_its_servo_bears(
    tmp_path: Path,
) -> None:
    """400 N at 0.5 m against 50 N m; the hull tilts under it."""
    farthest = pull_down(turning(tmp_path), 400.0, 2.0)
    assert 0.5 < farthest < 0.5 + 1.5 * STOP_MARGIN_ANGLE


def test_one_that_is_let_go_stops_at_its_limit_and_one_that_is_held_again_beyond(
    tmp_path: Path,
) -> None:
    simulation = turning(tmp_path)
    simulation.publish("/arm", JointState(name=["lift"], effort=np.array([0.0])))
    simulation.advance(0.1)
    assert pull_down(simulation, 400.0, 2.0) < 0.5 + 0.5 * STOP_MARGIN_ANGLE
    simulation.publish("/arm", JointState(name=["lift"], position=np.array([0.5])))
    farthest = pull_down(simulation, 400.0, 2.0)
    assert 0.5 + 0.5 * STOP_MARGIN_ANGLE < farthest < 0.5 + 1.5 * STOP_MARGIN_ANGLE


def test_a_servo_that_comes_to_its_limit_under_a_load_does_not_touch_the_stop(
    tmp_path: Path,
) -> None:
    simulation = turning(tmp_path)
    simulation.publish("/arm", JointState(name=["lift"], position=np.array([0.0])))
    simulation.advance(4.0)
    simulation.publish("/arm", JointState(name=["lift"], position=np.array([0.5])))
    assert pull_down(simulation, 20.0, 4.0) < 0.5 + 0.5 * STOP_MARGIN_ANGLE
    assert simulation.world.vehicles.find("lifter").joints[0] == pytest.approx(0.5, abs=0.002)


def test_a_continuous_joint_without_limits_has_no_stop_while_it_is_held(tmp_path: Path) -> None:
    simulation = turning(tmp_path, "continuous", "")
    data = simulation.world.engine._data
    data.qvel[-1] = 20.0
    for _ in range(100):
        data.qfrc_applied[-1] = 3000.0
        simulation.advance(0.01)
    assert simulation.world.vehicles.find("lifter").joints[0] > 2.0 * np.pi
