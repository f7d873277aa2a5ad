import os
from pathlib import Path

import pytest

from uwsim.assets import find, has_model, load_model, model_read_error, searched_folders
from uwsim.errors import AssetError


def touch(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"x")
    return path


def test_a_file_beside_the_file_that_names_it_comes_before_the_data_path(tmp_path: Path) -> None:
    near = touch(tmp_path / "scenes" / "box.stl")
    touch(tmp_path / "data" / "box.stl")
    found = find("box.stl", named_by=tmp_path / "scenes" / "a.xml", data_path=(tmp_path / "data",))
    assert found == near


def test_parent_folders_and_their_data_folders_are_searched(tmp_path: Path) -> None:
    mesh = touch(tmp_path / "data" / "objects" / "box.stl")
    scene = touch(tmp_path / "data" / "scenes" / "deep" / "a.xml")
    assert find("objects/box.stl", named_by=scene) == mesh
    assert find("box.stl", named_by=scene) == mesh


@pytest.mark.parametrize(
    "under", ["", "data", "data/scenes", "objects", "terrain", "robot", "textures"]
)
def test_every_data_path_is_searched_under_the_known_folders(tmp_path: Path, under: str) -> None:
    mesh = touch(tmp_path / under / "thing.obj")
    assert find("thing.obj", data_path=(tmp_path,)) == mesh


def test_a_robot_next_to_its_scene_is_found_by_the_folders_of_the_original(tmp_path: Path) -> None:
    """A scene of UWSim names ``data/scenes/x.urdf`` next to it; whoever has it copied both."""
    scene = touch(tmp_path / "mine" / "a.xml")
    robot = touch(scene.parent / "x.urdf")
    assert find("data/scenes/x.urdf", named_by=scene) == robot
    assert find("package://uwsim/data/scenes/x.urdf", named_by=scene) == robot
    assert find("data/scenes/x.urdf", named_by=tmp_path / "b.xml") is None
    assert find("data/scenes/x.urdf", named_by=tmp_path / "b.xml", data_path=(scene.parent,)) == (
        robot
    )
    mesh = touch(tmp_path / "meshes" / "objects" / "m.obj")
    assert find("data/objects/m.obj", named_by=scene, data_path=(tmp_path / "meshes",)) == mesh


def test_a_robot_next_to_its_scene_comes_before_the_bundled_one(tmp_path: Path) -> None:
    scene = touch(tmp_path / "a.xml")
    robot = touch(tmp_path / "g500ARM5.urdf")
    assert find("data/scenes/g500ARM5.urdf", named_by=scene) == robot
    bundled = find("data/scenes/g500ARM5.urdf", named_by=tmp_path / "elsewhere" / "a.xml")
    assert bundled not in (None, robot)
    assert find("data/scenes/g500ARM5.urdf", named_by=bundled, data_path=(tmp_path,)) == bundled


def test_an_earlier_data_path_wins(tmp_path: Path) -> None:
    first = touch(tmp_path / "a" / "robot" / "x.stl")
    touch(tmp_path / "b" / "x.stl")
    assert find("x.stl", data_path=(tmp_path / "a", tmp_path / "b")) == first


def test_the_bundled_robot_is_found_by_the_name_that_scenes_use() -> None:
    found = find("data/scenes/g500ARM5.urdf")
    assert found is not None
    assert found.name == "g500ARM5.urdf"


def test_a_robot_in_the_folder_of_uwsims_own_data_is_found_by_the_name_that_its_scenes_use(
    home: Path,
) -> None:
    robot = touch(home / ".uwsim" / "data" / "models" / "mine.urdf")
    assert find("data/models/mine.urdf") == robot
    assert find("models/mine.urdf") == robot


def test_an_absolute_name_is_looked_for_nowhere_else(tmp_path: Path) -> None:
    mesh = touch(tmp_path / "x.stl")
    assert find(str(mesh)) == mesh
    assert find("/x.stl", data_path=(tmp_path,)) is None


@pytest.mark.parametrize("name", ["", "a\0b", "x" * 5000, "no/such/file.stl", "\ud800"])
def test_names_no_file_can_have_are_simply_not_there(tmp_path: Path, name: str) -> None:
    assert find(name, data_path=(tmp_path,)) is None


def test_blanks_and_url_prefixes_do_not_belong_to_a_name(tmp_path: Path) -> None:
    mesh = touch(tmp_path / "meshes" / "x.stl")
    assert find("  meshes/x.stl \n", data_path=(tmp_path,)) == mesh
    assert find("package://my_robot/meshes/x.stl", data_path=(tmp_path,)) == mesh
    assert find(f"file://{mesh}") == mesh


def test_folders_are_listed_once_each_in_order(tmp_path: Path) -> None:
    scene = tmp_path / "deep" / "a.xml"
    folders = searched_folders(named_by=scene, data_path=(tmp_path,))
    assert len(folders) == len(set(folders))
    assert folders[0] == scene.parent
    assert Path() in folders
    assert folders.index(scene.parent) < folders.index(tmp_path)
    assert (tmp_path / "data/scenes") in folders


def test_neither_the_home_folder_nor_what_is_above_it_is_searched(home: Path) -> None:
    touch(home / "secret.stl")
    scene = touch(home / "projects" / "sea" / "scene.xml")
    assert find("secret.stl", named_by=scene) is None
    assert find("secret.stl", named_by=home / "scene.xml") == home / "secret.stl"


OUTSIDE = "is outside the searched folders, so that it is not read; --data-path adds"


@pytest.mark.parametrize("by", ["absolute", "up", "link", "url"])
def test_what_a_file_names_lies_under_the_folders_searched(tmp_path: Path, by: str) -> None:
    secret = touch(tmp_path / "other" / "secret.stl")
    scene = touch(tmp_path / "home" / "sea" / "scene.xml")
    link = scene.parent / "link.stl"
    link.symlink_to(secret)
    names = {"absolute": str(secret), "up": "../../other/secret.stl", "link": "link.stl"}
    name = names.get(by, f"file://{secret}")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOME", str(tmp_path / "home"))
        for ask in (find, load_model, has_model):
            with pytest.raises(AssetError, match=OUTSIDE):
                ask(name, named_by=scene)
        assert OUTSIDE in model_read_error(name, named_by=scene)
        assert find(name, named_by=scene, data_path=(secret.parent,)) is not None


def test_what_a_program_names_may_lie_anywhere(tmp_path: Path) -> None:
    mesh = touch(tmp_path / "other" / "x.stl")
    assert find(str(mesh), data_path=(tmp_path / "data",)) == mesh


@pytest.mark.parametrize("name", ["/dev/zero", "pipe.stl"])
def test_a_device_or_a_pipe_is_no_file(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / "pipe.stl")
    assert find(name, named_by=tmp_path / "scene.xml") is None
