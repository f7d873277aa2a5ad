"""Mesh files of third parties: files they name lie in their folder, sizes are limited."""

from __future__ import annotations

import base64
import json
import struct
import time
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from uwsim.assets import load_model
from uwsim.assets.loaders import by_trimesh, collada_limits, materials
from uwsim.errors import AssetError

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()
FACES = np.array([0, 1, 2], "<u4").tobytes()


def gltf(**changes: Any) -> dict[str, Any]:
    data = "data:application/octet-stream;base64," + base64.b64encode(POINTS + FACES).decode()
    tree: dict[str, Any] = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": data, "byteLength": 48}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 36},
            {"buffer": 0, "byteOffset": 36, "byteLength": 12},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }
    return tree | changes


def written(folder: Path, tree: dict[str, Any]) -> Path:
    path = folder / "model.gltf"
    path.write_text(json.dumps(tree))
    return path


def png(folder: Path, name: str, wide: int, high: int) -> Path:
    """Write a grey image row by row: a large one takes no memory here."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        checksum = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + checksum

    packer = zlib.compressobj(9)
    row = bytes(wide + 1)
    rows = b"".join(packer.compress(row) for _ in range(high)) + packer.flush()
    path = folder / name
    head = struct.pack(">IIBBBBB", wide, high, 8, 0, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")
    )
    return path


def obj(folder: Path, material: str, image: str = "p.png") -> Path:
    path = folder / "m.obj"
    path.write_text(f"mtllib {material}\n{TRIANGLE}")
    (folder / "m.mtl").write_text(f"newmtl m\nKd 1 0 0\nmap_Kd {image}\n")
    return path


@pytest.fixture
def inside(tmp_path: Path) -> Path:
    """Make a folder, with secrets beside it."""
    (tmp_path / "secret.mtl").write_text("newmtl m\nKd 0 1 0\n")
    (tmp_path / "secret.bin").write_bytes(POINTS + FACES)
    Image.new("RGB", (4, 4), (0, 255, 0)).save(tmp_path / "secret.png")
    folder = tmp_path / "model"
    folder.mkdir()
    return folder


@pytest.mark.parametrize("way", ["{}/secret", "../secret", "x/../../secret", "link"])
@pytest.mark.parametrize("suffix", [".mtl", ".png", ".bin"])
def test_what_a_mesh_names_stays_in_its_folder(inside: Path, way: str, suffix: str) -> None:
    name = way.format(inside.parent) + suffix
    (inside / f"link{suffix}").symlink_to(inside.parent / f"secret{suffix}")
    if suffix == ".bin":
        path = written(inside, gltf(buffers=[{"uri": name, "byteLength": 48}]))
    else:
        path = obj(inside, *((name,) if suffix == ".mtl" else ("m.mtl", name)))
    with pytest.raises(AssetError, match="outside its folder; --data-path adds a folder") as e:
        load_model(path.name, named_by=path)
    assert str(e.value).startswith(f"{path}: names the file '{name}'")


@pytest.mark.parametrize("name", ["../secret.png", "link.png"])
def test_a_data_path_opens_a_folder(inside: Path, name: str) -> None:
    (inside / "link.png").symlink_to(inside.parent / "secret.png")
    path = obj(inside, "m.mtl", name)
    model = load_model(path.name, named_by=path, data_path=(inside.parent,))
    assert model.meshes[0].texture is not None


def test_a_path_of_the_authors_machine_is_looked_for_by_its_last_part(inside: Path) -> None:
    Image.new("RGB", (4, 4), (255, 0, 0)).save(inside / "skin.png")
    for name in ("/home/author/skin.png", "C:\\models\\skin.png", "../gone/skin.png"):
        texture = load_model(str(obj(inside, "m.mtl", name))).meshes[0].texture
        assert texture is not None
        assert texture.pixels[0, 0].tolist() == [255, 0, 0]


@pytest.mark.parametrize("name", ["/home/author/skin.png", "../textures/skin.png", "C:\\skin.png"])
def test_a_mesh_whose_image_is_nowhere_has_the_colour_of_its_material(
    inside: Path, name: str
) -> None:
    (mesh,) = load_model(str(obj(inside, "m.mtl", name))).meshes
    assert mesh.texture is None
    assert mesh.colour == (1.0, 0.0, 0.0)
    path = inside / "m.obj"
    path.write_text(path.read_text().replace("m.mtl", "/home/author/m.mtl"))
    (inside / "m.mtl").unlink()
    assert load_model(str(path)).n_triangles == 1


@pytest.mark.parametrize("name", ["/dev/zero", "pipe"])
def test_a_device_is_not_read_for_a_buffer(inside: Path, name: str) -> None:
    (inside / "pipe").symlink_to("/dev/zero")
    path = written(inside, gltf(buffers=[{"uri": name, "byteLength": 48}]))
    with pytest.raises(AssetError, match="outside its folder"):
        load_model(str(path))


def test_an_image_of_a_few_bytes_may_not_fill_the_memory(inside: Path) -> None:
    png(inside, "p.png", 9000, 9000)
    start = time.process_time()
    with pytest.raises(AssetError, match=r"an image has 9000 x 9000 pixels; at most 67 million"):
        load_model(str(obj(inside, "m.mtl")))
    blob = base64.b64encode((inside / "p.png").read_bytes()).decode()
    tree = gltf(
        images=[{"uri": f"data:image/png;base64,{blob}"}],
        textures=[{"source": 0}],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    )
    tree["meshes"][0]["primitives"][0]["material"] = 0
    with pytest.raises(AssetError, match=r"an image has 9000 x 9000 pixels; at most 67 million"):
        load_model(str(written(inside, tree)))
    assert time.process_time() - start < 2.0


def test_an_image_too_large_to_be_opened_is_not_left_out_in_silence(inside: Path) -> None:
    png(inside, "p.png", 20_000, 10_000)
    with pytest.raises(AssetError, match=r"p\.png: an image of too many pixels; at most 67"):
        load_model(str(obj(inside, "m.mtl")))


def test_images_are_bounded_in_all_too(inside: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(materials, "MAX_TOTAL_PIXELS", 300)
    Image.new("RGB", (10, 10)).save(inside / "p.png")
    text = "".join(f"newmtl m{i}\nmap_Kd p.png\n" for i in range(4))
    (inside / "m.obj").write_text(
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
        + "".join(f"usemtl m{i}\nf 1/1 2/2 3/3\n" for i in range(4))
    )
    (inside / "m.mtl").write_text(text)
    with pytest.raises(AssetError, match="an image has 10 x 10 pixels"):
        load_model(str(inside / "m.obj"))


def test_an_image_that_is_a_program_is_not_run(inside: Path) -> None:
    (inside / "p.png").write_bytes(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n%%EOF\n")
    with pytest.raises(AssetError, match="an image is EPS; expected BMP, DDS"):
        load_model(str(obj(inside, "m.mtl")))


def chain(n: int) -> list[dict[str, Any]]:
    return [{"mesh": 0, "children": [i + 1]} for i in range(n - 1)] + [{"mesh": 0}]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"nodes": [{"mesh": 0}] * 20_001}, "has 20001 nodes; at most 20000 are read"),
        ({"nodes": chain(20_000)}, "its nodes form a loop, or a chain of more than 100"),
        ({"nodes": [{"mesh": 0, "children": [0]}]}, "its nodes form a loop, or a chain"),
        (
            {"nodes": [{"mesh": 0, "children": [0, 1]}, {"children": [0, 1]}]},
            "its nodes form a loop, or a chain",
        ),
        (
            {"nodes": [{"mesh": 0, "children": [0] * 20_001}]},
            "its nodes have more than 20000 children",
        ),
        ({"meshes": [{"primitives": [{}] * 20_001}]}, "has 20001 primitives; at most 20000"),
        (
            {"accessors": [{"componentType": 5126, "count": 10**9, "type": "VEC3"}]},
            "has accessors of 1000000000 elements; at most 24000000 are read",
        ),
        (
            {"accessors": [{"componentType": 5126, "count": 10**7, "type": "VEC3"}] * 2},
            "has accessors of 20000000 elements",
        ),
    ],
)
def test_a_small_header_cannot_ask_for_endless_work(
    changes: dict[str, Any], said: str, inside: Path
) -> None:
    start = time.process_time()
    with pytest.raises(AssetError, match=said):
        load_model(str(written(inside, gltf(**changes))))
    assert time.process_time() - start < 2.0


def test_chains_and_diamonds_of_nodes_are_read(inside: Path) -> None:
    assert load_model(str(written(inside, gltf(nodes=chain(100))))).n_triangles == 100


def test_instances_are_counted_before_they_are_made(
    inside: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(by_trimesh, "MAX_TRIANGLES", 30)
    nodes = [{"mesh": 0}] * 31
    tree = gltf(nodes=nodes, scenes=[{"nodes": list(range(31))}])
    with pytest.raises(AssetError, match="31 triangles; expected at most 30"):
        load_model(str(written(inside, tree)))


@pytest.mark.parametrize("suffix", [".obj", ".stl", ".dae", ".ply"])
def test_text_is_bounded_before_it_is_read(
    inside: Path, suffix: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(by_trimesh, "MAX_TEXT_BYTES", 1000)
    start = "ply\nformat ascii 1.0\n" if suffix == ".ply" else "solid x\n"
    (inside / f"x{suffix}").write_text(start + "v 0 0 0\n" * 200)
    with pytest.raises(AssetError, match=r"is text of more than 0 MiB; write it as"):
        load_model(str(inside / f"x{suffix}"))


def dae(nodes: str, library: str = "") -> str:
    """Collada: one triangle, of which the nodes of a scene hold instances."""
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries> <geometry id="g"> <mesh>
  <source id="s"> <float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
    <technique_common> <accessor source="#a" count="3" stride="3"> <param name="X" type="float"/>
      <param name="Y" type="float"/> <param name="Z" type="float"/> </accessor>
    </technique_common> </source>
  <vertices id="v"> <input semantic="POSITION" source="#s"/> </vertices>
  <triangles count="1"> <input semantic="VERTEX" source="#v" offset="0"/> <p>0 1 2</p> </triangles>
</mesh> </geometry> </library_geometries>
<library_nodes> {library} </library_nodes>
<library_visual_scenes> <visual_scene id="scene"> {nodes} </visual_scene> </library_visual_scenes>
<scene> <instance_visual_scene url="#scene"/> </scene> </COLLADA>"""


