"""Worlds of SDF: objects, water, meshes, missing files, broken files, and the command."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from tests.importing.sdf_files import ROV, import_text, link, write_in_model, write_in_world
from uwsim.cli import main
from uwsim.errors import AssetError, BadSetting, SceneError
from uwsim.importing import ImportRequest, import_file
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.reader import read_scene
from uwsim.scene.urdf.reader import read_urdf

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
FACES = [
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6),
    (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
]  # fmt: skip

WORLD = write_in_world(
    """
    <spherical_coordinates> <latitude_deg>36.8</latitude_deg> <longitude_deg>-122</longitude_deg>
    </spherical_coordinates>
    <plugin filename="gz-sim-buoyancy-system" name="gz::sim::systems::Buoyancy">
      <graded_buoyancy> <default_density>1025</default_density>
        <density_change> <above_depth>0.5</above_depth> <density>1.125</density> </density_change>
      </graded_buoyancy> </plugin>
    <light name="sun" type="directional"/>
    <model name="floor"> <static>true</static> <pose>0 0 -10 0 0 0</pose> <link name="l">
      <collision name="c"> <geometry> <plane> <normal>0 0 1</normal> </plane> </geometry>
      </collision> <visual name="v"> <geometry> <plane> <normal>0 0 1</normal>
      <size>40 30</size> </plane> </geometry> </visual> </link> </model>
    <model name="ball"> <pose>1 2 -3 0 0 0</pose> <link name="l"> <inertial> <mass>4</mass>
      <pose>0 0 -0.01 0 0 0</pose> <inertia> <ixx>0.02</ixx> <iyy>0.02</iyy> <izz>0.02</izz>
      </inertia> </inertial> <collision name="c"> <geometry> <sphere> <radius>0.1</radius>
      </sphere> </geometry> </collision> <visual name="v"> <geometry> <sphere>
      <radius>0.1</radius> </sphere> </geometry> <material> <diffuse>1 0 0 1</diffuse> </material>
      </visual> </link> </model>
    <include> <uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Rock</uri> </include>
    """
)


def write_cube(path: Path) -> None:
    """Write a cube of side 1, with a corner at the origin."""
    lines = [f"v {x} {y} {z}" for x, y, z in CUBE.tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n")


def mesh(uri: str, scale: str = "1 1 1") -> str:
    """Return a link with a mesh."""
    shape = f"<geometry> <mesh> <uri>{uri}</uri> <scale>{scale}</scale> </mesh> </geometry>"
    return (
        f'<link name="a"> <collision name="c"> <pose>0 0 1 0 0 0</pose> {shape} </collision> '
        f'<visual name="v"> {shape} </visual> </link>'
    )


def test_water_floor_and_loose_bodies_of_a_world(tmp_path: Path) -> None:
    result = import_text(tmp_path, WORLD)
    scene = read_scene(result.scene)
    assert (scene.ocean_state.density, scene.ocean_state.ocean_surface_height) == (1025.0, 0.5)
    assert scene.ned_origin is not None
    assert (scene.ned_origin.lat, scene.ned_origin.lon) == (36.8, -122.0)
    floor, ball = scene.objects
    assert (floor.name, floor.position, floor.solid.mass) == ("floor", (0.0, 0.0, -10.0), 0.0)
    assert ball.physics is not None
    assert (ball.physics.mass, ball.physics.inertia) == (4.0, (0.02, 0.02, 0.02))
    assert ball.physics.volume == pytest.approx(4 / 3 * np.pi * 0.1**3, rel=1e-6)
    assert ball.physics.centre_of_mass == (0.0, 0.0, -0.01)
    reasons = {row.element: row.reason for row in result.report.rows if row.status == "left out"}
    assert "not downloaded" in next(text for key, text in reasons.items() if "Rock" in key)
    assert "light sun" in reasons


def test_mesh_has_its_scale_and_its_volume(tmp_path: Path) -> None:
    write_cube(tmp_path / "meshes" / "cube.obj")
    two = mesh("meshes/cube.obj", "0.2 0.3 0.4") + link("b")
    weld = '<joint name="j" type="fixed"> <parent>a</parent> <child>b</child> </joint>'
    result = import_text(tmp_path, write_in_model(two + weld))
    folder = result.scene.parent
    body = read_vehicle(folder / "m.xml").body("a")
    assert body is not None
    assert body.volume == pytest.approx(0.2 * 0.3 * 0.4, rel=1e-6)
    assert body.centre_of_buoyancy == pytest.approx((0.1, 0.15, 1.2), abs=1e-6)
    shape = read_urdf(folder / "m.urdf").links[0].visuals[0]
    assert (shape.file, shape.scale) == ("meshes/cube.obj", (0.2, 0.3, 0.4))
    assert (folder / "meshes" / "cube.obj").read_bytes() == (
        tmp_path / "meshes/cube.obj"
    ).read_bytes()


def test_materials_and_images_are_copied_with_their_mesh(tmp_path: Path) -> None:
    write_cube(tmp_path / "models" / "rock" / "meshes" / "cube.obj")
    folder = tmp_path / "models" / "rock"
    text = (folder / "meshes" / "cube.obj").read_text()
    (folder / "meshes" / "cube.obj").write_text(f"mtllib cube.mtl\nusemtl stone\n{text}")
    (folder / "meshes" / "cube.mtl").write_text("newmtl stone\nKd 0.2 0.4 0.6\n")
    content = f"<static>1</static> {mesh('model://rock/meshes/cube.obj', '2 2 2')}"
    result = import_text(tmp_path, write_in_model(content), folders=(tmp_path / "models",))
    entry = read_scene(result.scene).objects[0]
    assert (entry.file, entry.scale_factor) == ("meshes/cube/cube.obj", (2.0, 2.0, 2.0))
    assert (result.scene.parent / "meshes" / "cube" / "cube.mtl").is_file()


def test_missing_mesh_leaves_the_shape_out_with_its_line(tmp_path: Path) -> None:
    content = link("b") + "\n" + mesh("model://nowhere/a.dae")
    weld = '<joint name="j" type="fixed"> <parent>b</parent> <child>a</child> </joint>'
    result = import_text(tmp_path, write_in_model(content + weld))
    rows = [row for row in result.report.rows if row.element == "visual v"]
    assert [row.status for row in rows] == ["left out"]
    assert "model://nowhere/a.dae" in rows[0].reason
    assert rows[0].line == link("b").count("\n") + 2


def test_world_without_buoyancy_displaces_no_water(tmp_path: Path) -> None:
    model = ROV.partition("<model")[2].partition("</sdf>")[0]
    result = import_text(tmp_path, write_in_world(f"<model {model}"))
    assert read_vehicle(result.scene.parent / "rov.xml").bodies[0].volume == 0.0


def test_joint_to_the_world_makes_a_vehicle_that_stays(tmp_path: Path) -> None:
    anchor = '<joint name="w" type="fixed"> <parent>world</parent> <child>a</child> </joint>'
    arm = (
        '<joint name="j" type="revolute"> <parent>a</parent> <child>b</child> <axis>'
        "<xyz>0 0 1</xyz> </axis> </joint>"
    )
    result = import_text(tmp_path, write_in_model(link("a") + link("b") + anchor + arm))
    assert read_scene(result.scene).vehicles[0].dynamics is None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<sdf version='1.9'>\n<model name='m'>", "world.sdf:2: not well-formed"),
        ("<robot/>", "world.sdf:1: the root element is <robot>; expected <sdf>"),
        ("<sdf version='1.9'/>", "no <world> and no <model>"),
        ('<!DOCTYPE a [<!ENTITY b "c">]><sdf/>', "declarations are not read"),
        (
            write_in_model("\n<link name='a'> <pose>1 2</pose> </link>"),
            "world.sdf:2: <pose> is '1 2'",
        ),
        (
            write_in_model("<link name='a'/> <link name='a'/>"),
            "two parts of model 'm' are called 'a'",
        ),
        (
            write_in_model(
                "<link name='a'> <visual name='v'> <geometry> <blob/> </geometry> </visual> </link>"
            ),
            "<blob> is no geometry",
        ),
        (
            write_in_model(link("a") + "<joint name='j' type='fixed'> <parent>a</parent> </joint>"),
            "joint 'j' lacks its <child>",
        ),
    ],
)
def test_broken_files_are_errors_with_their_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(SceneError) as info:
        import_text(tmp_path, text)
    assert message in str(info.value)
    assert not (tmp_path / "scene").exists()


def test_all_errors_of_a_file_are_reported_at_once(tmp_path: Path) -> None:
    content = (
        "<link name='a'> <pose>x</pose> <inertial> <mass>-1</mass> </inertial> </link>\n"
        "<link name='b'> <pose>0 0 nan 0 0 0</pose> </link>"
    )
    with pytest.raises(SceneError) as info:
        import_text(tmp_path, write_in_model(content))
    assert len(str(info.value).splitlines()) == 3


def test_a_model_that_includes_itself_is_an_error(tmp_path: Path) -> None:
    folder = tmp_path / "models" / "snake"
    folder.mkdir(parents=True)
    (folder / "model.sdf").write_text(
        write_in_model("<include> <uri>model://snake</uri> </include>", name="snake")
    )
    with pytest.raises(SceneError, match="includes itself"):
        import_file(
            ImportRequest(file=folder, out=tmp_path / "scene", folders=(tmp_path / "models",))
        )


def test_included_files_stay_below_the_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.importing.sdf.models.MAX_FILES", 3)
    folder = tmp_path / "models" / "rock"
    folder.mkdir(parents=True)
    (folder / "model.sdf").write_text(write_in_model(link("a"), name="rock"))
    includes = "<include> <uri>model://rock</uri> </include>" * 5
    with pytest.raises(BadSetting, match="more than 3 files"):
        import_text(tmp_path, write_in_world(includes), folders=(tmp_path / "models",))


def test_other_files_and_existing_folders_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.usd").write_text("#usda 1.0")
    with pytest.raises(BadSetting, match="are not imported; expected"):
        import_file(ImportRequest(file=tmp_path / "a.usd", out=tmp_path / "scene"))
    (tmp_path / "scene").mkdir()
    with pytest.raises(BadSetting, match="new folder"):
        import_text(tmp_path, ROV)


def test_command_reports_what_was_imported_and_the_scene_runs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "rov.sdf").write_text(ROV)
    out = str(tmp_path / "scene")
    assert main(["import", str(tmp_path / "rov.sdf"), "-o", out, "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["counts"]["left out"] == 2
    assert main(["run", f"{out}/scene.xml", "--for", "0.1s"]) == 0


def test_equal_files_are_imported_with_equal_bytes(tmp_path: Path) -> None:
    texts = []
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        folder = import_text(tmp_path / name, WORLD).scene.parent
        files = sorted(path for path in folder.rglob("*") if path.is_file())
        texts.append([path.read_bytes() for path in files])
    assert texts[0] == texts[1]


def test_world_of_vrml_becomes_a_fixed_object(tmp_path: Path) -> None:
    path = tmp_path / "my harbour.wrl"
    path.write_text("#VRML V2.0 utf8\nShape { geometry Box { size 4 2 6 } }\nText { }")
    result = import_file(ImportRequest(file=path, out=tmp_path / "scene"))
    scene = read_scene(result.scene)
    assert [entry.name for entry in scene.objects] == ["my_harbour"]
    assert scene.objects[0].solid.mass == 0.0
    assert scene.ocean_state.ocean_surface_height == 3.0  # 2 m above the box
    statuses = {row.status: row.reason for row in result.report.rows}
    assert statuses["imported"] == "fixed object my_harbour of 12 triangles"
    assert "1 Text is left out" in statuses["changed"]


def test_damaged_world_of_vrml_is_one_error_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "a.wrl"
    path.write_text("#VRML V2.0 utf8\nShape { geometry Box {")
    with pytest.raises(AssetError) as error:
        import_file(ImportRequest(file=path, out=tmp_path / "scene"))
    assert str(error.value) == f"{path}: line 2: Box has no end."
    assert not (tmp_path / "scene").exists()
