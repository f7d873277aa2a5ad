"""``package://NAME/...`` is a file of the package NAME, wherever its folder lies."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.assets import find, load_model, location_remark, model_location_remark, package_remark
from uwsim.assets.bundled import bundled_files
from uwsim.assets.packages import package_of
from uwsim.checks import check_file, model_warnings
from uwsim.errors import AssetError, AssetNotFound
from uwsim.scene.reader import read_scene

SIZES = {"hull_pkg": 2.0, "tool-desc": 0.2, "arm": 0.7}
"""Package -> edge of its cube [m]."""


@pytest.fixture(autouse=True)
def _no_ros(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"):
        monkeypatch.delenv(name, raising=False)


def cube(path: Path, edge: float) -> Path:
    """Write a solid whose box is a cube."""
    path.parent.mkdir(parents=True, exist_ok=True)
    corners = ((0, 0, 0), (edge, 0, 0), (0, edge, 0), (0, 0, edge))
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    path.write_text("\n".join([*lines, "f 1 3 2", "f 1 2 4", "f 1 4 3", "f 2 3 4"]))
    return path


def package(
    folder: Path, name: str, *, declared: bool = True, mesh: str = "meshes/base.obj"
) -> Path:
    cube(folder / mesh, SIZES[name])
    if declared:
        (folder / "package.xml").write_text(
            f'<?xml version="1.0"?>\n<package format="3">\n  <name>{name}</name>\n</package>'
        )
    return folder


def edge_of(name: str, named_by: Path, *data_path: Path) -> float:
    model = load_model(f"package://{name}/meshes/base.obj", named_by=named_by, data_path=data_path)
    return float(model.box.upper[0] - model.box.lower[0])


LAYOUTS: dict[str, Callable[[Path, str], Path]] = {
    "beside": lambda root, name: root / name,
    "source space": lambda root, name: root / "src" / name,
    "repositories": lambda root, name: root / "src" / f"repo_of_{name}" / name,
    "groups of a repository": lambda root, name: root / "repo" / f"group_of_{name}" / name,
    "installed, isolated": lambda root, name: root / "install" / name / "share" / name,
    "installed, merged": lambda root, name: root / "install" / "share" / name,
}


@pytest.mark.parametrize(
    ("layout", "declared"),
    [
        *((layout, True) for layout in LAYOUTS),
        *((layout, False) for layout in LAYOUTS if layout != "groups of a repository"),
    ],
)
def test_neighbours_in_a_workspace_have_their_own_files(
    layout: str, declared: bool, tmp_path: Path
) -> None:
    (tmp_path / "ws" / "build").mkdir(parents=True)
    for name in SIZES:
        package(LAYOUTS[layout](tmp_path / "ws", name), name, declared=declared)
    for asking in SIZES:
        robot = LAYOUTS[layout](tmp_path / "ws", asking) / "urdf" / "deep" / "r.urdf"
        robot.parent.mkdir(parents=True)
        assert {name: pytest.approx(edge_of(name, robot)) for name in SIZES} == SIZES


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_workspace_as_data_path_is_enough(layout: str, tmp_path: Path) -> None:
    for name in SIZES:
        package(LAYOUTS[layout](tmp_path / "ws", name), name)
    scene = tmp_path / "elsewhere" / "scene.xml"
    scene.parent.mkdir()
    for name, edge in SIZES.items():
        assert edge_of(name, scene, tmp_path / "ws") == pytest.approx(edge)
        assert edge_of(name, scene, LAYOUTS[layout](tmp_path / "ws", name)) == pytest.approx(edge)


def test_a_repository_whose_folder_has_another_name_is_found_by_its_package_xml(
    tmp_path: Path,
) -> None:
    package(tmp_path / "tool_main", "tool-desc")
    package(tmp_path / "deeper" / "a" / "hull-1.2", "hull_pkg")
    scene = tmp_path / "scenes" / "scene.xml"
    scene.parent.mkdir()
    assert edge_of("tool-desc", scene, tmp_path) == pytest.approx(0.2)
    assert edge_of("hull_pkg", scene, tmp_path) == pytest.approx(2.0)
    inside = tmp_path / "tool_main" / "urdf" / "r.urdf"
    assert edge_of("tool-desc", inside) == pytest.approx(0.2)


def test_a_declared_name_comes_before_a_folder_of_that_name(tmp_path: Path) -> None:
    package(tmp_path / "ws" / "a" / "arm", "hull_pkg", declared=False)
    package(tmp_path / "ws" / "b" / "real", "arm")
    assert edge_of("arm", tmp_path / "scene.xml", tmp_path / "ws") == pytest.approx(0.7)


@pytest.mark.parametrize("way", ["data path", "its folder", "ROS_PACKAGE_PATH"])
def test_what_the_user_names_comes_before_a_neighbour_of_a_neighbour(
    way: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    robot = package(tmp_path / "ws" / "a" / "hull_pkg", "hull_pkg") / "urdf" / "rov.urdf"
    package(tmp_path / "ws" / "zz" / "arm", "arm")
    assert edge_of("arm", robot) == pytest.approx(0.7)
    cube(package(tmp_path / "other" / "arm", "arm") / "meshes" / "base.obj", 0.3)
    folders = {"data path": tmp_path / "other", "its folder": tmp_path / "other" / "arm"}
    if way == "ROS_PACKAGE_PATH":
        monkeypatch.setenv(way, str(tmp_path / "other"))
    given = (folders[way],) if way in folders else ()
    assert edge_of("arm", robot, *given) == pytest.approx(0.3)
    cube(package(tmp_path / "ws" / "a" / "arm", "arm") / "meshes" / "base.obj", 0.9)
    assert edge_of("arm", robot, *given) == pytest.approx(0.9)  # beside it


@pytest.mark.parametrize("variable", ["ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"])
def test_the_variables_of_ros_name_folders_with_packages(
    variable: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = tmp_path / "home" / "scenes" / "scene.xml"
    scene.parent.mkdir(parents=True)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    first, second = tmp_path / "opt" / "first", tmp_path / "opt" / "second"
    under = "group" if variable == "ROS_PACKAGE_PATH" else "share"
    package(first / under / "hull_pkg", "hull_pkg")
    package(second / under / "tool-desc", "tool-desc")
    with pytest.raises(AssetNotFound, match="Package 'tool-desc' is not found"):
        edge_of("tool-desc", scene)
    monkeypatch.setenv(variable, f"{first}:{tmp_path / 'gone'}:relative:{second}")
    assert edge_of("tool-desc", scene) == pytest.approx(0.2)
    assert edge_of("hull_pkg", scene) == pytest.approx(2.0)


def test_a_package_that_appears_later_is_found(tmp_path: Path) -> None:
    package(tmp_path / "ws" / "src" / "hull_pkg", "hull_pkg")
    scene = tmp_path / "scene.xml"
    assert package_remark("package://arm/meshes/base.obj", named_by=scene, data_path=(tmp_path,))
    package(tmp_path / "ws" / "src" / "group" / "arm", "arm")
    assert edge_of("arm", scene, tmp_path) == pytest.approx(0.7)


@pytest.mark.parametrize(
    "written",
    [
        "package://arm/meshes/base.obj",
        "model://arm/meshes/base.obj",
        " file://package://arm/meshes/base.obj\n",
        "file:///package://arm/meshes/base.obj",
        "package:///arm/meshes/base.obj",
        "\tfile:////model://arm//meshes/base.obj",
        "file:package://arm/meshes/base.obj",
    ],
)
def test_a_package_may_be_written_in_the_ways_of_ros_and_gazebo(
    written: str, tmp_path: Path
) -> None:
    for name in SIZES:
        package(tmp_path / name, name, declared=False)
    found = find(written, named_by=tmp_path / "hull_pkg" / "urdf" / "r.urdf")
    assert found == tmp_path / "arm" / "meshes" / "base.obj"


@pytest.mark.parametrize("slashes", ["//", "///", "////"])
def test_slashes_before_a_package_are_none_of_its_name(slashes: str) -> None:
    assert package_of(f"package:{slashes}arm/meshes/base.obj") == ("arm", "meshes/base.obj")


@pytest.mark.parametrize("slashes", ["//", "///", "/////"])
def test_messages_show_the_name_of_a_package_alone(slashes: str, tmp_path: Path) -> None:
    package(tmp_path / "arm", "arm")
    robot = tmp_path / "arm" / "r.urdf"
    text = ROBOT.format("arm", "lost").replace("lost/meshes/base", "lost/tool")
    robot.write_text(text.replace("package:", f"file:{slashes}package:"))
    scene = tmp_path / "arm" / "scene.xml"
    file = f"file:{slashes}package://arm/gone.obj"
    scene.write_text(f"<UWSimScene><object><name>o</name><file>{file}</file></object></UWSimScene>")
    messages = [each.message for path in (robot, scene) for each in check_file(path)]
    assert [each for each in messages if "'package://lost/tool.obj'" in each]
    assert [each for each in messages if "'package://arm/gone.obj'" in each]
    assert not [each for each in messages if "file:" in each or "package://arm/meshes" in each]


MODELS = {
    "models of a package": ("ws/src/vendor/objects_pkg", "models"),
    "worlds of a package": ("ws/worlds", "gazebo/models"),
    "beside its package.xml": ("ws/a/b/objects", "."),
}
"""Layout -> folder of the package, and the folder in it that has the models."""


@pytest.mark.parametrize("scheme", ["model", "package"])
@pytest.mark.parametrize("has_config", [True, False])
@pytest.mark.parametrize("layout", MODELS)
def test_a_model_in_a_package_is_found_from_the_workspace(
    layout: str, has_config: bool, scheme: str, tmp_path: Path
) -> None:
    owner, under = (Path(part) for part in MODELS[layout])
    package(tmp_path / owner, "hull_pkg")
    for name, edge in {"block": 0.4, "plug_2": 1.5}.items():
        cube(tmp_path / owner / under / name / "meshes" / "m.obj", edge)
        if has_config:
            (tmp_path / owner / under / name / "model.config").write_text("<model/>")
    scene = tmp_path / "elsewhere" / "scene.xml"
    scene.parent.mkdir()
    for name, edge in {"block": 0.4, "plug_2": 1.5}.items():
        file = f"{scheme}://{name}/meshes/m.obj"
        model = load_model(file, named_by=scene, data_path=(tmp_path / "ws",))
        assert model.box.upper[0] == pytest.approx(edge)
        assert not model_location_remark(file, named_by=scene, data_path=(tmp_path / "ws",))


def test_a_package_comes_before_a_folder_of_its_name_in_another(tmp_path: Path) -> None:
    package(tmp_path / "ws" / "a" / "tool-desc", "tool-desc")
    package(tmp_path / "ws" / "z" / "deep" / "arm", "arm")
    for name, edge in {"models/arm": 0.3, "models/tool-desc": 0.9, "x/y/arm": 0.1}.items():
        cube(tmp_path / "ws" / "a" / "tool-desc" / name / "meshes" / "base.obj", edge)
    scene = tmp_path / "elsewhere" / "scene.xml"
    scene.parent.mkdir()
    for name in ("arm", "tool-desc"):
        assert edge_of(name, scene, tmp_path / "ws") == pytest.approx(SIZES[name])
        file = f"package://{name}/meshes/base.obj"
        assert not model_location_remark(file, named_by=scene, data_path=(tmp_path / "ws",))


def test_the_folders_in_packages_are_counted_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.assets.packages.MAX_FOLDERS", 12)
    package(tmp_path / "ws" / "a", "hull_pkg")
    package(tmp_path / "ws" / "z" / "deep" / "arm", "arm")
    for i in range(40):
        cube(tmp_path / "ws" / "a" / f"m{i:02d}" / "base.obj", 0.5)
    scene = tmp_path / "elsewhere" / "scene.xml"
    scene.parent.mkdir()
    assert edge_of("arm", scene, tmp_path / "ws") == pytest.approx(0.7)
    assert find("model://m03/base.obj", named_by=scene, data_path=(tmp_path / "ws",))
    assert find("model://m39/base.obj", named_by=scene, data_path=(tmp_path / "ws",)) is None


def test_a_mesh_of_another_extension_comes_from_the_package_that_is_named(tmp_path: Path) -> None:
    package(tmp_path / "hull_pkg", "hull_pkg", mesh="meshes/base.dae.obj")
    cube(tmp_path / "hull_pkg" / "meshes" / "part.obj", 2.0)
    cube(tmp_path / "arm" / "meshes" / "part.obj", 0.7)
    robot = tmp_path / "hull_pkg" / "urdf" / "r.urdf"
    model = load_model("package://arm/meshes/part.osg", named_by=robot)
    assert model.box.upper[0] == pytest.approx(0.7)


def test_a_package_without_the_file_has_no_stand_in_from_elsewhere(tmp_path: Path) -> None:
    package(tmp_path / "hull_pkg", "hull_pkg")
    package(tmp_path / "arm", "arm", mesh="meshes/other.obj")
    robot = tmp_path / "hull_pkg" / "urdf" / "r.urdf"
    with pytest.raises(AssetNotFound, match=r"Package 'arm' is .*arm, which has no 'meshes/b"):
        edge_of("arm", robot)
    with pytest.raises(AssetNotFound):
        load_model("package://arm/objects/torus.osg", named_by=robot)


def test_a_lost_package_is_named_and_a_file_of_that_path_is_used_with_a_warning(
    tmp_path: Path,
) -> None:
    mesh = cube(tmp_path / "copied" / "meshes" / "base.obj", 0.7)
    robot = tmp_path / "copied" / "r.urdf"
    name = "package://gone/meshes/base.obj"
    assert find(name, named_by=robot) == mesh
    remark = location_remark(name, mesh, named_by=robot)
    assert remark.startswith("package 'gone' is not found; --data-path DIR adds its folder")
    assert remark.endswith(f"{mesh} is used")


@pytest.mark.parametrize(
    "path", ["package://../key.obj", "package://./key.obj", "package://.ssh/key.obj"]
)
def test_what_is_no_name_of_a_package_leads_nowhere(path: str, tmp_path: Path) -> None:
    cube(tmp_path / ".ssh" / "key.obj", 1.0)
    cube(tmp_path / "other" / "key.obj", 1.0)
    assert find(path, named_by=tmp_path / "a" / "r.urdf") is None


def test_a_link_out_of_the_folders_searched_is_refused_in_a_package_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    secret = cube(tmp_path / "other" / "base.obj", 1.0)
    meshes = tmp_path / "home" / "ws" / "arm" / "meshes"
    meshes.mkdir(parents=True)
    (meshes / "base.obj").symlink_to(secret)
    robot = tmp_path / "home" / "ws" / "hull" / "r.urdf"
    with pytest.raises(AssetError, match="is outside the searched folders"):
        find("package://arm/meshes/base.obj", named_by=robot)


def test_files_of_the_original_need_no_package(tmp_path: Path) -> None:
    scene = tmp_path / "uwsim" / "scene.xml"  # a folder of the package's name, without its files
    scene.parent.mkdir()
    found = find("package://uwsim/data/scenes/g500ARM5.urdf", named_by=scene)
    assert found == bundled_files("scenes")["cirs"].parent / "g500ARM5.urdf"


ROBOT = """<robot name="r">
  <link name="hull"><visual><geometry><mesh filename="package://{0}/meshes/base.obj"/></geometry>
  </visual></link>
  <link name="tool"><visual><geometry><mesh filename="package://{1}/meshes/base.obj"/></geometry>
  </visual></link>
  <joint name="j" type="fixed"><parent link="hull"/><child link="tool"/></joint>
