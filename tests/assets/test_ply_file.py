"""PLY files: text and binary, any polygons, colours and images."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from uwsim.assets.loaders import read_model
from uwsim.assets.mesh import Mesh
from uwsim.errors import AssetError

FORMATS = ("ascii", "binary_little_endian", "binary_big_endian")
CODES = {"uchar": "B", "char": "b", "ushort": "H", "int": "i", "uint32": "I", "float": "f"}
Record = Sequence[float | Sequence[float]]

HOUSE = [(0, 0, 0), (4, 0, 0), (4, 3, 0), (2, 1, 0), (0, 3, 0), (6, 0, 0), (6, 3, 0)]
"""The corners of a polygon with a notch, of a square beside it and of a triangle."""
FACES = [[0, 1, 2, 3, 4], [1, 5, 6, 2], [3, 2, 4]]
AREA = 8.0 + 6.0 + 4.0


def header(kind: str, elements: dict[str, tuple[int, list[str]]], *comments: str) -> bytes:
    lines = ["ply", f"format {kind} 1.0", *(f"comment {each}" for each in comments)]
    for name, (length, properties) in elements.items():
        lines += [f"element {name} {length}", *(f"property {each}" for each in properties)]
    return "\n".join([*lines, "end_header", ""]).encode()


def body(kind: str, properties: list[str], records: Sequence[Record]) -> bytes:
    out = []
    for record in records:
        for value, declared in zip(record, properties, strict=True):
            words = declared.split()
            numbers = value if isinstance(value, Sequence) else [value]
            codes = [CODES[words[1 if words[0] == "list" else 0]]] if words[0] == "list" else []
            codes += [CODES[words[-2]]] * len(numbers)
            flat = [len(numbers), *numbers] if words[0] == "list" else numbers
            if kind == "ascii":
                out.append(" ".join(f"{number:g}" for number in flat) + " ")
            else:
                order = "<" if "little" in kind else ">"
                whole = [n if c == "f" else int(n) for n, c in zip(flat, codes, strict=True)]
                out.append(struct.pack(order + "".join(codes), *whole))
        if kind == "ascii":
            out.append("\n")
    return b"".join(each.encode() if isinstance(each, str) else each for each in out)


def ply(
    kind: str,
    vertices: Sequence[Record] = HOUSE,
    faces: Sequence[Record] = tuple([face] for face in FACES),
    *comments: str,
    of_vertex: Sequence[str] = (),
    of_face: Sequence[str] = ("list uchar int vertex_indices",),
) -> bytes:
    vertex = ["float x", "float y", "float z", *of_vertex]
    elements = {"vertex": (len(vertices), vertex), "face": (len(faces), list(of_face))}
    return (
        header(kind, elements, *comments)
        + body(kind, vertex, vertices)
        + body(kind, list(of_face), faces)
    )


def meshes(folder: Path, data: bytes) -> tuple[Mesh, ...]:
    (folder / "m.ply").write_bytes(data)
    return read_model(folder / "m.ply", name="m").meshes


def area_of(mesh: Mesh) -> float:
    a, b, c = np.moveaxis(mesh.vertices[mesh.triangles], 1, 0)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=-1).sum() / 2)


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("count", ["uchar", "char", "ushort", "int"])
@pytest.mark.parametrize("name", ["vertex_indices", "vertex_index", "corners"])
def test_polygons_of_any_number_of_corners(
    tmp_path: Path, kind: str, count: str, name: str
) -> None:
    data = ply(kind, of_face=[f"list {count} uint32 {name}"])
    (mesh,) = meshes(tmp_path, data)
    assert len(mesh.triangles) == 3 + 2 + 1
    assert area_of(mesh) == pytest.approx(AREA)


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("face", FACES, ids=len)
def test_faces_that_all_have_the_same_number_of_corners(
    tmp_path: Path, kind: str, face: list[int]
) -> None:
    (mesh,) = meshes(tmp_path, ply(kind, faces=[[face], [face]]))
    assert len(mesh.triangles) == 2 * (len(face) - 2)


@pytest.mark.parametrize("kind", FORMATS)
def test_colours_of_faces_count_by_their_triangles(tmp_path: Path, kind: str) -> None:
    red, blue = [255, 0, 0], [0, 0, 255]
    data = ply(
        kind,
        faces=[[FACES[0], *red], [FACES[2], *blue]],
        of_face=["list uchar int vertex_indices", "uchar red", "uchar green", "uchar blue"],
    )
    (mesh,) = meshes(tmp_path, data)
    assert mesh.colour == pytest.approx((0.75, 0.0, 0.25), abs=0.01)


@pytest.mark.parametrize(("number", "value"), [("uchar", 51), ("float", 0.2), ("ushort", 13107)])
@pytest.mark.parametrize("kind", FORMATS)
def test_colours_of_vertices(tmp_path: Path, kind: str, number: str, value: float) -> None:
    data = ply(
        kind,
        vertices=[[*point, value, 0, 5 * value] for point in HOUSE],
        of_vertex=[f"{number} {name}" for name in ("red", "green", "blue")],
    )
    (mesh,) = meshes(tmp_path, data)
    assert mesh.colour == pytest.approx((0.2, 0.0, 1.0), abs=0.01)


@pytest.mark.parametrize("names", ["s t", "u v", "texture_u texture_v"])
@pytest.mark.parametrize("kind", FORMATS)
def test_an_image_by_coordinates_of_the_vertices(tmp_path: Path, kind: str, names: str) -> None:
    Image.new("RGB", (4, 2), (200, 100, 50)).save(tmp_path / "a paint.png")
    data = ply(
        kind,
        [[x, y, z, x / 6, y / 3] for x, y, z in HOUSE],
        [[face] for face in FACES],
        "TextureFile a paint.png",
        of_vertex=[f"float {name}" for name in names.split()],
    )
    (mesh,) = meshes(tmp_path, data)
    assert mesh.texture is not None
    assert tuple(mesh.texture.pixels[0, 0]) == (200, 100, 50)
    assert mesh.uvs[:, 0] == pytest.approx(mesh.vertices[:, 0] / 6, abs=1e-5)
    assert mesh.uvs[:, 1] == pytest.approx(mesh.vertices[:, 1] / 3, abs=1e-5)


@pytest.mark.parametrize("kind", FORMATS)
def test_images_by_coordinates_of_the_faces(tmp_path: Path, kind: str) -> None:
    colours = [(200, 100, 50), (10, 20, 30)]
    for i, colour in enumerate(colours):
        Image.new("RGB", (2, 2), colour).save(tmp_path / f"{i}.png")
    faces = [
        [face, [w for i in face for w in (HOUSE[i][0] / 6, HOUSE[i][1] / 3)], number]
        for face, number in zip(FACES, (1, 0, 1), strict=True)
    ]
    faces[2][1] = []  # a face without them
    data = ply(
        kind,
        HOUSE,
        faces,
        "TextureFile 0.png",
        "TextureFile 1.png",
        of_face=[
            "list uchar int vertex_indices",
            "list uchar float texcoord",
            "int texnumber",
        ],
    )
    found = meshes(tmp_path, data)
    assert [tuple(each.texture.pixels[0, 0]) for each in found if each.texture] == colours
    assert [len(each.triangles) for each in found] == [2, 3 + 1]
    assert found[0].uvs[:, 0] == pytest.approx(found[0].vertices[:, 0] / 6, abs=1e-5)


@pytest.mark.parametrize("ending", [b"\r\n", b"\r"])
def test_other_line_ends(tmp_path: Path, ending: bytes) -> None:
    (mesh,) = meshes(tmp_path, ply("ascii").replace(b"\n", ending))
    assert area_of(mesh) == pytest.approx(AREA)
    head, mark, tail = ply("binary_little_endian").partition(b"end_header\n")
    data = (head + mark).replace(b"\n", ending) + tail
    assert area_of(meshes(tmp_path, data)[0]) == pytest.approx(AREA)


def test_lines_may_have_more_numbers_than_the_header_says(tmp_path: Path) -> None:
    head, mark, tail = ply("ascii").partition(b"end_header\n")
    longer = tail.replace(b" \n", b" 9 1 1\n")
    assert area_of(meshes(tmp_path, head + mark + longer)[0]) == pytest.approx(AREA)
    in_one = tail.replace(b"\n", b" ")
    assert area_of(meshes(tmp_path, head + mark + in_one)[0]) == pytest.approx(AREA)


@pytest.mark.parametrize("kind", FORMATS)
def test_a_file_that_ends_too_early_is_refused_wherever_it_ends(tmp_path: Path, kind: str) -> None:
    data = ply(kind)
    whole = len(data.rstrip()) if kind == "ascii" else len(data)
    for end in range(0, whole - 1, 3):
        with pytest.raises(AssetError, match=r"m\.ply"):
            meshes(tmp_path, data[:end])


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (b"property list uchar int", b"property list float int"),
        (b"property float x", b"property single x"),
        (b"element face 3", b"element face three"),
        (b"element face 3", b"element face 99999999999"),
        (b"format ascii 1.0", b"format text 1.0"),
        (b"5 0 1 2", b"-5 0 1 2"),
        (b"5 0 1 2", b"5 0 1 7"),
        (b"5 0 1 2", b"5 0 1 -1"),
        (b"5 0 1 2", b"5e9 0 1 2"),
        (b"5 0 1 2", b"nan 0 1 2"),
        (b"4 3 0", b"4 x 0"),
    ],
)
def test_wrong_files_are_refused(tmp_path: Path, wrong: bytes, message: bytes) -> None:
    data = ply("ascii")
    assert wrong in data
    with pytest.raises(AssetError, match=r"m\.ply"):
        meshes(tmp_path, data.replace(wrong, message))
