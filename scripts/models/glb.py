"""The writer of GLB files (glTF 2.0), each with the models of one family as scenes.

Vertices are stored as they are, with z up; the node of a model turns them to glTF's y up. Texture
coordinates of models that are stored without loss are stored as they are too, and turned upside
down by ``KHR_texture_transform``.
"""

from __future__ import annotations

import io
import json
import math
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from uwsim.assets.mesh import Mesh, Texture
from uwsim.base.numerics.srgb import decode_number

from .parts import Maps, Part
from .png import encode_png

FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_BUFFER = 34962, 34963
LINEAR, LINEAR_MIPMAPS, REPEAT, CLAMP = 9729, 9987, 10497, 33071
HALF = math.sqrt(0.5)
Y_UP_FROM_Z_UP = (-HALF, 0.0, 0.0, HALF)
"""The rotation by -90 degrees about x, xyzw."""
UPSIDE_DOWN = {"KHR_texture_transform": {"offset": [0, 1], "scale": [1, -1]}}
JPEG_QUALITY = {"colour": 75, "normal": 66, "surface": 60}
"""The quality of images by their use, 0 to 100."""
MAX_SHORT_INDEX = 65534

Tree = dict[str, Any]


def encode_glb(models: Mapping[str, tuple[Part, ...]]) -> bytes:
    """Encode models, by their names, as the scenes of one file."""
    writer = _Writer()
    for name, parts in models.items():
        writer.add_model(name, parts)
    return writer.to_bytes()


