"""Errors of glTF files name the entry at fault, in one line without Python's exceptions."""

from __future__ import annotations

import json
import random
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.assets.gltf_plates import Plates, colour_image
from uwsim.assets import load_model
from uwsim.errors import AssetError

Tree = dict[str, Any]


def write_plate(path: Path) -> Path:
    """Write a valid plate with a texture and a normal map."""
    plates = Plates()
    base = plates.texture(colour_image(200, 100, 50))
    normal = plates.texture(colour_image(128, 128, 255))
    plates.plate({"pbrMetallicRoughness": {"baseColorTexture": base}, "normalTexture": normal})
    return plates.write(path)


def read_json(path: Path) -> tuple[Tree, bytes]:
    """Return the JSON of a .glb and what is behind it."""
    data = path.read_bytes()
    end = 20 + int.from_bytes(data[12:16], "little")
    return json.loads(data[20:end]), data[end:]


def write_json(path: Path, text: bytes, rest: bytes) -> None:
    """Write a .glb of a JSON text and what is behind it."""
    text += b" " * (-len(text) % 4)
    head = b"glTF" + struct.pack("<II", 2, 20 + len(text) + len(rest))
    path.write_bytes(head + struct.pack("<I", len(text)) + b"JSON" + text + rest)


def error_of(path: Path) -> str:
    """Return the error of a file, which is one line and begins with its path."""
    with pytest.raises(AssetError) as caught:
        load_model(str(path))
    text = str(caught.value)
    assert text.startswith(f"{path}: ")
    assert "\n" not in text
    assert "Error" not in text
    return text.removeprefix(f"{path}: ")


def set_entry(*keys: Any) -> Callable[[Tree], None]:
    """Return a change of a tree: the last key is the value of the entry of the others."""

    def change(tree: Tree) -> None:
        entry: Any = tree
        for key in keys[:-2]:
            entry = entry[key]
        entry[keys[-2]] = keys[-1]

    return change


PRIMITIVE = ("meshes", 0, "primitives", 0)
PLACE = "its meshes[0].primitives[0]"


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (set_entry(*PRIMITIVE, "indices", -1), f"{PLACE}.indices is -1; expected 0 to 3"),
        (set_entry(*PRIMITIVE, "indices", 2), f"{PLACE}.indices is 'VEC2 of type 5126'"),
        (set_entry(*PRIMITIVE, "material", 7), f"{PLACE}.material is 7; expected 0 to 0"),
        (set_entry(*PRIMITIVE, "attributes", {}), f"{PLACE}.attributes has no POSITION"),
        (set_entry(*PRIMITIVE, "attributes", "NORMAL", 9), f"{PLACE}.attributes.NORMAL is 9"),
        (
            set_entry("buffers", 0, "byteLength", 2**31),
            "its buffers[0].byteLength is 2147483648; expected at most the 140 bytes of its data",
        ),
        (
            set_entry("materials", 0, "normalTexture", {"index": 5}),
            "its materials[0].normalTexture.index is 5; expected 0 to 1, the index of one of its "
            "textures",
        ),
        (set_entry("textures", 0, "source", 2), "its textures[0].source is 2; expected 0 to 1"),
        (set_entry("nodes", 0, "mesh", 1), "its nodes[0].mesh is 1; expected 0 to 0"),
        (set_entry("nodes", 0, "matrix", [1.0]), "its nodes[0].matrix is [1.0]; expected 16"),
        (set_entry("nodes", 0, "children", [3]), "its nodes[0].children[0] is 3"),
        (
            set_entry("nodes", 0, "rotation", [0.0, 0.0, 0, 0]),
            "its nodes[0].rotation is [0.0, 0.0, 0, 0]; expected a unit quaternion",
        ),
        (
            set_entry("nodes", [{"children": [1, 2]}, {"children": [2]}, {"mesh": 0}]),
            "its nodes[1].children has 2, already a child of nodes[0]; expected one parent",
        ),
        (
            set_entry("nodes", [{"children": [1, 1]}, {"mesh": 0}]),
            "its nodes[0].children has 1, already a child of nodes[0]; expected one parent",
        ),
        (set_entry("scene", -1), "its scene is -1; expected 0 to 0"),
        (set_entry("bufferViews", 0, "byteLength", 900), "its bufferViews[0] is at bytes 0 to 900"),
        (set_entry("accessors", 0, "count", 400), "its accessors[0] is 4800 bytes of bufferV"),
        (set_entry("accessors", 3, "count", 5), f"{PLACE}.indices is '5 vertices'"),
        (set_entry("accessors", 0, "componentType", 1), "its accessors[0].componentType is 1"),
        (set_entry("meshes", {}), "its meshes is {}; expected a list"),
        (set_entry("meshes", 0, 5), "its meshes[0] is 5; expected an object"),
        (set_entry("asset", {"version": "1.0"}), "its asset.version is '1.0'; expected '2.0'"),
    ],
)
def test_an_error_names_the_entry(
    change: Callable[[Tree], None], expected: str, tmp_path: Path
) -> None:
    path = write_plate(tmp_path / "plate.glb")
    assert load_model(str(path)).n_triangles == 2
    tree, rest = read_json(path)
    change(tree)
    write_json(path, json.dumps(tree).encode(), rest)
    assert error_of(path).startswith(expected)


