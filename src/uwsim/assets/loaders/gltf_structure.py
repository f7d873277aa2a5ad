"""The structure of glTF files: container, JSON, indices of entries and lengths of their data.

The readers behind this check assume a valid file: Python reads the index -1 as the last entry, and
another wrong entry raises an exception that does not name it. The data of files next to a
``.gltf``, the pixels of images, and entries that are not drawn (animations, skins) are not checked.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

from .gltf_limits import GLB_JSON_START
from .gltf_views import check_views, is_integer

Tree = dict[str, Any]

MAX_ERRORS = 5
"""The greatest number of errors in a message."""
KINDS = (
    *("buffers", "bufferViews", "accessors", "images", "textures", "materials", "meshes"),
    *("nodes", "scenes", "cameras"),
)
"""The lists of a file that are read."""
INDEX_COMPONENTS = (5121, 5123, 5125)
"""The values of ``componentType`` that indices of vertices have."""
TRIANGLES = 4
"""The default ``mode`` of a primitive."""
NODE_NUMBERS = {"matrix": 16, "translation": 3, "rotation": 4, "scale": 3}
"""The numbers of the entries of a node."""
MATERIAL_TEXTURES = ("normalTexture", "occlusionTexture", "emissiveTexture")
"""The textures of a material beside those of its base colour and finish."""
BASE_TEXTURES = ("baseColorTexture", "metallicRoughnessTexture")
"""The textures in ``pbrMetallicRoughness``."""


def structure_error(data: bytes, suffix: str) -> str:
    """Report the first errors of a ``.gltf`` or ``.glb`` file in one line; empty if none."""
    chunk: bytes | None = None
    if suffix == ".glb":
        if error := _container_error(data):
            return error
        end = GLB_JSON_START + int.from_bytes(data[12:16], "little")
        data, chunk = data[GLB_JSON_START:end], data[end + 8 :]
    try:
        tree = json.loads(data.decode("utf-8"))
    except UnicodeDecodeError as error:
        return f"byte {error.start} of its JSON is not UTF-8 text"
    except json.JSONDecodeError as error:
        return f"line {error.lineno}, column {error.colno} of its JSON: {error.msg}"
    except (ValueError, RecursionError):
        return "its JSON is nested too deeply, or has a number that is too long"
    if not isinstance(tree, dict):
        return "its JSON is not an object with asset, meshes, nodes, ..."
    errors = list(_list_errors(tree)) or _Checker(tree, chunk).find_errors()
    remainder = f"; and {len(errors) - MAX_ERRORS} more errors" if len(errors) > MAX_ERRORS else ""
    return "; ".join(errors[:MAX_ERRORS]) + remainder


def _container_error(data: bytes) -> str:
    """Report what is wrong with the header of a ``.glb`` and the lengths of its chunks."""
    if len(data) < GLB_JSON_START or data[:4] != b"glTF":
        return "it does not begin with the header of a .glb file"
    version, length = (int.from_bytes(data[i : i + 4], "little") for i in (4, 8))
    if version != 2:
        return f"its container has version {version}; expected 2"
    if data[16:20] != b"JSON":
        return "its first chunk is not JSON"
    if length > len(data):
        return f"it is cut off: its header states {length} bytes; the file has {len(data)}"
    start = 12
    while start + 8 <= len(data):
        n = int.from_bytes(data[start : start + 4], "little")
        if start + 8 + n > len(data):
            rest = len(data) - start - 8
            return f"it is cut off: a chunk states {n} bytes; the file has {rest} of them"
        start += 8 + n
    return ""


def _list_errors(tree: Tree) -> Iterator[str]:
    """Report entries that are no lists of objects, and another version of glTF."""
    asset = tree.get("asset")
    version = asset.get("version", "2.0") if isinstance(asset, dict) else "2.0"
    if not str(version).startswith("2"):
        yield f"its asset.version is {_quote(version)}; expected '2.0'"
    for kind in KINDS:
        entries = tree.get(kind, [])
        if not isinstance(entries, list):
            yield f"its {kind} is {_quote(entries)}; expected a list"
            continue
        for number, entry in enumerate(entries):
            if not isinstance(entry, dict):
                yield f"its {kind}[{number}] is {_quote(entry)}; expected an object"


class _Checker:
    """A check of the entries of a file, which collects errors.

    Args:
        tree: the JSON of the file, whose `KINDS` are lists of objects.
        chunk: the binary part of a ``.glb``; None for a ``.gltf``.
    """

    def __init__(self, tree: Tree, chunk: bytes | None) -> None:
        self._tree, self._chunk = tree, chunk
        self._errors: list[str] = []

    def find_errors(self) -> list[str]:
        """Return the errors of all entries."""
        self._check_links()
        self._check_nodes()
        if not self._errors:  # what follows uses the indices
            self._errors += check_views(self._tree, self._chunk)
        if not self._errors:
            for place, primitive in self._primitives():
                self._check_counts(place, primitive)
        return self._errors

    def _check_links(self) -> None:
        """Check the indices from one entry to another."""
        for place, view in self._entries("bufferViews"):
            self._check_index(f"{place}.buffer", view.get("buffer"), "buffers")
        for place, accessor in self._entries("accessors"):
            if "bufferView" in accessor:
                self._check_index(f"{place}.bufferView", accessor["bufferView"], "bufferViews")
        for place, image in self._entries("images"):
            if "bufferView" in image:
                self._check_index(f"{place}.bufferView", image["bufferView"], "bufferViews")
        for place, texture in self._entries("textures"):
            if "source" in texture:
                self._check_index(f"{place}.source", texture["source"], "images")
        for place, material in self._entries("materials"):
            self._check_material(place, material)
        for place, mesh in self._entries("meshes"):
            primitives = mesh.get("primitives")
            if not isinstance(primitives, list) or not all(isinstance(p, dict) for p in primitives):
                self._report(f"{place}.primitives", primitives, "a list of objects")
        for place, primitive in self._primitives():
            self._check_primitive(place, primitive)

    def _check_material(self, place: str, material: Tree) -> None:
        base = material.get("pbrMetallicRoughness", {})
        if not isinstance(base, dict):
            self._report(f"{place}.pbrMetallicRoughness", base, "an object")
            return
        entries = [(material, name, place) for name in MATERIAL_TEXTURES]
        entries += [(base, name, f"{place}.pbrMetallicRoughness") for name in BASE_TEXTURES]
        for tree, name, owner in entries:
            reference = tree.get(name)
            if isinstance(reference, dict):
                self._check_index(f"{owner}.{name}.index", reference.get("index"), "textures")
            elif name in tree:
                self._report(f"{owner}.{name}", reference, "an object")

    def _check_primitive(self, place: str, primitive: Tree) -> None:
        attributes = primitive.get("attributes")
        if not isinstance(attributes, dict):
            self._report(f"{place}.attributes", attributes, "an object")
            return
        for name, index in attributes.items():
            self._check_index(f"{place}.attributes.{name[:40]}", index, "accessors")
        if "POSITION" not in attributes:
            self._errors.append(f"its {place}.attributes has no POSITION")
        for entry, kind in (("indices", "accessors"), ("material", "materials")):
            if entry in primitive:
                self._check_index(f"{place}.{entry}", primitive[entry], kind)

    def _check_nodes(self) -> None:
        for place, node in self._entries("nodes"):
            for entry, kind in (("mesh", "meshes"), ("camera", "cameras")):
                if entry in node:
                    self._check_index(f"{place}.{entry}", node[entry], kind)
            self._check_indices(f"{place}.children", node.get("children", []), "nodes")
            for entry, n in NODE_NUMBERS.items():
                numbers = node.get(entry, [0.0] * n)
                is_valid = isinstance(numbers, list) and len(numbers) == n
                if not (is_valid and all(_is_finite(number) for number in numbers)):
                    self._report(f"{place}.{entry}", numbers, f"{n} numbers")
                elif entry == "rotation" and entry in node and not any(numbers):
                    self._report(f"{place}.{entry}", numbers, "a unit quaternion")
        self._check_parents()
        for place, scene in self._entries("scenes"):
            self._check_indices(f"{place}.nodes", scene.get("nodes", []), "nodes")
        if "scene" in self._tree:
            self._check_index("scene", self._tree["scene"], "scenes")

    def _check_parents(self) -> None:
        """Check that no node has two parents: the nodes of a file are trees (glTF 2.0, 3.5.2)."""
        parents: dict[int, str] = {}
        for place, node in self._entries("nodes"):
            children = node.get("children", [])
            for index in children if isinstance(children, list) else []:
                if is_integer(index) and index in parents:
                    text = f"{index}, already a child of {parents[index]}"
                    self._errors.append(f"its {place}.children has {text}; expected one parent")
                elif is_integer(index):
                    parents[index] = place

    def _check_counts(self, place: str, primitive: Tree) -> None:
        """Check that vertices have 3 numbers and triangles 3 vertices."""
        accessors = self._tree["accessors"]
        positions = accessors[primitive["attributes"]["POSITION"]]
        if positions["type"] != "VEC3":
            self._report(f"{place}.attributes.POSITION", positions["type"], "'VEC3'")
        corners = positions
        if "indices" in primitive:
            corners = accessors[primitive["indices"]]
            if corners["type"] != "SCALAR" or corners["componentType"] not in INDEX_COMPONENTS:
                text = f"{corners['type']} of type {corners['componentType']}"
                self._report(f"{place}.indices", text, "unsigned integers")
        if primitive.get("mode", TRIANGLES) == TRIANGLES and corners["count"] % 3:
            entry = "indices" if "indices" in primitive else "attributes.POSITION"
            text = f"{corners['count']} vertices"
            self._report(f"{place}.{entry}", text, "three for each triangle")

    def _check_indices(self, place: str, indices: object, kind: str) -> None:
        if not isinstance(indices, list):
            self._report(place, indices, f"a list of indices of {kind}")
            return
        for number, index in enumerate(indices):
            self._check_index(f"{place}[{number}]", index, kind)

    def _check_index(self, place: str, index: object, kind: str) -> None:
        n = len(self._tree.get(kind, []))
        if is_integer(index) and index < n:
            return
        expected = f"0 to {n - 1}, the index of one of its {kind}" if n else f"none: no {kind}"
        self._report(place, index, expected)

    def _primitives(self) -> Iterator[tuple[str, Tree]]:
        for place, mesh in self._entries("meshes"):
            primitives = mesh.get("primitives")
            for number, primitive in enumerate(primitives if isinstance(primitives, list) else []):
                if isinstance(primitive, dict):
                    yield f"{place}.primitives[{number}]", primitive

    def _entries(self, kind: str) -> Iterator[tuple[str, Tree]]:
        for number, entry in enumerate(self._tree.get(kind, [])):
            yield f"{kind}[{number}]", entry

    def _report(self, place: str, value: object, expected: str) -> None:
        self._errors.append(f"its {place} is {_quote(value)}; expected {expected}")


def _is_finite(value: object) -> bool:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return is_number and math.isfinite(value)  # type: ignore[arg-type]


def _quote(value: object) -> str:
    return "missing" if value is None else repr(value)[:60]
