import random
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from uwsim.assets.loaders import MESH_FORMATS, read_model
from uwsim.errors import AssetError

COLLADA = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="pa" count="9">0 0 0 1 0 0 0 2 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""


def written(folder: Path, suffix: str) -> Path:
    """A box of 1 x 2 x 3 m (a triangle for Collada, which trimesh does not write)."""
    path = folder / f"box{suffix}"
    if suffix == ".dae":
        path.write_text(COLLADA)
    else:
        trimesh.creation.box((1.0, 2.0, 3.0)).export(path)
    return path


@pytest.mark.parametrize("suffix", [".glb", ".obj", ".stl", ".ply"])
def test_a_box_comes_back_as_a_box_with_sharp_edges(tmp_path: Path, suffix: str) -> None:
    model = read_model(written(tmp_path, suffix), name="box")
    assert model.box.upper == pytest.approx((0.5, 1.0, 1.5))
    (mesh,) = model.meshes
    assert len(mesh.triangles) == 12
    assert np.allclose(np.abs(mesh.normals).max(axis=1), 1.0)
    assert len(model.sha256) == 64


def test_collada_is_read(tmp_path: Path) -> None:
    assert read_model(written(tmp_path, ".dae"), name="x").box.upper == (1.0, 2.0, 0.0)


def test_an_image_travels_with_an_obj_file(tmp_path: Path) -> None:
    Image.new("RGB", (4, 2), (200, 100, 50)).save(tmp_path / "paint.png")
    (tmp_path / "m.mtl").write_text("newmtl m\nKd 0.8 0.8 0.8\nmap_Kd paint.png\n")
    (tmp_path / "m.obj").write_text(
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
    )
    (mesh,) = read_model(tmp_path / "m.obj", name="m").meshes
    assert mesh.texture is not None
    assert mesh.texture.pixels.shape == (2, 4, 3)
    assert tuple(mesh.texture.pixels[0, 0]) == (200, 100, 50)
    at = {tuple(v): tuple(uv) for v, uv in zip(mesh.vertices, mesh.uvs, strict=True)}
    assert at[(1.0, 0.0, 0.0)] == (1.0, 0.0)
    assert at[(0.0, 1.0, 0.0)] == (0.0, 1.0)


@pytest.mark.parametrize("name", ["paint.png", "old paint.png", "-s 1 1 1.png"])
@pytest.mark.parametrize(
    "options", ["-s 1 1 1", "-clamp on", "-o 0.5 -s 2 2 1 -blendu off", "-mm 0 1", "-bm 0.5 -t 1"]
)
def test_an_image_may_have_options_before_its_name(options: str, name: str, tmp_path: Path) -> None:
    Image.new("RGB", (4, 2), (200, 100, 50)).save(tmp_path / name)
    line = name if name.startswith("-") else f"{options} {name}"
    (tmp_path / "m.mtl").write_text(f"newmtl m\nKd 0.8 0.8 0.8\nmap_Kd {line}\n")
    (tmp_path / "m.obj").write_text(
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
    )
    (mesh,) = read_model(tmp_path / "m.obj", name="m").meshes
    assert mesh.texture is not None
    assert tuple(mesh.texture.pixels[0, 0]) == (200, 100, 50)


def test_a_textured_glb_keeps_its_image_the_right_way_up(tmp_path: Path) -> None:
    image = Image.new("RGB", (2, 2), (255, 0, 0))
    image.putpixel((0, 1), (0, 255, 0))  # bottom left
    box = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], process=False)
    box.visual = trimesh.visual.TextureVisuals(
        uv=[[0, 0], [1, 0], [0, 1]],
        material=trimesh.visual.material.PBRMaterial(baseColorTexture=image),
    )
    box.export(tmp_path / "t.glb")
    (mesh,) = read_model(tmp_path / "t.glb", name="t").meshes
    assert mesh.texture is not None
    assert tuple(mesh.texture.pixels[1, 0]) == (0, 255, 0)
    origin = int(np.argmin(np.abs(mesh.vertices).sum(axis=1)))
    assert tuple(mesh.uvs[origin]) == (0.0, 0.0)


def test_a_ball_is_smooth_and_a_large_one_is_not_simplified(tmp_path: Path) -> None:
    trimesh.creation.icosphere(4, 1.0).export(tmp_path / "ball.stl")
    full = read_model(tmp_path / "ball.stl", name="ball")
    assert full.n_triangles == 5120
    (mesh,) = full.meshes
    assert np.allclose(mesh.normals, mesh.vertices, atol=0.02)


def test_a_changed_file_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "x.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    first = read_model(path, name="x")
    assert read_model(path, name="x") is first
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n")
    assert read_model(path, name="x").n_triangles == 2


