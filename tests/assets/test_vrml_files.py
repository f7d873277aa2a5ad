"""VRML 97 and X3D files: shapes, transforms, materials, limits, and errors with their line."""

from __future__ import annotations

import gzip
import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from uwsim.assets import load_model
from uwsim.assets.mesh import Model
from uwsim.errors import AssetError

HEAD = "#VRML V2.0 utf8\n"
BOX = "Shape { appearance Appearance { material Material { diffuseColor 0.2 0.4 0.6 } } "
BOX += "geometry Box { size 1 2 3 } }"
SQUARE = """Shape { geometry IndexedFaceSet {
  coord Coordinate { point [ 0 0 0, 1 0 0, 1 0 -1, 0 0 -1 ] } # a comment
  coordIndex [ 0, 1, 2, 3, -1 ] %s } %s }"""


def read(folder: Path, text: str | bytes, name: str = "a.wrl") -> Model:
    """Read a file with a text."""
    path = folder / name
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return load_model(str(path))


def volume(model: Model) -> float:
    """Return the volume inside all triangles."""
    corners = np.concatenate([mesh.vertices[mesh.triangles] for mesh in model.meshes])
    a, b, c = (corners[:, k].astype(float) for k in range(3))
    return float(np.sum(a * np.cross(b, c))) / 6.0


def test_vertical_axis_becomes_z(tmp_path: Path) -> None:
    model = read(tmp_path, HEAD + BOX)
    assert model.box.upper == pytest.approx((0.5, 1.5, 1.0))  # y of the file is up
    assert volume(model) == pytest.approx(6.0)
    assert model.meshes[0].colour == pytest.approx((0.2, 0.4, 0.6), abs=0.01)


def test_transform_is_that_of_the_standard(tmp_path: Path) -> None:
    """Compare with T C R SR S SR^-1 C^-1 of a point."""
    fields = (
        "translation 1 2 3 center 0.5 0 0 rotation 0 1 0 0.7 scale 2 1 0.5 "
        "scaleOrientation 0 0 1 0.3"
    )
    point = "PointSet"
    shape = (
        "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 1 1 1, 2 1 1, 1 2 1 ] } "
        "coordIndex [ 0 1 2 -1 ] } }"
    )
    model = read(tmp_path, f"{HEAD} Transform {{ {fields} children [ {shape} ] }} # {point}")

    def turn(axis: int, angle: float) -> np.ndarray:
        c, s = math.cos(angle), math.sin(angle)
        i, j = ((1, 2), (2, 0), (0, 1))[axis]
        matrix = np.eye(3)
        matrix[i, i] = matrix[j, j] = c
        matrix[i, j], matrix[j, i] = -s, s
        return matrix

    centre = np.array([0.5, 0.0, 0.0])
    stretch = turn(2, 0.3) @ np.diag([2.0, 1.0, 0.5]) @ turn(2, -0.3)
    expected = []
    for corner in ([1, 1, 1], [2, 1, 1], [1, 2, 1]):
        x, y, z = turn(1, 0.7) @ stretch @ (np.array(corner) - centre) + centre + [1, 2, 3]
        expected.append([x, -z, y])
    vertices = model.meshes[0].vertices
    for corner in expected:
        assert np.abs(vertices - corner).max(axis=1).min() < 1e-6


@pytest.mark.parametrize(
    ("geometry", "expected"),
    [
        ("Sphere { radius 2 }", 4 / 3 * math.pi * 8),
        ("Cylinder { radius 1 height 3 }", math.pi * 3),
        ("Cone { bottomRadius 1 height 3 }", math.pi),
    ],
)
def test_solids_have_their_volume(tmp_path: Path, geometry: str, expected: float) -> None:
    model = read(tmp_path, f"{HEAD} Shape {{ geometry {geometry} }}")
    assert volume(model) == pytest.approx(expected, rel=0.02)


def test_cone_points_up(tmp_path: Path) -> None:
    vertices = read(tmp_path, f"{HEAD} Shape {{ geometry Cone {{ }} }}").meshes[0].vertices
    top = vertices[vertices[:, 2] > 0.99]
    assert np.abs(top[:, :2]).max() < 1e-6


def test_faces_are_seen_from_the_side_of_their_order(tmp_path: Path) -> None:
    up = read(tmp_path, HEAD + SQUARE % ("", ""))
    down = read(tmp_path, HEAD + SQUARE % ("ccw FALSE", ""), "b.wrl")
    assert up.meshes[0].normals[:, 2].min() > 0.99
    assert down.meshes[0].normals[:, 2].max() < -0.99


def test_node_is_used_again_by_its_name(tmp_path: Path) -> None:
    text = f"{HEAD} DEF B {BOX} Transform {{ translation 10 0 0 children USE B }}"
    model = read(tmp_path, text)
    assert model.box.upper[0] == pytest.approx(10.5)
    assert volume(model) == pytest.approx(12.0)


def test_mirrored_node_keeps_its_outside(tmp_path: Path) -> None:
    model = read(tmp_path, f"{HEAD} Transform {{ scale -1 1 1 children [ {BOX} ] }}")
    assert volume(model) == pytest.approx(6.0)


def test_image_is_read_with_its_coordinates(tmp_path: Path) -> None:
    Image.new("RGB", (2, 2), (200, 10, 30)).save(tmp_path / "tile.png")
    coordinates = "texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] } "
    appearance = 'appearance Appearance { texture ImageTexture { url "tile.png" } }'
    model = read(tmp_path, HEAD + SQUARE % (coordinates, appearance))
    mesh = model.meshes[0]
    assert mesh.texture is not None
    assert mesh.texture.pixels[0, 0].tolist() == [200, 10, 30]
    corner = np.abs(mesh.vertices - [1, 1, 0]).max(axis=1).argmin()
    assert mesh.uvs[corner].tolist() == [1.0, 1.0]