</robot>"""
SCENE = (
    "<UWSimScene><vehicle><name>r</name><file>{}</file>"
    "<position><x>0</x><y>0</y><z>-5</z></position></vehicle></UWSimScene>"
)


def test_a_scene_and_a_robot_use_the_meshes_of_two_packages(tmp_path: Path) -> None:
    names = ("hull_pkg", "tool-desc")
    for name in names:
        package(tmp_path / "ws" / "src" / name, name)
    robot = tmp_path / "ws" / "src" / "hull_pkg" / "urdf" / "r.urdf"
    robot.parent.mkdir()
    robot.write_text(ROBOT.format(*names))
    scene = tmp_path / "scenes" / "scene.xml"
    scene.parent.mkdir()
    scene.write_text(SCENE.format("package://hull_pkg/urdf/r.urdf"))
    folders = (tmp_path / "ws",)
    assert check_file(scene, data_path=folders) == []
    with open_scene(read_scene(scene, data_path=folders), data_path=folders) as simulation:
        edges = [part.model.box.upper[0] for part in simulation.world.scenery.parts]
        assert model_warnings(simulation.world.model) == []
    assert edges == pytest.approx([2.0, 0.2])


@pytest.mark.parametrize("has_mesh", [True, False])
def test_check_and_run_report_a_package_that_is_not_found(has_mesh: bool, tmp_path: Path) -> None:
    package(tmp_path / "hull_pkg", "hull_pkg", mesh="meshes/base.obj" if has_mesh else "x.obj")
    robot = tmp_path / "hull_pkg" / "r.urdf"
    robot.write_text(ROBOT.format("hull_pkg", "tool_of_nobody"))
    scene = tmp_path / "hull_pkg" / "scene.xml"
    scene.write_text(SCENE.format("r.urdf"))
    for file in (scene, robot):
        messages = [each.message for each in check_file(file) if "tool_of_nobody" in each.message]
        assert len(messages) == 1
        assert "package 'tool_of_nobody' is not found" in messages[0]
    with open_scene(read_scene(scene)) as simulation:
        warnings = [str(each) for each in model_warnings(simulation.world.model)]
    assert len([each for each in warnings if "package 'tool_of_nobody' is not found" in each]) == 1


@pytest.mark.parametrize("edge", [0.2, 0.5])
@pytest.mark.parametrize("folders", [("a/tool", "b/tool"), ("src/x/tool", "vendor/x/tool")])
def test_a_package_that_is_there_twice_is_named_where_the_files_differ(
    folders: tuple[str, str], edge: float, tmp_path: Path
) -> None:
    asked = tmp_path / "elsewhere" / "r.urdf"
    asked.parent.mkdir()
    first, second = (tmp_path / "ws" / folder / "m.obj" for folder in folders)
    cube(first, 0.5)
    cube(second, edge)
    remark = model_location_remark(
        "package://tool/m.obj", named_by=asked, data_path=(tmp_path / "ws",)
    )
    twice = f"package 'tool' exists twice; {first} is used, not {second}"
    assert remark == ("" if edge == 0.5 else twice)


@pytest.mark.parametrize("name", ["m.dae", "package://tool/m.dae", "m.ive"])
def test_a_mesh_of_another_format_is_named(name: str, tmp_path: Path) -> None:
    robot = tmp_path / "tool" / "r.urdf"
    mesh = cube(robot.parent / "m.obj", 0.2)
    told = model_location_remark(name, named_by=robot)
    assert told == ("" if name.endswith(".ive") else f"'m.dae' is not found; {mesh} is used")


@pytest.mark.parametrize("place", ["visual", "collision"])
@pytest.mark.parametrize("name", ["meshes/none.stl", "/opt/x/none.stl", "file:///opt/x/none.stl"])
def test_check_and_run_report_a_mesh_that_is_nowhere(name: str, place: str, tmp_path: Path) -> None:
    """A labelled box is in its place, which sonars measure, too."""
    (tmp_path / "r.urdf").write_text(
        f'<robot name="r"><link name="base"><{place}><geometry><mesh filename="{name}"/>'
        f"</geometry></{place}></link></robot>"
    )
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.format("r.urdf"))
    found = [str(each) for each in check_file(scene)]
    with open_scene(read_scene(scene)) as simulation:
        told = [str(each) for each in model_warnings(simulation.world.model)]
    for messages in (found, told):
        assert len([each for each in messages if "none.stl" in each and "r.urdf:1" in each]) == 1
        assert all("a labelled box" in each for each in messages if "none.stl" in each)
