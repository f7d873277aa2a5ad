"""glTF files that say with other means what a plain one says are read as that."""

from __future__ import annotations

import base64
import io
import json
import math
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from uwsim.assets import load_model
from uwsim.assets.mesh import Mesh
from uwsim.errors import AssetError

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 0.5, 0], [0, 0.5, 0]], np.float32)
UV = np.array([[0, 0], [1, 0], [1, 0.5], [0, 0.5]], np.float32)
CORNERS = np.array([0, 1, 2, 0, 2, 3], np.uint16)
COMPONENTS = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "float32": 5126}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


class File:
    """A plate of two triangles, whose parts a test replaces."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.tree: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "bufferViews": [],
            "accessors": [],
            "materials": [{"pbrMetallicRoughness": {}}],
            "nodes": [{"mesh": 0}],
            "scenes": [{"nodes": [0]}],
            "scene": 0,
        }
        self.attributes: dict[str, int] = {}
        self.primitive = {"attributes": self.attributes, "material": 0}
        self.tree["meshes"] = [{"primitives": [self.primitive]}]
        self.primitive["indices"] = self.add(CORNERS)
        self.attributes["POSITION"] = self.add(POINTS)
        self.attributes["TEXCOORD_0"] = self.add(UV)

    @property
    def base(self) -> dict[str, Any]:
        found: dict[str, Any] = self.tree["materials"][0]["pbrMetallicRoughness"]
        return found

    def add_texture(self, **reference: Any) -> None:
        image = io.BytesIO()
        Image.new("RGB", (2, 2), (200, 100, 50)).save(image, "PNG")
        uri = "data:image/png;base64," + base64.b64encode(image.getvalue()).decode()
        self.tree |= {"images": [{"uri": uri}], "textures": [{"source": 0}]}
        self.base["baseColorTexture"] = {"index": 0} | reference

    def view(self, values: np.ndarray[Any, Any], stride: int = 0) -> int:
        rows = values.reshape(len(values), -1)
        place = len(self.data)
        for row in rows:
            cell = row.tobytes()
            self.data += cell + b"\xff" * (stride - len(cell) if stride else 0)
        more = {"byteStride": stride} if stride else {}
        length = {"byteOffset": place, "byteLength": len(self.data) - place}
        self.tree["bufferViews"].append({"buffer": 0, **length, **more})
        self.data += b"\0" * (-len(self.data) % 4)
        return len(self.tree["bufferViews"]) - 1

    def add(self, values: np.ndarray[Any, Any], stride: int = 0, **more: Any) -> int:
        n = 1 if values.ndim == 1 else values.shape[1]
        kind = {"componentType": COMPONENTS[str(values.dtype)], "type": KINDS[n]}
        view = {"bufferView": self.view(values, stride), "count": len(values)}
        self.tree["accessors"].append({**kind, **view, **more})
        return len(self.tree["accessors"]) - 1

    def read(self, folder: Path, suffix: str = ".gltf") -> Mesh:
        path = folder / f"plate{suffix}"
        buffer: dict[str, Any] = {"byteLength": len(self.data)}
        if suffix == ".glb":
            text = json.dumps(self.tree | {"buffers": [buffer]}).encode()
            text += b" " * (-len(text) % 4)
            chunks = struct.pack("<I", len(text)) + b"JSON" + text
            chunks += struct.pack("<I", len(self.data)) + b"BIN\0" + self.data
            path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks)
        else:
            (folder / "plate.bin").write_bytes(self.data)
            buffer["uri"] = "plate.bin"
            path.write_text(json.dumps(self.tree | {"buffers": [buffer]}))
        (mesh,) = load_model(str(path)).meshes
        return mesh


def corners(mesh: Mesh) -> np.ndarray[Any, Any]:
    """Position and texture coordinates of each corner of each triangle, in one order."""
    found = np.hstack([mesh.vertices, mesh.uvs])[np.ravel(mesh.triangles)]
    return found[np.lexsort(np.round(found, 1).T)]


def assert_same(mesh: Mesh, other: Mesh, tolerance: float = 1e-7) -> None:
    np.testing.assert_allclose(corners(mesh), corners(other), rtol=0.0, atol=tolerance)


@pytest.fixture
def plate(tmp_path: Path) -> Mesh:
    """What a plain file gives."""
    return File().read(tmp_path)


@pytest.mark.parametrize("suffix", [".gltf", ".glb"])
@pytest.mark.parametrize("dtype", ["int8", "uint8", "int16", "uint16"])
def test_normalised_numbers_are_those_that_they_stand_for(
    dtype: str, suffix: str, plate: Mesh, tmp_path: Path
) -> None:
    """Positions were 127 to 65 535 times as large, and textures lost."""
    file, largest = File(), np.iinfo(dtype).max
    points = np.round(POINTS * largest).astype(dtype)
    file.attributes["POSITION"] = file.add(points, stride=8, normalized=True)
    uv = np.round(UV * largest).astype(dtype)
    file.attributes["TEXCOORD_0"] = file.add(uv, stride=4, normalized=True)
    file.tree["extensionsRequired"] = ["KHR_mesh_quantization"]
    assert_same(file.read(tmp_path, suffix), plate, 0.6 / largest)


def test_the_least_of_a_normalised_integer_is_minus_one(tmp_path: Path) -> None:
    file = File()
    points = np.array([[-128, 0, 0], [127, 0, 0], [127, -127, 0], [0, 127, 0]], np.int8)
    file.attributes["POSITION"] = file.add(points, stride=4, normalized=True)
    vertices = file.read(tmp_path).vertices
    assert (vertices.min(), vertices.max()) == (-1.0, 1.0)


def test_integers_that_are_not_normalised_are_themselves(plate: Mesh, tmp_path: Path) -> None:
    file = File()
    file.attributes["POSITION"] = file.add((2 * POINTS).astype(np.int16), stride=8)
    file.attributes["TEXCOORD_0"] = file.add((2 * UV).astype(np.uint16))
    file.tree["nodes"] = [{"mesh": 0, "scale": [0.5, 0.5, 0.5]}]
    found = file.read(tmp_path)
    np.testing.assert_allclose(corners(found)[:, :3], corners(plate)[:, :3], atol=1e-7)
    assert (found.uvs.min(), found.uvs.max()) == (0.0, 2.0)  # v is 1 - v, between 0 and 1


@pytest.mark.parametrize("suffix", [".gltf", ".glb"])
@pytest.mark.parametrize("has_base", [True, False])
def test_sparse_numbers_are_read(has_base: bool, suffix: str, tmp_path: Path) -> None:
    file = File()
    places = file.view(np.array([1, 2, 3], np.uint8))
    values = file.view(np.array([[1, 0, 3], [1, 1, 1], [0, 2, 0]], np.float32))
    sparse = {
        "count": 3,
        "indices": {"bufferView": places, "componentType": 5121},
        "values": {"bufferView": values},
    }
    accessor = file.tree["accessors"][file.attributes["POSITION"]]
    accessor["sparse"] = sparse
    expected = POINTS.copy() if has_base else np.zeros_like(POINTS)
    if not has_base:
        del accessor["bufferView"]
    expected[1:] = [[1, 0, 3], [1, 1, 1], [0, 2, 0]]
    found = file.read(tmp_path, suffix).vertices
    assert {tuple(each) for each in found.tolist()} <= {tuple(each) for each in expected.tolist()}
    np.testing.assert_array_equal(found.max(axis=0), [1.0, 2.0, 3.0])


def moved(name: str) -> Callable[[float, float], tuple[float, float]]:
    cos, sin = math.cos(0.3), math.sin(0.3)
    return {
        "scale": lambda u, v: (2 * u, 3 * v),
        "offset": lambda u, v: (u + 0.1, v - 0.2),
        "rotation": lambda u, v: (cos * u + sin * v, -sin * u + cos * v),
    }[name]


@pytest.mark.parametrize(
    ("name", "value"), [("scale", [2, 3]), ("offset", [0.1, -0.2]), ("rotation", 0.3)]
)
def test_the_transform_of_a_texture_is_applied(name: str, value: object, tmp_path: Path) -> None:
    """Counter-clockwise as one sees it: in glTF v points down (KHR_texture_transform)."""
    file = File()
    file.add_texture(extensions={"KHR_texture_transform": {name: value}})
    file.tree["extensionsRequired"] = ["KHR_texture_transform"]
    found = file.read(tmp_path)
    move = moved(name)
    for vertex, uv in zip(found.vertices, found.uvs, strict=True):
        (i,) = np.flatnonzero((vertex == POINTS).all(axis=1))
        u, v = move(*UV[i].tolist())
        np.testing.assert_allclose(uv, [u, 1.0 - v], atol=1e-6)


@pytest.mark.parametrize("way", ["texCoord", "transform"])
def test_the_coordinates_are_those_of_the_base_colour(
    way: str, plate: Mesh, tmp_path: Path
) -> None:
    file = File()
    file.attributes["TEXCOORD_1"] = file.attributes["TEXCOORD_0"]
    file.attributes["TEXCOORD_0"] = file.add(np.zeros_like(UV))
    if way == "texCoord":
        file.add_texture(texCoord=1)
    else:
        file.add_texture(extensions={"KHR_texture_transform": {"texCoord": 1}})
    assert_same(file.read(tmp_path), plate)


def test_a_texture_is_times_its_factor(tmp_path: Path) -> None:
    file = File()
    file.add_texture()
    file.base["baseColorFactor"] = [1.0, 0.5, 0.25, 1.0]
    found = file.read(tmp_path)
    assert found.texture is not None
    np.testing.assert_allclose(found.colour, [1.0, 0.5, 0.25], atol=1 / 255)


@pytest.mark.parametrize("dtype", ["float32", "uint8", "uint16"])
@pytest.mark.parametrize("n", [3, 4])
def test_a_colour_of_vertices_is_read_without_a_material(
    dtype: str, n: int, tmp_path: Path
) -> None:
    file = File()
    del file.primitive["material"]
    largest = 1.0 if dtype == "float32" else float(np.iinfo(dtype).max)
    colours = (np.array([[0.5, 0.25, 0.0, 1.0]] * 4)[:, :n] * largest).astype(dtype)
    stride = 4 if dtype == "uint8" else 0 if dtype == "float32" else 8
    file.attributes["COLOR_0"] = file.add(colours, stride, normalized=dtype != "float32")
    np.testing.assert_allclose(file.read(tmp_path).colour, [0.5, 0.25, 0.0], atol=1.5 / 255)


@pytest.mark.parametrize("has_uvs", [True, False])
def test_without_a_material_it_is_white(has_uvs: bool, tmp_path: Path) -> None:
    file = File()
    del file.primitive["material"]
    if not has_uvs:
        del file.attributes["TEXCOORD_0"]
    assert file.read(tmp_path, ".glb").colour == (1.0, 1.0, 1.0)


def test_a_file_that_is_shorter_than_its_buffer_is_an_error(tmp_path: Path) -> None:
    file = File()
    file.read(tmp_path)
    data = (tmp_path / "plate.bin").read_bytes()
    (tmp_path / "plate.bin").write_bytes(data + b"more")  # a longer one is valid
    load_model(str(tmp_path / "plate.gltf"))
    (tmp_path / "plate.bin").write_bytes(data[:-4])
    text = rf"buffers\[0\].byteLength is {len(data)}; expected at most the {len(data) - 4} bytes of"
    with pytest.raises(AssetError, match=rf"plate.gltf: .*{text} 'plate.bin'"):
        load_model(str(tmp_path / "plate.gltf"))


@pytest.mark.parametrize("written", ["a%20plate.bin", "a plate.bin"])
def test_the_name_of_a_file_may_have_escapes(written: str, plate: Mesh, tmp_path: Path) -> None:
    file = File()
    file.read(tmp_path)
    (tmp_path / "plate.bin").rename(tmp_path / "a plate.bin")
    path = tmp_path / "plate.gltf"
    path.write_text(path.read_text().replace('"plate.bin"', f'"{written}"'))
    (found,) = load_model(str(path)).meshes
    assert_same(found, plate)


@pytest.mark.parametrize("dtype", ["float32", "uint8", "uint16"])
@pytest.mark.parametrize("factor", [None, [0.5, 1.0, 1.0, 1.0]])
def test_a_colour_of_vertices_is_times_that_of_the_material(
    dtype: str, factor: list[float] | None, tmp_path: Path
) -> None:
    file = File()
    colours = np.array([[1, 0, 0], [1, 0, 0], [0, 0, 1], [0, 0, 1]], np.float64)
    if dtype == "float32":
        file.attributes["COLOR_0"] = file.add(colours.astype(np.float32))
    else:
        whole = np.hstack([colours, np.ones((4, 1))]) * np.iinfo(dtype).max
        file.attributes["COLOR_0"] = file.add(whole.astype(dtype), normalized=True)
    if factor is not None:
        file.base["baseColorFactor"] = factor
    red = 0.5 if factor is None else 0.25
    np.testing.assert_allclose(file.read(tmp_path).colour, [red, 0.0, 0.5], atol=1 / 255)


@pytest.mark.parametrize("has_texture", [True, False])
def test_the_diffuse_part_of_specular_and_glossiness_is_the_colour(
    has_texture: bool, tmp_path: Path
) -> None:
    file = File()
    if has_texture:
        file.add_texture()
    diffuse = {"diffuseFactor": [1.0, 0.0, 0.0, 1.0]}
    if has_texture:
        diffuse |= {"diffuseTexture": file.base["baseColorTexture"]}
    name = "KHR_materials_pbrSpecularGlossiness"
    file.tree["materials"] = [{"extensions": {name: diffuse}}]
    file.tree["extensionsRequired"] = [name]
    found = file.read(tmp_path)
    assert (found.texture is not None) is has_texture
    assert tuple(found.colour) == (1.0, 0.0, 0.0)


@pytest.mark.parametrize("has_indices", [True, False])
def test_a_fan_is_read(has_indices: bool, plate: Mesh, tmp_path: Path) -> None:
    file = File()
    file.primitive["mode"] = 6
    if has_indices:
        file.primitive["indices"] = file.add(np.array([0, 1, 2, 3], np.uint16))
    else:
        del file.primitive["indices"]
    assert_same(file.read(tmp_path), plate)


@pytest.mark.parametrize(
    "name",
    ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "X"],
)
def test_an_extension_that_is_required_and_not_read_is_an_error(name: str, tmp_path: Path) -> None:
    file = File()
    file.tree["extensionsRequired"] = ["KHR_materials_unlit", name]
    with pytest.raises(AssetError, match=f"requires the unsupported extension '{name}'"):
        file.read(tmp_path)


@pytest.mark.parametrize(
    "change",
    [
        {"count": 10**9},
        {"count": -4},
        {"count": "4"},
        {"bufferView": 99},
        {"byteOffset": 10**6},
        {"byteOffset": -8},
        {"type": "MAT4"},
        {"componentType": 7},
        {"sparse": {"count": 10**9}},
        {"sparse": []},
        {"sparse": 1},
    ],
)
def test_numbers_that_are_not_there_are_an_error(change: dict[str, Any], tmp_path: Path) -> None:
    file = File()
    file.tree["accessors"][file.attributes["POSITION"]] |= {"normalized": True} | change
    with pytest.raises(AssetError):
        file.read(tmp_path)


def test_the_same_bytes_read_again_and_again_are_bounded(tmp_path: Path) -> None:
    file = File()
    points = np.zeros((2**20, 3), np.int8)
    first = file.add(points, normalized=True)
    accessor = file.tree["accessors"][first]
    file.tree["accessors"] += [accessor] * 30
    more = [
        {"attributes": {"POSITION": first + i}, "indices": file.primitive["indices"]}
        for i in range(30)
    ]
    file.tree["meshes"] = [{"primitives": [file.primitive, *more]}]
    with pytest.raises(AssetError, match="of more than 24000000 elements in all"):
        file.read(tmp_path)
