"""An absolute path of another computer is resolved by its last parts, with a warning."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.assets import find, load_model, location_remark
from uwsim.checks import check_file, model_warnings
from uwsim.errors import AssetError
from uwsim.scene.reader import read_scene

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
ROOTS = ["/home/someone/ws/src/", "file:///opt/a/b/", "~nobody/data/", "C:\\Users\\me\\", "D:/x/y/"]


def mesh(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(TRIANGLE)
    return path


@pytest.mark.parametrize("root", ROOTS)
@pytest.mark.parametrize(
    ("written", "lies", "asking"),
    [
        ("rocks/rock 1.obj", "rock 1.obj", "scene.xml"),
        ("pkg/meshes/hull.obj", "meshes/hull.obj", "scene.xml"),
        ("pkg/meshes/hull.obj", "meshes/hull.obj", "urdf/robot.urdf"),
        ("pkg/meshes/hull.obj", "pkg/meshes/hull.obj", "other/urdf/robot.urdf"),
        ("deep/objects/x.obj", "objects/x.obj", "scene.xml"),
    ],
)
def test_it_is_found_by_its_last_parts(
    root: str, written: str, lies: str, asking: str, tmp_path: Path
) -> None:
    file = mesh(tmp_path / lies)
    named_by = tmp_path / asking
    name = root + (written.replace("/", "\\") if "\\" in root else written)
    found = find(name, named_by=named_by)
    assert found == file
    assert location_remark(name, found, named_by=named_by).endswith(
        f"is a path of another computer; {file} is used"
    )


def test_the_most_parts_win_and_a_data_path_is_searched_too(tmp_path: Path) -> None:
    mesh(tmp_path / "scenes" / "hull.obj")
    exact = mesh(tmp_path / "scenes" / "b" / "meshes" / "hull.obj")
    scene = tmp_path / "scenes" / "scene.xml"
    assert find("/home/x/b/meshes/hull.obj", named_by=scene) == exact
    far = mesh(tmp_path / "data" / "keel.obj")
    assert find("/home/x/keel.obj", named_by=scene) is None
    assert find("/home/x/keel.obj", named_by=scene, data_path=(tmp_path / "data",)) == far


def test_the_last_part_alone_is_not_looked_for_in_the_folders_above(tmp_path: Path) -> None:
    mesh(tmp_path / "base.obj")
    assert find("/home/x/meshes/base.obj", named_by=tmp_path / "a" / "b" / "r.urdf") is None


def test_a_file_that_is_on_this_computer_is_not_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    secret = mesh(tmp_path / "other" / "x.obj")
    mesh(tmp_path / "home" / "sea" / "x.obj")
    scene = tmp_path / "home" / "sea" / "scene.xml"
    with pytest.raises(AssetError, match="is outside the searched folders"):
        load_model(str(secret), named_by=scene)
    here = find(str(secret), named_by=scene, data_path=(secret.parent,))
    assert here == secret
    assert location_remark(str(secret), here, named_by=scene) == ""


def test_check_and_run_warn_and_use_the_file(tmp_path: Path) -> None:
    mesh(tmp_path / "rock.obj")
    mesh(tmp_path / "meshes" / "hull.obj")
    (tmp_path / "boat.urdf").write_text(
        '<robot name="b"><link name="a"><visual><geometry>'
        '<mesh filename="file:///home/b/boat/meshes/hull.obj"/></geometry></visual></link></robot>'
    )
    scene = tmp_path / "scene.xml"
    scene.write_text(
        "<UWSimScene>\n<vehicle><name>v</name><file>/root/.ros/boat.urdf</file></vehicle>\n"
        "<object><name>rock</name><file> /home/someone/ws/rock.obj </file></object></UWSimScene>"
    )
    found = check_file(scene)
    assert {each.severity for each in found} == {"warning"}
    told = [each.message for each in found if "is a path of another computer" in each.message]
    assert [message.split("'")[1].rpartition("/")[2] for message in told] == [
        "boat.urdf",
        "rock.obj",
        "hull.obj",
    ]
    with open_scene(read_scene(scene)) as simulation:
        warnings = [str(each) for each in model_warnings(simulation.world.model)]
        sources = {part.model.source for part in simulation.world.scenery.parts}
    assert sum("is a path of another computer" in each for each in warnings) == 3
    assert sources == {"file"}
