"""A strict check of the structure of a GLB file by the rules of the glTF 2.0 specification."""

from __future__ import annotations

import io
import json
import struct
from collections.abc import Iterator
from typing import Any

import numpy as np
from PIL import Image

Tree = dict[str, Any]
COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
ATTRIBUTES = {"POSITION": ("VEC3", 5126), "NORMAL": ("VEC3", 5126), "TEXCOORD_0": ("VEC2", 5126)}
ARRAY_BUFFER, ELEMENT_BUFFER = 34962, 34963


def structure_errors(data: bytes) -> list[str]:
    """Return the rules of the specification that a GLB file breaks; empty if none."""
    try:
        return list(_container_errors(data)) or list(_tree_errors(*_chunks(data)))
    except (KeyError, IndexError, ValueError, struct.error) as error:
        return [f"{type(error).__name__}: {error}"]


def _container_errors(data: bytes) -> Iterator[str]:
    """Check the header and the chunks (4.4)."""
    magic, version, length = struct.unpack("<4sII", data[:12])
    if (magic, version, length) != (b"glTF", 2, len(data)):
        yield f"header {magic!r}, version {version}, length {length} of {len(data)}"
    if len(data) % 4:
        yield "the length is no multiple of 4"
    start, kinds = 12, []
    while start < len(data):
        size, kind = struct.unpack("<I4s", data[start : start + 8])
        kinds.append(kind)
        if size % 4:
            yield f"chunk {kind!r} has {size} bytes"
        start += 8 + size
    if kinds != [b"JSON", b"BIN\0"] or start != len(data):
        yield f"chunks {kinds} end at {start} of {len(data)}"


def _chunks(data: bytes) -> tuple[Tree, bytes]:
    end = 20 + int.from_bytes(data[12:16], "little")
    text = data[20:end]
    tree = json.loads(text.decode("utf-8"))
    if text.rstrip(b" ") != text.strip():
        raise ValueError("the JSON is padded by other characters than spaces")
    return tree, data[end + 8 :]


def _tree_errors(tree: Tree, chunk: bytes) -> Iterator[str]:
    if tree["asset"]["version"] != "2.0":
        yield "asset.version"
    (buffer,) = tree["buffers"]
    if not 0 <= len(chunk) - buffer["byteLength"] <= 3:
        yield f"buffer of {buffer['byteLength']} bytes in a chunk of {len(chunk)}"
    for kind, entries in tree.items():
        if isinstance(entries, list) and not entries:
            yield f"{kind} is empty"
    if not set(tree.get("extensionsRequired", ())) <= set(tree.get("extensionsUsed", ())):
        yield "an extension is required and not used"
    yield from _node_errors(tree)
    yield from _view_errors(tree)
    for mesh in tree["meshes"]:
        for primitive in mesh["primitives"]:
            yield from _primitive_errors(tree, chunk, primitive)
    yield from _material_errors(tree, chunk)


def _node_errors(tree: Tree) -> Iterator[str]:
    roots = [node for scene in tree["scenes"] for node in scene["nodes"]]
    if not 0 <= tree["scene"] < len(tree["scenes"]) or max(roots) >= len(tree["nodes"]):
        yield "a scene names no node"
    for node in tree["nodes"]:
        if abs(sum(value * value for value in node["rotation"]) - 1.0) > 1e-6:
            yield "a rotation is not of unit length"
        if not 0 <= node["mesh"] < len(tree["meshes"]):
            yield "a node names no mesh"


def _view_errors(tree: Tree) -> Iterator[str]:
    end = 0
    for view in tree["bufferViews"]:
        if view["byteOffset"] % 4 or view["byteOffset"] < end or view["byteLength"] < 1:
            yield f"view at {view['byteOffset']}"
        end = view["byteOffset"] + view["byteLength"]
    if end > tree["buffers"][0]["byteLength"]:
        yield "a view ends beyond the buffer"


