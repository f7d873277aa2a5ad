"""The reader of the bundled models, which are GLB files in ``data/models``.

Each file has the models of one family, which share images, as its scenes. Unlike files of users,
their vertices and normals are read as they are stored, without the rotations of the nodes: z is up.
``python -m scripts.models`` writes the files.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.numerics.srgb import encode_number
from .images import EncodedImage
from .loaders.gltf_limits import GLB_JSON_START
from .mesh import ArrayDigest, Material, Mesh, Model, Texture
from .stand_ins import BUNDLED_MODELS, LabelledBox

FOLDER = Path(__file__).resolve().parent.parent / "data" / "models"
"""The folder of the files."""
CLAMP = 33071
"""The number of the wrap mode that continues the edge of an image, as in OpenGL."""
DTYPES = {5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}
DECIMALS = 6
"""The number of decimals of colours, which are converted from linear values."""

Tree = dict[str, Any]


@cache
def bundled_model(name: str) -> Model:
    """Return the model of a name in `BUNDLED_MODELS`; its arrays are read once."""
    entry = BUNDLED_MODELS[name]
    if isinstance(entry, LabelledBox):
        from .procedural.placeholder import labelled_box

        meshes, source = labelled_box(entry.label, entry.size), "labelled box"
    else:
        meshes, source = tuple(_open(entry.file).read_meshes(entry.scene or name)), entry.source
    return Model(name=name, meshes=meshes, source=source, digest=ArrayDigest(meshes))


@cache
def _open(file: str) -> _BundledFile:
    data = (FOLDER / f"{file}.glb").read_bytes()
    end = GLB_JSON_START + int.from_bytes(data[12:16], "little")
    return _BundledFile(json.loads(data[GLB_JSON_START:end]), memoryview(data)[end + 8 :])


@dataclass(frozen=True, eq=False)
class _BundledFile:
    """A file: its tree and its binary part. Meshes that use an image share one texture."""

    tree: Tree
    chunk: memoryview

    def read_meshes(self, scene: str) -> Iterator[Mesh]:
        (entry,) = (entry for entry in self.tree["scenes"] if entry["name"] == scene)
        for node in entry["nodes"]:
            mesh = self.tree["meshes"][self.tree["nodes"][node]["mesh"]]
            for primitive in mesh["primitives"]:
                yield self._mesh(primitive)

    def _mesh(self, primitive: Tree) -> Mesh:
        material = self.tree["materials"][primitive["material"]]
        surface = material["pbrMetallicRoughness"]
        *colour, opacity = surface["baseColorFactor"]
        red, green, blue = (round(encode_number(value), DECIMALS) for value in colour)
        image = surface.get("baseColorTexture")
        attributes = primitive["attributes"]
        uvs = self._array(attributes["TEXCOORD_0"])
        is_old = "KHR_texture_transform" in self.tree.get("extensionsUsed", ())
        if not is_old:
            uvs[:, 1] = np.float32(1.0) - uvs[:, 1]
        triangles = self._array(primitive["indices"]).reshape(-1, 3)
        return Mesh(
            vertices=self._array(attributes["POSITION"]),
            normals=self._array(attributes["NORMAL"]),
            uvs=uvs,
            triangles=triangles.astype(np.uint32),
            colour=(red, green, blue),
            texture=None if image is None else self._texture(image),
            opacity=opacity,
            two_sided=material.get("doubleSided", False),
            material=None if is_old else self._material(material),
        )

    def _material(self, material: Tree) -> Material:
        """Return the finish of a surface; models that older versions generated are matte."""
        surface = material["pbrMetallicRoughness"]
        finish = surface.get("metallicRoughnessTexture")  # with occlusion in red
        normal = material.get("normalTexture")
        return Material(
            roughness=surface["roughnessFactor"],
            metallic=surface["metallicFactor"],
            finish_map=None if finish is None else self._texture(finish),
            normal_map=None if normal is None else self._texture(normal),
        )

    def _texture(self, reference: Tree) -> Texture:
        return _find_texture(self, reference["index"])

    def _array(self, index: int) -> npt.NDArray[Any]:
        accessor = self.tree["accessors"][index]
        width, dtype = WIDTHS[accessor["type"]], np.dtype(DTYPES[accessor["componentType"]])
        values = np.frombuffer(self.view(accessor["bufferView"]), dtype, accessor["count"] * width)
        return values.reshape(-1, width).copy()

    def view(self, index: int) -> memoryview:
        """Return the bytes of a view of the binary part."""
        view = self.tree["bufferViews"][index]
        return self.chunk[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]


@cache
def _find_texture(file: _BundledFile, texture: int) -> Texture:
    """Return the texture of an image, one for all meshes that use it: they are drawn together."""
    entry = file.tree["textures"][texture]
    image = file.tree["images"][entry["source"]]
    data = bytes(file.view(image["bufferView"]))
    wrap = file.tree["samplers"][entry["sampler"]]["wrapS"]
    return Texture(
        name=image["name"],
        image=EncodedImage(data, is_jpeg=image["mimeType"] == "image/jpeg"),
        repeats=wrap != CLAMP,
    )