FACES = b"coordIndex [ 0 1 2 -1 ] coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] }"
VRML_SAMPLES = {
    ".wrl": b"#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { " + FACES + b" } }\n",
    ".x3dv": b"#X3D V3.2 utf8\nShape { geometry IndexedFaceSet { " + FACES + b" } }\n",
    ".x3d": b"<X3D> <Scene> <Shape> <IndexedFaceSet coordIndex='0 1 2 -1'> <Coordinate "
    b"point='0 0 0 1 0 0 0 1 0'/> </IndexedFaceSet> </Shape> </Scene> </X3D>",
}
"""A file of each format that trimesh cannot write."""


@pytest.mark.parametrize("suffix", MESH_FORMATS)
def test_broken_files_are_refused_cleanly(tmp_path: Path, suffix: str) -> None:
    if suffix == ".gltf":
        whole = b'{"asset":{"version":"2.0"},"buffers":[{"uri":"http://nowhere.invalid/x.bin"}]}'
    elif suffix in VRML_SAMPLES:
        whole = VRML_SAMPLES[suffix]
    else:
        whole = written(tmp_path, suffix).read_bytes()
    draw = random.Random(suffix)
    for k in range(30):
        broken = bytearray(whole[: draw.randrange(len(whole))] if k % 2 else whole)
        for _ in range(min(len(broken), 8)):
            broken[draw.randrange(len(broken))] = draw.randrange(256)
        path = tmp_path / f"broken{k}{suffix}"
        path.write_bytes(broken)
        try:
            model = read_model(path, name="broken")
        except AssetError as refused:
            said = str(refused)
        else:  # a byte that did no harm
            assert all(np.isfinite(mesh.normals).all() for mesh in model.meshes)
            continue
        assert str(path) in said


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("empty.obj", ""),
        ("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
        ("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
        ("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("far.obj", "v 1e30 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("lost.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
        ("huge.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\n"
                     "property float y\nproperty float z\nend_header\n0 0 0\n"),
        ("bomb.dae", '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]>' + COLLADA[21:]),
        ("strange.xyz", "0 0 0"),
    ],
)  # fmt: skip
def test_files_without_usable_triangles_are_refused(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(AssetError, match=name):
        read_model(tmp_path / name, name=name)


def test_a_fan_of_very_many_faces_does_not_cost_their_square(tmp_path: Path) -> None:
    n = 20000
    turn = np.linspace(0, 6.28, n)
    rim = "\n".join(f"v {x:.6f} {y:.6f} 0" for x, y in zip(np.cos(turn), np.sin(turn), strict=True))
    faces = "\n".join(f"f 1 {k + 2} {k + 3}" for k in range(n - 1))
    (tmp_path / "fan.obj").write_text(f"v 0 0 0\n{rim}\n{faces}\n")
    (mesh,) = read_model(tmp_path / "fan.obj", name="fan").meshes
    assert np.allclose(mesh.normals[:, 2], 1.0)


TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
ASCII_STL = """solid {0}
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid
"""
ASCII_PLY = """ply
format ascii 1.0
comment {0}
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
"""


@pytest.mark.parametrize("word", ["bo\u00eete", "bo\u00eete".encode().decode("latin-1"), "box"])
@pytest.mark.parametrize(
    ("suffix", "text"),
    [(".obj", "# {0}\n" + TRIANGLE), (".stl", ASCII_STL), (".ply", ASCII_PLY)],
)
def test_a_comment_in_latin_1_does_not_spoil_a_mesh(
    suffix: str, text: str, word: str, tmp_path: Path
) -> None:
    file = tmp_path / f"mesh{suffix}"
    file.write_bytes(text.format(word).encode("latin-1"))
    assert read_model(file, name="m").box.upper == (1.0, 1.0, 0.0)


def test_comments_behind_numbers_are_none_of_them(tmp_path: Path) -> None:
    file = tmp_path / "mesh.obj"
    lines = ["v 0 0 0 # a", "v 1 0 0#b", "v 0 1 0\t# c # d", "# whole", "f 1 2 3 # face"]
    file.write_text("\n".join(lines) + "\n")
    assert read_model(file, name="m").box.upper == (1.0, 1.0, 0.0)


def test_a_binary_mesh_with_a_header_in_latin_1_is_read(tmp_path: Path) -> None:
    file = written(tmp_path, ".stl")
    data = file.read_bytes()
    file.write_bytes("Bo\u00eete".encode("latin-1").ljust(80) + data[80:])
    assert read_model(file, name="m").box.upper == pytest.approx((0.5, 1.0, 1.5))


def test_materials_in_latin_1_keep_their_colour(tmp_path: Path) -> None:
    (tmp_path / "m.mtl").write_bytes("# peint\u00e9\nnewmtl m\nKd 1 0 0\n".encode("latin-1"))
    (tmp_path / "m.obj").write_text(f"mtllib m.mtl\nusemtl m\n{TRIANGLE}")
    assert read_model(tmp_path / "m.obj", name="m").meshes[0].colour == (1.0, 0.0, 0.0)