def _values(tree: Tree, chunk: bytes, index: int) -> np.ndarray:
    accessor = tree["accessors"][index]
    dtype, width = np.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[accessor["type"]]
    view = tree["bufferViews"][accessor["bufferView"]]
    start = accessor.get("byteOffset", 0)
    if start % dtype.itemsize or (view["byteOffset"] + start) % dtype.itemsize:
        raise ValueError(f"accessor {index} is not aligned")
    if start + accessor["count"] * width * dtype.itemsize > view["byteLength"]:
        raise ValueError(f"accessor {index} ends beyond its view")
    first = view["byteOffset"] + start
    values = np.frombuffer(chunk, dtype, accessor["count"] * width, first).reshape(-1, width)
    for key, limit in (("min", values.min(axis=0)), ("max", values.max(axis=0))):
        if key in accessor and accessor[key] != [float(value) for value in limit]:
            raise ValueError(f"accessor {index}: {key} is {limit}, written {accessor[key]}")
    return values


def _primitive_errors(tree: Tree, chunk: bytes, primitive: Tree) -> Iterator[str]:
    attributes = primitive["attributes"]
    values = {name: _values(tree, chunk, index) for name, index in attributes.items()}
    for name, index in attributes.items():
        accessor = tree["accessors"][index]
        if (accessor["type"], accessor["componentType"]) != ATTRIBUTES[name]:
            yield f"{name} is {accessor['type']}"
        if tree["bufferViews"][accessor["bufferView"]].get("target") != ARRAY_BUFFER:
            yield f"the target of {name}"
        if not np.isfinite(values[name]).all():
            yield f"{name} is not finite"
    if len({len(array) for array in values.values()}) != 1:
        yield "attributes of different lengths"
    position = tree["accessors"][attributes["POSITION"]]
    if not {"min", "max"} <= set(position):
        yield "POSITION has no limits"
    lengths = np.linalg.norm(values["NORMAL"].astype(np.float64), axis=1)
    if np.abs(lengths - 1.0).max() > 5e-4:
        yield "a normal is not of unit length"
    indices = _values(tree, chunk, primitive["indices"])[:, 0]
    entry = tree["accessors"][primitive["indices"]]
    if tree["bufferViews"][entry["bufferView"]].get("target") != ELEMENT_BUFFER:
        yield "the target of indices"
    if entry["componentType"] not in (5121, 5123, 5125) or len(indices) % 3:
        yield "indices are not triangles"
    if indices.max() >= len(values["POSITION"]):
        yield "an index of no vertex"
    if indices.max() == np.iinfo(COMPONENTS[entry["componentType"]]).max:
        yield "an index restarts primitives"
    if not 0 <= primitive["material"] < len(tree["materials"]):
        yield "a primitive names no material"


def _material_errors(tree: Tree, chunk: bytes) -> Iterator[str]:
    for material in tree["materials"]:
        surface = material["pbrMetallicRoughness"]
        factors = [surface["metallicFactor"], surface["roughnessFactor"]]
        if not all(0.0 <= value <= 1.0 for value in [*surface["baseColorFactor"], *factors]):
            yield "a factor beyond 0..1"
        references = [*surface.values(), *material.values()]
        for reference in references:
            if isinstance(reference, dict) and "index" in reference:
                texture = tree["textures"][reference["index"]]
                _ = tree["images"][texture["source"]], tree["samplers"][texture["sampler"]]
                if not set(reference.get("extensions", ())) <= set(tree.get("extensionsUsed", ())):
                    yield "an extension that is not listed"
    for image in tree.get("images", ()):
        view = tree["bufferViews"][image["bufferView"]]
        data = chunk[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        with Image.open(io.BytesIO(data)) as picture:
            picture.load()
            if f"image/{str(picture.format).lower()}" != image["mimeType"]:
                yield f"an image is {picture.format}, not {image['mimeType']}"
        if "target" in view:
            yield "the view of an image has a target"