def test_the_container_is_checked(tmp_path: Path) -> None:
    path = write_plate(tmp_path / "plate.glb")
    data = path.read_bytes()
    path.write_bytes(data[:4] + struct.pack("<I", 9) + data[8:])
    assert error_of(path) == "its container has version 9; expected 2."
    path.write_bytes(data[:-40])
    assert error_of(path).startswith("it is cut off: its header states")
    path.write_bytes(data[:10])
    assert error_of(path) == "it does not begin with the header of a .glb file."


def test_text_that_is_no_json_is_reported_with_its_place(tmp_path: Path) -> None:
    path = tmp_path / "plate.glb"
    write_json(path, b'{"nodes": [}', b"")
    assert error_of(path) == "line 1, column 12 of its JSON: Expecting value."
    write_json(path, b'{"name": "\xe9\xff"}', b"")
    assert error_of(path) == "byte 10 of its JSON is not UTF-8 text."
    write_json(path, b"[" * 100_000, b"")
    assert "nested too deeply" in error_of(path)


def test_all_errors_are_in_one_line(tmp_path: Path) -> None:
    path = write_plate(tmp_path / "plate.glb")
    tree, rest = read_json(path)
    tree["nodes"] = [{"mesh": -1}] * 8
    write_json(path, json.dumps(tree).encode(), rest)
    text = error_of(path)
    assert text.startswith("its nodes[0].mesh is -1; expected 0 to 0, the index of one of its mesh")
    assert text.endswith("; and 3 more errors.")


def test_a_changed_entry_is_read_or_named(tmp_path: Path) -> None:
    path = write_plate(tmp_path / "plate.glb")
    tree, rest = read_json(path)
    places = list(_list_places(tree, ()))
    choices = random.Random(3)
    for _ in range(150):
        copy = json.loads(json.dumps(tree))
        place = choices.choice(places)
        value = choices.choice([-1, 2**31, 1.5, None, "x", [], {}, True, 1e30, 7])
        set_entry(*place, value)(copy)
        write_json(path, json.dumps(copy).encode(), rest)
        try:
            load_model(str(path))
        except AssetError as error:
            assert "a validator of glTF" not in str(error), (place, value)  # noqa: PT017


def _list_places(tree: Any, place: tuple[Any, ...]) -> list[tuple[Any, ...]]:
    keys = tree if isinstance(tree, dict) else range(len(tree)) if isinstance(tree, list) else ()
    return [
        each for key in keys for each in ((*place, key), *_list_places(tree[key], (*place, key)))
    ]