TRIANGLE_NODE = '<node id="n0"> <instance_geometry url="#g"/> </node>'


def instances_of_instances(n: int, each: int) -> str:
    """Nodes n1, n2, ...: each so many instances of the one before."""
    nodes = (
        f'<node id="n{i}">' + f'<instance_node url="#n{i - 1}"/>' * each + "</node>"
        for i in range(1, n + 1)
    )
    return TRIANGLE_NODE + "".join(nodes)


@pytest.mark.parametrize(
    ("nodes", "library", "said"),
    [
        (
            '<node> <instance_node url="#n9"/> </node>',
            instances_of_instances(9, 10),
            "its nodes have .* at most 20000 are read",
        ),
        (
            '<node> <instance_node url="#n101"/> </node>',
            instances_of_instances(101, 1),
            "its nodes form a loop, or a chain of more than 100",
        ),
        ('<node id="x"> <instance_node url="#x"/> </node>', "", "its nodes form a loop"),
        ("<node>" * 5000 + "</node>" * 5000, "", "its nodes form a loop, or a chain"),
    ],
)
def test_nodes_of_a_collada_file_cannot_stand_for_endless_work(
    nodes: str, library: str, said: str, inside: Path
) -> None:
    (inside / "x.dae").write_text(dae(nodes, library))
    start = time.process_time()
    with pytest.raises(AssetError, match=said):
        load_model(str(inside / "x.dae"))
    assert time.process_time() - start < 2.0


