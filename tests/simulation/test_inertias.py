"""Inertias that no body can have are errors with their lines, before anything is simulated."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.simulation.test_joint_stops import ROBOT, SCENE, SET
from tests.support.opened import open_scene
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene

OBJECT = """<object> <name>box</name> <file>box.obj</file>
  <position> <x>3</x> <y>0</y> <z>-3</z> </position>
  <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
  <physics> <mass>10</mass> <inertia> <x>{}</x> <y>{}</y> <z>{}</z> </inertia> </physics>
</object>
<rosInterfaces>"""
BOX = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"


def said(folder: Path, *, robot: str = ROBOT, scene: str = SCENE) -> list[str]:
    (folder / "lifter.xml").write_text(SET)
    (folder / "lifter.urdf").write_text(robot)
    (folder / "box.obj").write_text(BOX)
    (folder / "scene.xml").write_text(scene)
    with pytest.raises(SceneError) as caught:
        open_scene(read_scene(folder / "scene.xml").nominal_scene, is_blind=True)
    return [
        f"{Path(each.file or '').name}:{each.line}: {each.message}"
        for each in caught.value.diagnostics
    ]


def test_a_link_whose_moments_break_the_triangle_inequality_is_reported(tmp_path: Path) -> None:
    robot = ROBOT.replace('izz="0.2"', 'izz="0.5"')
    assert said(tmp_path, robot=robot) == [
        "lifter.urdf:7: link 'sled': inertia has the principal moments 0.2 0.2 0.5; no body can "
        "have one above the sum of the two others"
    ]


def test_a_link_with_products_larger_than_its_moments_is_reported(tmp_path: Path) -> None:
    robot = ROBOT.replace('ixy="0"', 'ixy="0.3"')
    assert said(tmp_path, robot=robot) == [
        "lifter.urdf:7: link 'sled': inertia has the least principal moment -0.1; expected > 1e-12 "
        "[kg m2]"
    ]


@pytest.mark.parametrize(
    ("moments", "what"),
    [((1, 1, 6), "the principal moments 1 1 6;"), ((1, 0, 0), "the least principal moment 0;")],
)
def test_the_inertia_of_an_object_is_reported(
    moments: tuple[float, ...], what: str, tmp_path: Path
) -> None:
    scene = SCENE.replace("<rosInterfaces>", OBJECT.format(*moments))
    (found,) = said(tmp_path, scene=scene)
    assert found.startswith(f"scene.xml:10: object 'box': inertia has {what}")
