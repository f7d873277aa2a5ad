"""Courses of objects: errors of files, and lines in an open scene."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.errors import SceneError, UnknownName
from uwsim.scene.object import CourseSpec
from uwsim.scene.reader import read_scene

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <object> <name>terrain</name> <file>objects/box.osg</file>
    <position> <x>0</x> <y>0</y> <z>-2</z> </position>
    <scaleFactor> <x>40</x> <y>40</y> <z>1</z> </scaleFactor>
  </object>
  <object> <name>cable</name> <file>objects/box.osg</file>
    <position> <x>1</x> <y>0</y> <z>0</z> </position>
    <scaleFactor> <x>0.1</x> <y>0.2</y> <z>0.1</z> </scaleFactor>
    {extra}
    <u:course> <u:points>{points}</u:points> <u:bendRadius>1</u:bendRadius> </u:course>
  </object>
</UWSimScene>
"""


def write(folder: Path, *, points: str = "0 0 0 4 0 0 4 3 0", extra: str = "") -> Path:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(points=points, extra=extra))
    return path


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ("0 0 0 1", "has 4 numbers; expected x y z of two points at least"),
        ("0 0 0 0 0 0 1 0 0", "repeats a point"),
        ("0 0 0 5000 0 0", "is 5000 m long; expected at most 2000 m"),
    ],
)
def test_points_that_are_no_line(tmp_path: Path, points: str, message: str) -> None:
    with pytest.raises(SceneError, match=message):
        read_scene(write(tmp_path, points=points))


def test_a_loose_course_is_an_error(tmp_path: Path) -> None:
    path = write(tmp_path, extra="<physics> <mass>3</mass> </physics>")
    with pytest.raises(SceneError, match="<u:course> is fixed"):
        read_scene(path)


def test_a_course_on_the_floor_lies_above_the_ground(tmp_path: Path) -> None:
    extra = "<u:onFloor> <u:clearance>0.05</u:clearance> </u:onFloor>"
    world = open_scene(read_scene(write(tmp_path, extra=extra))).world.measure_view
    line = world.surroundings.course("cable")
    np.testing.assert_allclose(line[:, 2], -1.45, atol=1e-9)
    np.testing.assert_allclose(line[[0, -1], :2], [[1.0, 0.0], [5.0, 3.0]], atol=1e-9)
    with pytest.raises(UnknownName, match="course"):
        world.surroundings.course("terrain")


def test_a_course_without_ground_is_an_error(tmp_path: Path) -> None:
    path = write(tmp_path, points="0 0 0 100 0 0", extra="<u:onFloor/>")
    with pytest.raises(SceneError, match="no ground under the object 'cable'"):
        open_scene(read_scene(path))


def test_the_line_of_a_course_has_its_bends() -> None:
    line = CourseSpec(points=(0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 4.0, 3.0, 0.0), bend_radius=1.0).line
    assert np.hypot(line[1:-1, 0] - 3.0, line[1:-1, 1] - 1.0) == pytest.approx(1.0)
