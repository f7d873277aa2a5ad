"""A ``continuous`` joint turns without end, whether its vehicle is simulated or placed."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.messages import JointState
from uwsim.scene.urdf.reader import read_urdf

ENDLESS = {
    "no limit": "",
    "effort and velocity": '<limit effort="40" velocity="3"/>',
    "zeros of an exporter": '<limit lower="0" upper="0" effort="40" velocity="3"/>',
    "pi to both sides": '<limit lower="-3.14" upper="3.14" effort="40" velocity="3"/>',
    "far beyond a turn": '<limit lower="-1e16" upper="1e16" effort="40" velocity="3"/>',
}
DYNAMICS = {
    "placed": "",
    "simulated": "<u:dynamics>boat</u:dynamics>",
}
WATER = """<hydrodynamics name="boat"> <source>a test</source> <density>1000</density>
  <body link="hull"> <mass>60</mass> <inertia>3 5 6 0 0 0</inertia> <volume>0.06</volume>
    <centreOfBuoyancy> <x>0</x> <y>0</y> <z>0.08</z> </centreOfBuoyancy>
    <addedMass>10 60 80 1 4 3</addedMass> <linearDamping>5 10 10 2 2 2</linearDamping>
    <quadraticDamping>30 150 200 5 20 20</quadraticDamping> </body>
</hydrodynamics>"""


def robot(joint: str, limit: str, kind: str = "continuous") -> str:
    return f"""<robot name="boat">
  <link name="hull"> <visual> <geometry> <box size="1.2 0.4 0.3"/> </geometry> </visual> </link>
  <link name="blade"> <inertial> <mass value="0.2"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/> </inertial> </link>
  <joint name="{joint}" type="{kind}"> <parent link="hull"/> <child link="blade"/>
    <origin xyz="0 0 0.3"/> <axis xyz="0 0 1"/> {limit} </joint>
</robot>"""


def loaded(folder: Path, joint: str, limit: str, dynamics: str) -> uwsim.Simulation:
    (folder / "boat.xml").write_text(WATER)
    (folder / "boat.urdf").write_text(robot(joint, limit))
    (folder / "scene.xml").write_text(f"""<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>boat</name> <file>boat.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-3</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation> {dynamics} </vehicle>
  <rosInterfaces> <ROSJointStateToArm> <topic>/arm</topic> <vehicleName>boat</vehicleName>
  </ROSJointStateToArm> </rosInterfaces>
</UWSimScene>""")
    return uwsim.load(folder / "scene.xml")


@pytest.mark.parametrize("dynamics", DYNAMICS)
@pytest.mark.parametrize(
    ("name", "limit"), [("spin", "no limit"), ("wheel_3", "zeros of an exporter")]
)
def test_a_velocity_turns_it_beyond_a_turn(
    name: str, limit: str, dynamics: str, tmp_path: Path
) -> None:
    with loaded(tmp_path, name, ENDLESS[limit], DYNAMICS[dynamics]) as simulation:
        for _ in range(50):
            simulation.publish("/arm", JointState(name=[name], velocity=np.array([-1.5])))
            simulation.advance(0.1)
        angle = float(simulation.world.vehicles.find("boat").joints[0])
    assert angle == pytest.approx(-7.5, abs=0.3)


@pytest.mark.parametrize("dynamics", DYNAMICS)
@pytest.mark.parametrize("limit", ENDLESS)
def test_a_position_beyond_half_a_turn_is_reached(
    limit: str, dynamics: str, tmp_path: Path
) -> None:
    with loaded(tmp_path, "spin", ENDLESS[limit], DYNAMICS[dynamics]) as simulation:
        simulation.publish("/arm", JointState(name=["spin"], position=np.array([4.0])))
        simulation.advance(3.0)
        angle = float(simulation.world.vehicles.find("boat").joints[0])
    assert angle == pytest.approx(4.0, abs=0.02)


@pytest.mark.parametrize("dynamics", DYNAMICS)
@pytest.mark.parametrize("value", [1e9, -1e300, math.inf])
def test_any_position_leaves_a_finite_angle(value: float, dynamics: str, tmp_path: Path) -> None:
    with loaded(tmp_path, "spin", "", DYNAMICS[dynamics]) as simulation:
        simulation.publish("/arm", JointState(name=["spin"], position=np.array([value])))
        simulation.advance(0.2)
        assert np.isfinite(simulation.world.vehicles.find("boat").joints).all()
        simulation.world.engine.set_joints(0, np.array([value]))
        simulation.advance(0.2)
        angle = float(simulation.world.vehicles.find("boat").joints[0])
    assert abs(angle) < 10.0


@pytest.mark.parametrize("limit", ['<limit lower="-1" upper="2"/>', '<limit lower="-1.5"/>'])
def test_bounds_of_less_than_a_turn_hold_as_in_the_original(limit: str, tmp_path: Path) -> None:
    (tmp_path / "boat.urdf").write_text(robot("wrist", limit))
    (wrist,) = read_urdf(tmp_path / "boat.urdf").movable_joints
    assert wrist.has_stops
    assert wrist.clamp(-9.0) == wrist.lower


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_other_joints_keep_their_stops_however_wide(kind: str, tmp_path: Path) -> None:
    (tmp_path / "boat.urdf").write_text(robot("wrist", '<limit lower="-9" upper="9"/>', kind))
    (wrist,) = read_urdf(tmp_path / "boat.urdf").movable_joints
    assert (wrist.clamp(20.0), wrist.clamp(-20.0)) == (9.0, -9.0)