def test_switch_and_level_of_detail_show_one_child(tmp_path: Path) -> None:
    other = "Shape { geometry Box { size 9 9 9 } }"
    switch = f"Switch {{ whichChoice 1 choice [ {other} {BOX} ] }}"
    text = f"{HEAD} {switch} LOD {{ level [ {BOX} {other} ] }}"
    assert read(tmp_path, text).box.upper[2] == pytest.approx(1.0)


def test_elevation_grid_is_a_terrain(tmp_path: Path) -> None:
    grid = "ElevationGrid { xDimension 3 zDimension 2 xSpacing 2 height [ 0 1 2 0 1 2 ] }"
    model = read(tmp_path, f"{HEAD} Shape {{ geometry {grid} }}")
    assert model.box.upper == pytest.approx((4.0, 0.0, 2.0))
    assert model.box.lower == pytest.approx((0.0, -1.0, 0.0))
    assert model.meshes[0].normals[:, 2].min() > 0.0


def test_what_is_not_read_is_a_remark(tmp_path: Path) -> None:
    text = f"""{HEAD} PROTO Pump [ field SFFloat size 1 ] {{ Group {{ }} }}
    Pump {{ size 2 }} Viewpoint {{ position 0 0 5 description "start" }}
    DEF S Script {{ field SFBool open FALSE url "javascript: function f() {{ }}" }}
    Shape {{ geometry Text {{ string [ "a", "b" ] }} }}
    DEF T TimeSensor {{ loop TRUE }} ROUTE T.fraction TO S.set {BOX}"""
    model = read(tmp_path, text)
    assert volume(model) == pytest.approx(6.0)
    assert [remark.rpartition(": ")[2] for remark in model.remarks] == [
        "1 Pump is left out",
        "1 Text is left out",
    ]


def test_compressed_file_is_read_up_to_the_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert volume(read(tmp_path, gzip.compress((HEAD + BOX).encode()))) == pytest.approx(6.0)
    monkeypatch.setattr("uwsim.assets.loaders.scene_graphs.vrml_text.MAX_TEXT_BYTES", 2**16)
    with pytest.raises(AssetError, match="more than"):
        read(tmp_path, gzip.compress(HEAD.encode() + b" " * 2**20), "b.wrl")


@pytest.mark.parametrize(("content", "message"), [(BOX, "more than"), ("", "has no triangles")])
def test_a_tree_of_uses_stays_below_the_limit(tmp_path: Path, content: str, message: str) -> None:
    lines = [HEAD, f"DEF N0 Group {{ children [ {content} ] }}"]
    for i in range(1, 9):
        references = f"USE N{i - 1} " * 10
        lines.append(f"DEF N{i} Group {{ children [ {references} ] }}")
    with pytest.raises(AssetError, match=message):
        read(tmp_path, "\n".join(lines))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Group { }", "line 1: begins with 'Group { }'"),
        (f"{HEAD}\nGroup {{ children [ Shape {{", "line 3: Shape has no end"),
        (f"{HEAD}\nShape {{ geometry Box", "line 3: found 'Box'; expected a node"),
        (f"{HEAD}\n\nShape {{ geometry IndexedFaceSet {{ coordIndex [ 0 1 2 ] }} }}", "line 4"),
        (f"{HEAD}Shape {{ geometry Box {{ size 1 1 1 }} }} ]", "found ']'"),
        (f'{HEAD} WorldInfo {{ title "a }}', "a text has no end"),
        (f"{HEAD} Group {{ }}", "has no triangles"),
        (HEAD + "Group { children [ " * 300 + "] }" * 300, "in each other"),
    ],
)
def test_damaged_files_are_errors_with_their_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(AssetError) as error:
        read(tmp_path, text)
    assert message in str(error.value)
    assert len(str(error.value).splitlines()) == 1


X3D = """<?xml version="1.0"?>
<X3D version="3.3"> <head/> <Scene>
  <Transform translation="0 0 10"> <Shape DEF="b"> <Appearance> <Material diffuseColor="1 0 0"/>
    </Appearance> <Box size="1 2 3"/> </Shape> </Transform>
  <Shape USE="b"/>
  <Shape> <IndexedFaceSet coordIndex="0 1 2 -1" solid="false">
    <Coordinate point="0 0 0, 1 0 0, 0 1 0"/>
    </IndexedFaceSet> </Shape>
</Scene> </X3D>"""


def test_x3d_is_read_as_vrml(tmp_path: Path) -> None:
    model = read(tmp_path, X3D, "a.x3d")
    assert model.n_triangles == 12 + 12 + 1
    assert model.box.lower == pytest.approx((-0.5, -11.5, -1.0))
    assert model.meshes[0].colour == pytest.approx((1.0, 0.0, 0.0))


def test_x3d_in_classic_encoding_is_read(tmp_path: Path) -> None:
    text = "#X3D V3.2 utf8\nPROFILE Interchange\nMETA 'a' 'b'\n".replace("'", '"')
    assert volume(read(tmp_path, text + BOX, "a.x3dv")) == pytest.approx(6.0)


def test_entities_of_x3d_are_refused(tmp_path: Path) -> None:
    text = '<!DOCTYPE X3D [\n<!ENTITY a "aaaa">]>\n' + X3D.partition("?>")[2]
    with pytest.raises(AssetError, match="line 2: entities are not read"):
        read(tmp_path, text, "a.x3d")
