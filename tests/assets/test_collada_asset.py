"""Units and axes of Collada files: those of robots as by RViz, those of scenes as by UWSim."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.assets.test_limits import dae
from uwsim.assets.collada_asset import read_collada_asset
from uwsim.model.collision.scene_shapes import collision_shapes
from uwsim.model.parts import parts_of
from uwsim.model.resolved_scene import ResolvedScene
from uwsim.scene.object import ObjectSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.urdf.reader import read_urdf

NODE = '<node> {transform} <instance_geometry url="#g"/> </node>'
CORNERS = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])  # of the triangle
PLAIN = ("", np.eye(4))
MOVED = (
    "<translate>3 4 5</translate> <rotate>1 0 0 90</rotate> <scale>2 2 2</scale>",
    np.array([[2.0, 0, 0, 3], [0, 0, -2.0, 4], [0, 2.0, 0, 5], [0, 0, 0, 1]]),
)
UPRIGHT = {  # of what OpenSceneGraph makes of a vector (x, y, z)
    "X_UP": lambda p: np.stack([p[:, 2], p[:, 1], -p[:, 0]], axis=1),
    "Y_UP": lambda p: np.stack([p[:, 0], -p[:, 2], p[:, 1]], axis=1),
    "Z_UP": lambda p: p,
}


def write(folder: Path, asset: str, transform: str = "") -> Path:
    file = folder / "prop.dae"
    text = dae(NODE.format(transform=transform))
    head, start, rest = text.partition("<library_geometries>")
    file.write_text(f"{head}{asset}{start}{rest}")
    return file


def stated(unit: str, axis: str) -> str:
    return f'<asset> <unit name="u" meter="{unit}"/> <up_axis>{axis}</up_axis> </asset>'


def corners_of_robot(folder: Path, scale: str = "1 1 1") -> np.ndarray:
    (folder / "rov.urdf").write_text(
        '<robot name="rov"> <link name="base_link"> <visual> <geometry>'
        f'<mesh filename="prop.dae" scale="{scale}"/> </geometry> </visual> </link> </robot>'
    )
    robot = read_urdf(folder / "rov.urdf")
    from uwsim.scene.vehicle import VehicleSpec

    scene = SceneSpec(vehicles=(VehicleSpec(name="rov", file=str(robot.path)),))
    resolved = ResolvedScene(scene=scene, robots={0: robot})
    (part,) = parts_of(resolved)
    shape = collision_shapes(resolved, [0], {})["vehicle/0/base_link"][0]
    corners = placed(part)
    box = shape.body_from_shape.position + np.outer([-1.0, 1.0], np.array(shape.size))
    extent = np.ptp(corners, axis=0)
    assert np.ptp(box, axis=0)[extent > 0.0] == pytest.approx(extent[extent > 0.0], rel=1e-6)
    return corners


def corners_of_object(folder: Path, file: Path) -> np.ndarray:
    scene = SceneSpec(objects=(ObjectSpec(name="thing", file=str(file)),))
    (part,) = parts_of(ResolvedScene(scene=scene, robots={}))
    return placed(part)


def placed(part) -> np.ndarray:
    (mesh,) = part.model.meshes
    points = mesh.vertices[mesh.triangles.ravel()].astype(float)
    return points @ part.frame_from_mesh[:3, :3].T + part.frame_from_mesh[:3, 3]


@pytest.mark.parametrize("axis", ["X_UP", "Y_UP", "Z_UP"])
@pytest.mark.parametrize("unit", ["1", "0.01", "0.0254", "1000"])
@pytest.mark.parametrize("node", [PLAIN, MOVED], ids=["plain", "moved"])
def test_a_robot_has_the_unit_and_a_scene_file_the_axis(
    node: tuple[str, np.ndarray], unit: str, axis: str, tmp_path: Path
) -> None:
    file = write(tmp_path, stated(unit, axis), node[0])
    corners = CORNERS @ node[1][:3, :3].T + node[1][:3, 3]
    robot = corners_of_robot(tmp_path)
    assert robot == pytest.approx(float(unit) * corners, rel=1e-6, abs=1e-6 * float(unit))
    scaled = corners_of_robot(tmp_path, "1 2 -3")
    assert scaled == pytest.approx(float(unit) * corners * [1, 2, -3], rel=1e-6, abs=1e-5)
    assert corners_of_object(tmp_path, file) == pytest.approx(UPRIGHT[axis](corners), abs=1e-6)


def test_the_normals_of_a_scene_file_turn_with_its_faces(tmp_path: Path) -> None:
    file = write(tmp_path, stated("1", "Y_UP"))
    scene = SceneSpec(objects=(ObjectSpec(name="thing", file=str(file)),))
    (part,) = parts_of(ResolvedScene(scene=scene, robots={}))
    assert np.abs(part.model.meshes[0].normals - [0.0, -1.0, 0.0]).max() < 1e-6


@pytest.mark.parametrize(
    ("asset", "unit", "axis", "wrong"),
    [
        ("", 1.0, "Y", ""),
        ("<asset/>", 1.0, "Y", ""),
        ('<asset><unit name="inch" meter=" 2.54e-2 "/></asset>', 0.0254, "Y", ""),
        ("<asset><unit name='cm' meter='0.01'/><up_axis> Z_UP\n</up_axis></asset>", 0.01, "Z", ""),
        ('<asset><up_axis>UPWARDS</up_axis><unit name="m"/></asset>', 1.0, "Y", ""),
        ("<library_x><asset><unit meter='5'/></asset></library_x>", 1.0, "Y", ""),
        ("<!-- <unit meter='5'/> --><asset><unit meter='2'/></asset>", 2.0, "Y", ""),
        *(
            (f'<asset><unit meter="{text}"/></asset>', 1.0, "Y", text)
            for text in ("0", "-1", "nan", "inf", "1e9", "1e-9", "one", "1e999")
        ),
    ],
)
def test_the_unit_is_that_of_the_asset_below_the_root(
    asset: str, unit: float, axis: str, wrong: str, tmp_path: Path
) -> None:
    found = read_collada_asset(write(tmp_path, asset).read_bytes())
    assert (found.unit, found.up_axis, found.invalid_unit) == (unit, axis, wrong)


def test_the_asset_of_a_file_that_is_no_xml_is_the_default() -> None:
    for data in (b"", b"\xff\xfe", b"<COLLADA><asset>", b"no xml"):
        assert read_collada_asset(data).unit == 1.0
