from pathlib import Path

import pytest

from uwsim.assets import find, folders_searched


def touch(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"x")
    return path


def test_a_file_beside_the_file_that_names_it_comes_before_the_data_path(tmp_path: Path) -> None:
    near = touch(tmp_path / "scenes" / "box.stl")
    touch(tmp_path / "data" / "box.stl")
    found = find("box.stl", beside=tmp_path / "scenes" / "a.xml", data_path=(tmp_path / "data",))
    assert found == near


def test_parent_folders_and_their_data_folders_are_searched(tmp_path: Path) -> None:
    mesh = touch(tmp_path / "data" / "objects" / "box.stl")
    scene = touch(tmp_path / "data" / "scenes" / "deep" / "a.xml")
    assert find("objects/box.stl", beside=scene) == mesh
    assert find("box.stl", beside=scene) == mesh


@pytest.mark.parametrize(
    "under", ["", "data", "data/scenes", "objects", "terrain", "robot", "textures"]
)
def test_every_data_path_is_searched_under_the_known_folders(tmp_path: Path, under: str) -> None:
    mesh = touch(tmp_path / under / "thing.obj")
    assert find("thing.obj", data_path=(tmp_path,)) == mesh


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
    folders = folders_searched(beside=tmp_path / "a.xml", data_path=(tmp_path,))
    assert len(folders) == len(set(folders))
    assert folders[0] == Path()
    assert folders.index(tmp_path) < folders.index(tmp_path.parent)
    assert (tmp_path / "data/scenes") in folders