class _Writer:
    def __init__(self) -> None:
        self._tree: Tree = {
            "asset": {"version": "2.0", "generator": "uwsim scripts/models"},
            "scene": 0,
            **{kind: [] for kind in ("scenes", "nodes", "meshes", "materials")},
            **{kind: [] for kind in ("accessors", "bufferViews", "images", "textures", "samplers")},
        }
        self._chunk = bytearray()
        self._indices: dict[object, int] = {}

    def add_model(self, name: str, parts: tuple[Part, ...]) -> None:
        primitives = [self._primitive(part) for part in parts]
        mesh = self._add("meshes", {"name": name, "primitives": primitives})
        node = {"name": name, "mesh": mesh, "rotation": list(Y_UP_FROM_Z_UP)}
        self._add("scenes", {"name": name, "nodes": [self._add("nodes", node)]})

    def to_bytes(self) -> bytes:
        self._tree["buffers"] = [{"byteLength": len(self._chunk)}]
        tree = {key: value for key, value in self._tree.items() if value != []}
        text = json.dumps(tree, separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        chunk = bytes(self._chunk) + b"\0" * (-len(self._chunk) % 4)
        size = 12 + 8 + len(text) + 8 + len(chunk)
        head = b"glTF" + struct.pack("<II", 2, size)
        json_chunk = struct.pack("<I", len(text)) + b"JSON" + text
        return head + json_chunk + struct.pack("<I", len(chunk)) + b"BIN\0" + chunk

    def _add(self, kind: str, entry: Tree) -> int:
        """Add an entry, or return the index of an equal one."""
        key = kind, json.dumps(entry, sort_keys=True)
        if key not in self._indices:
            self._tree[kind].append(entry)
            self._indices[key] = len(self._tree[kind]) - 1
        return self._indices[key]

    def _view(self, data: bytes, target: int | None = None) -> int:
        key = "view", data, target
        if key not in self._indices:
            self._chunk += b"\0" * (-len(self._chunk) % 4)
            view: Tree = {"buffer": 0, "byteOffset": len(self._chunk), "byteLength": len(data)}
            self._chunk += data
            if target is not None:
                view["target"] = target
            self._tree["bufferViews"].append(view)
            self._indices[key] = len(self._tree["bufferViews"]) - 1
        return self._indices[key]

    def _accessor(self, values: npt.NDArray[Any], kind: str, *, has_limits: bool = False) -> int:
        component = {"f4": FLOAT, "u2": UNSIGNED_SHORT, "u4": UNSIGNED_INT}[values.dtype.str[1:]]
        target = ARRAY_BUFFER if component == FLOAT else ELEMENT_BUFFER
        accessor = {
            "bufferView": self._view(values.tobytes(), target),
            "componentType": component,
            "count": len(values) if component == FLOAT else values.size,
            "type": kind,
        }
        if has_limits:
            accessor["min"] = [float(value) for value in values.min(axis=0)]
            accessor["max"] = [float(value) for value in values.max(axis=0)]
        return self._add("accessors", accessor)

    def _primitive(self, part: Part) -> Tree:
        mesh = part.mesh
        uvs = mesh.uvs.copy()
        if not part.is_lossless:
            uvs[:, 1] = np.float32(1.0) - uvs[:, 1]
        is_short = len(mesh.vertices) <= MAX_SHORT_INDEX
        attributes = {
            "POSITION": self._accessor(mesh.vertices, "VEC3", has_limits=True),
            "NORMAL": self._accessor(mesh.normals, "VEC3"),
            "TEXCOORD_0": self._accessor(uvs, "VEC2"),
        }
        return {
            "attributes": attributes,
            "indices": self._accessor(
                mesh.triangles.astype("<u2" if is_short else "<u4"), "SCALAR"
            ),
            "material": self._material(mesh, part.maps or Maps(), is_lossless=part.is_lossless),
        }

    def _material(self, mesh: Mesh, maps: Maps, *, is_lossless: bool) -> int:
        def reference(texture: Texture, use: str) -> Tree:
            entry: Tree = {"index": self._texture(texture, use, is_lossless=is_lossless)}
            if is_lossless:
                self._tree["extensionsUsed"] = self._tree["extensionsRequired"] = [*UPSIDE_DOWN]
                entry["extensions"] = UPSIDE_DOWN
            return entry

        surface: Tree = {
            "baseColorFactor": [*map(decode_number, mesh.colour), mesh.opacity],
            "metallicFactor": maps.metallic,
            "roughnessFactor": maps.roughness,
        }
        material: Tree = {"pbrMetallicRoughness": surface}
        if mesh.texture is not None:
            material = {"name": mesh.texture.name, **material}
            surface["baseColorTexture"] = reference(mesh.texture, "colour")
        if maps.surface is not None:
            surface["metallicRoughnessTexture"] = reference(maps.surface, "surface")
            material["occlusionTexture"] = reference(maps.surface, "surface")
        if maps.normal is not None:
            material["normalTexture"] = reference(maps.normal, "normal")
        if mesh.opacity < 1.0:
            material["alphaMode"] = "BLEND"
        if mesh.two_sided:
            material["doubleSided"] = True
        return self._add("materials", material)

    def _texture(self, texture: Texture, use: str, *, is_lossless: bool) -> int:
        wrap = REPEAT if texture.repeats else CLAMP
        sampler = {"magFilter": LINEAR, "minFilter": LINEAR_MIPMAPS, "wrapS": wrap, "wrapT": wrap}
        key = "image", texture.name
        if key not in self._indices:
            if is_lossless:
                data, kind = encode_png(texture.pixels), "image/png"
            else:
                data, kind = encode_jpeg(texture.pixels, JPEG_QUALITY[use]), "image/jpeg"
            image = {"name": texture.name, "mimeType": kind, "bufferView": self._view(data)}
            self._indices[key] = self._add("images", image)
        entry = {"sampler": self._add("samplers", sampler), "source": self._indices[key]}
        return self._add("textures", entry)


def encode_jpeg(pixels: npt.NDArray[np.uint8], quality: int) -> bytes:
    """Encode an image (h, w, 3) with the same resolution of all channels."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "JPEG", quality=quality, subsampling=0, optimize=True)
    return file.getvalue()