@pytest.mark.parametrize("n", [3, 8])
def test_so_are_those_of_a_skin(n: int, inside: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    nodes = "<node>" + '<instance_controller url="#c"/>' * n + "</node>"
    skin = '<controller id="c"><skin source="#g"/></controller>'
    text = dae(nodes).replace(
        "<library_nodes>", f"<library_controllers>{skin}</library_controllers><library_nodes>"
    )
    (inside / "x.dae").write_text(text)
    monkeypatch.setattr(collada_limits, "MAX_TEXT", n * len("0 1 2"))
    assert load_model(str(inside / "x.dae")).n_triangles == n
    monkeypatch.setattr(collada_limits, "MAX_TEXT", n * len("0 1 2") - 1)
    (inside / "y.dae").write_text(text)
    with pytest.raises(AssetError, match=r"its instances have .* MiB of triangles"):
        load_model(str(inside / "y.dae"))


def test_triangles_of_a_collada_file_are_counted_for_each_instance(
    inside: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    nodes, library = '<node> <instance_node url="#n2"/> </node>', instances_of_instances(2, 5)
    (inside / "x.dae").write_text(dae(nodes, library))
    assert load_model(str(inside / "x.dae")).n_triangles == 25
    monkeypatch.setattr(collada_limits, "MAX_TEXT", 24 * len("0 1 2"))
    (inside / "y.dae").write_text(dae(nodes, library))
    with pytest.raises(AssetError, match=r"its instances have .* MiB of triangles"):
        load_model(str(inside / "y.dae"))
