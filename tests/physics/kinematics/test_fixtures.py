"""Hinges and slides of objects, against closed forms of statics."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.errors import SceneError, UnknownName, UwsimError
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file> {dynamics} </vehicle>
  <object> <name>wall</name> <file>objects/box.osg</file>
    <position> <x>5</x> <y>0</y> <z>-3</z> </position>
    <physics> <mass>0</mass> </physics>
  </object>
  <object> <name>lever</name> <file>objects/box.osg</file>
    <position> <x>5</x> <y>0</y> <z>-3</z> </position>
    <scaleFactor> <x>0.1</x> <y>0.1</y> <z>0.1</z> </scaleFactor>
    {physics}
    {joint}
  </object>
</UWSimScene>
"""
DYNAMICS = "<u:dynamics>bluerov2_heavy</u:dynamics>"
PHYSICS = """<physics> <mass>2</mass> <u:volume>0</u:volume>
  <u:centreOfMass> <x>0.3</x> <y>0</y> <z>0</z> </u:centreOfMass> </physics>"""
HINGE = "<u:hinge> <u:axis> <x>0</x> <y>1</y> <z>0</z> </u:axis> {} </u:hinge>"
SLIDE = "<u:slide> <u:axis> <x>0</x> <y>0</y> <z>1</z> </u:axis> {} </u:slide>"
WEIGHT = 2.0 * 9.81


def write(folder: Path, joint: str, physics: str = PHYSICS, dynamics: str = DYNAMICS) -> Path:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(joint=joint, physics=physics, dynamics=dynamics))
    return path


def simulate(folder: Path, joint: str, time: float) -> Simulation:
    simulation = open_scene(read_scene(write(folder, joint)))
    simulation.advance(time)
    return simulation


def position(simulation: Simulation) -> float:
    return simulation.world.measure_view.joint_position("lever")


def test_a_slide_rests_where_its_spring_carries_the_weight(tmp_path: Path) -> None:
    joint = SLIDE.format("<u:stiffness>200</u:stiffness> <u:damping>60</u:damping>")
    simulation = simulate(tmp_path, joint, 4.0)
    assert position(simulation) == pytest.approx(-WEIGHT / 200.0, rel=1e-3)
    body = simulation.world.measure_view.body("lever").world_from_body
    assert body.position[2] == pytest.approx(-3.0 - WEIGHT / 200.0, abs=1e-4)


def test_a_hinge_rests_where_its_spring_carries_the_moment(tmp_path: Path) -> None:
    joint = HINGE.format("<u:stiffness>8</u:stiffness> <u:damping>4</u:damping>")
    angle = position(simulate(tmp_path, joint, 6.0))
    assert 8.0 * angle == pytest.approx(0.3 * WEIGHT * math.cos(angle), rel=1e-3)


def test_dry_friction_holds_a_smaller_moment_and_yields_to_a_greater_one(tmp_path: Path) -> None:
    moment = 0.3 * WEIGHT
    held = HINGE.format(f"<u:friction>{1.05 * moment}</u:friction>")
    assert abs(position(simulate(tmp_path, held, 1.0))) < 1e-3
    free = HINGE.format(f"<u:friction>{0.5 * moment}</u:friction>")
    assert position(simulate(tmp_path, free, 1.0)) > 0.3


def test_a_hinge_returns_with_the_state(tmp_path: Path) -> None:
    simulation = simulate(tmp_path, HINGE.format("<u:damping>5</u:damping>"), 0.2)
    state, start = simulation.save(), position(simulation)
    simulation.advance(0.2)
    assert position(simulation) > start + 0.01
    simulation.restore(state)
    assert position(simulation) == start


def test_a_hinge_ends_at_its_stop(tmp_path: Path) -> None:
    joint = HINGE.format("<u:lower>-0.2</u:lower> <u:upper>0.5</u:upper> <u:damping>5</u:damping>")
    assert position(simulate(tmp_path, joint, 3.0)) == pytest.approx(0.5, abs=0.01)


def test_an_object_with_a_joint_cannot_be_placed(tmp_path: Path) -> None:
    simulation = simulate(tmp_path, HINGE.format(""), 0.01)
    pose = simulation.pose("lever")
    with pytest.raises(UwsimError, match="cannot be placed"):
        simulation.set_pose("lever", pose)


def test_only_objects_with_joints_have_a_position(tmp_path: Path) -> None:
    with pytest.raises(UnknownName, match="lever"):
        simulate(tmp_path, HINGE.format(""), 0.0).world.measure_view.joint_position("leverr")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"joint": HINGE.format("") + SLIDE.format("")}, "expected one joint"),
        ({"joint": HINGE.format("<u:lower>1</u:lower>")}, "expected both or neither"),
        (
            {"joint": HINGE.format("<u:lower>1</u:lower> <u:upper>1</u:upper>")},
            "<u:lower> 1 is not below <u:upper> 1",
        ),
        (
            {"joint": HINGE.format("<u:lower>1</u:lower> <u:upper>2</u:upper>")},
            "<u:lower> 1 to <u:upper> 2 excludes 0, the start",
        ),
        ({"joint": HINGE.format("").replace("<y>1", "<y>0")}, "<u:axis> is 0 0 0"),
        ({"joint": HINGE.format("").replace("<y>1", "<y>1e-300")}, "<u:axis> is 0 1e-300 0"),
        ({"joint": HINGE.format(""), "physics": ""}, "expected <physics> with a <mass>"),
        ({"joint": HINGE.format(""), "dynamics": ""}, "expected a vehicle with <u:dynamics>"),
    ],
)
def test_a_joint_that_cannot_move(tmp_path: Path, changes: dict[str, str], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        read_scene(write(tmp_path, **changes))
