"""A writer of small glTF files with materials, for tests."""

from __future__ import annotations

import base64
import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

COMPONENTS = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "float32": 5126}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


def encode(image: Image.Image, kind: str = "PNG") -> bytes:
    """Return the bytes of an image file."""
    file = io.BytesIO()
    image.save(file, kind)
    return file.getvalue()


def colour_image(*colour: int, size: tuple[int, int] = (4, 4)) -> Image.Image:
    """Return an image of one colour, grey, RGB or RGBA."""
    return Image.new({1: "L", 3: "RGB", 4: "RGBA"}[len(colour)], size, colour)


class Plates:
    """A glTF file with one plate of two triangles for each material that is added."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.tree: dict[str, Any] = {
            "asset": {"version": "2.0"},
            **{kind: [] for kind in ("bufferViews", "accessors", "materials", "images")},
            **{"textures": [], "nodes": [], "meshes": [{"primitives": []}]},
            "scenes": [{"nodes": [0]}],
            "scene": 0,
        }
        self.tree["nodes"] = [{"mesh": 0}]
        points = np.array([[0, 0, 0], [1, 0, 0], [1, 0.5, 0], [0, 0.5, 0]], np.float32)
        self.positions = self.add(points)
        self.normals = self.add(np.tile(np.array([0, 0.6, 0.8], np.float32), (4, 1)))
        self.uvs = self.add(np.array([[0, 1], [1, 1], [1, 0], [0, 0]], np.float32))
        self.corners = self.add(np.array([0, 1, 2, 0, 2, 3], np.uint16))

    def add(self, values: Any, **more: Any) -> int:
        """Add an accessor."""
        n = 1 if values.ndim == 1 else values.shape[1]
        view = self._view(values.tobytes())
        kind = {"componentType": COMPONENTS[str(values.dtype)], "type": KINDS[n]}
        self.tree["accessors"].append({"bufferView": view, "count": len(values), **kind, **more})
        return len(self.tree["accessors"]) - 1

    def texture(self, image: Image.Image | bytes, **reference: Any) -> dict[str, Any]:
        """Add an image; return the reference to it."""
        data = image if isinstance(image, bytes) else encode(image)
        uri = "data:image/png;base64," + base64.b64encode(data).decode()
        self.tree["images"].append({"uri": uri})
        self.tree["textures"].append({"source": len(self.tree["images"]) - 1})
        return {"index": len(self.tree["textures"]) - 1, **reference}

    def plate(self, material: dict[str, Any], **attributes: int) -> None:
        """Add a plate of a material."""
        self.tree["materials"].append(material)
        primitive = {
            "attributes": {
                "POSITION": self.positions,
                "NORMAL": self.normals,
                "TEXCOORD_0": self.uvs,
                **attributes,
            },
            "indices": self.corners,
            "material": len(self.tree["materials"]) - 1,
        }
        self.tree["meshes"][0]["primitives"].append(primitive)

    def write(self, path: Path) -> Path:
        """Write the file, as .gltf or .glb by its suffix."""
        tree = {key: value for key, value in self.tree.items() if value != []}
        if path.suffix == ".gltf":
            uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
            tree["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
            path.write_text(json.dumps(tree))
            return path
        tree["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(tree).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + len(self.data)
        head = b"glTF" + struct.pack("<II", 2, size) + struct.pack("<I", len(text)) + b"JSON"
        path.write_bytes(head + text + struct.pack("<I", len(self.data)) + b"BIN\0" + self.data)
        return path

    def _view(self, data: bytes) -> int:
        self.tree["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}
        )
        self.data += data + bytes(-len(data) % 4)
        return len(self.tree["bufferViews"]) - 1
