"""Conversion of glTF files to the subset of glTF that trimesh reads.

Normalised and sparse accessors become plain ones. Texture coordinates are those of the base colour
texture, with its transform applied. The colour of a material is multiplied by the mean colour of
the vertices. Fans become triangles. Materials with more than a base colour are named by their
numbers (`gltf_materials`); where they have maps, normals and tangents are passed on. A file that
requires an unsupported extension is an error.
"""

from __future__ import annotations

import base64
import json
import math
import struct
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import AssetError
from .gltf_limits import GLB_JSON_START, MAX_ELEMENTS
from .gltf_materials import coordinate_reference, has_maps, mark_material

Numbers = npt.NDArray[Any]
Tree = dict[str, Any]

READ_EXTENSIONS = (
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_materials_",
)
"""The beginnings of extensions that a file may require; of materials, not all are drawn."""
MARKED_NORMAL, MARKED_TANGENT = "_NORMAL", "_TANGENT"
"""The names of normals and tangents of the file for trimesh, which keeps attributes that begin with
``_`` as they are."""
DTYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""The NumPy types by ``componentType``."""
FLOAT, UNSIGNED_INT = 5126, 5125
LENGTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
"""The number of components of an element, by ``type``."""
FAN = 6
TRANSFORM = "KHR_texture_transform"
SPECULAR = "KHR_materials_pbrSpecularGlossiness"
WEBP = "EXT_texture_webp"


def rewrite(data: bytes, suffix: str, resolve: Callable[[str], bytes]) -> bytes:
    """Convert a ``.gltf`` or ``.glb`` file for trimesh; return it unchanged if it needs nothing.

    Args:
        data: the file.
        suffix: ``.gltf`` or ``.glb``.
        resolve: a function that returns the bytes of a file next to it.

    Raises:
        AssetError: the file requires an unsupported extension, or has too many numbers.
        Exception: the file is not valid glTF; many types of exceptions occur.
    """
    is_binary = suffix == ".glb"
    end = GLB_JSON_START + int.from_bytes(data[12:16], "little") if is_binary else len(data)
    try:
        tree = json.loads(data[GLB_JSON_START:end] if is_binary else data)
    except (ValueError, RecursionError):
        return data  # trimesh reports the error
    if not isinstance(tree, dict):
        return data
    _check_extensions(tree)
    rewriter = _Rewriter(tree, data[end + 8 :] if is_binary else b"", resolve)
    if not rewriter.run():
        return data
    text = json.dumps(tree).encode()
    if not is_binary:
        return text
    text += b" " * (-len(text) % 4)
    rest = data[end:]
    head = b"glTF" + struct.pack("<II", 2, GLB_JSON_START + len(text) + len(rest))
    return head + struct.pack("<I", len(text)) + b"JSON" + text + rest


def _check_extensions(tree: Tree) -> None:
    extensions = tree.get("extensionsRequired", [])
    for name in extensions if isinstance(extensions, list) else []:
        if not str(name).startswith(READ_EXTENSIONS):
            raise AssetError(
                f"requires the unsupported extension {str(name)[:60]!r}; export it without"
            )


class _Rewriter:
    """A file that is rewritten in place: `run` changes the tree.

    Args:
        tree: the JSON of the file.
        chunk: the binary part of a ``.glb``.
        resolve: a function that returns the bytes of a file next to it.
    """

    def __init__(self, tree: Tree, chunk: bytes, resolve: Callable[[str], bytes]) -> None:
        self._tree, self._chunk, self._resolve = tree, chunk, resolve
        self._read: dict[int, bytes] = {}
        self._accessors: dict[object, int] = {}
        self._buffer_bytes = bytearray()
        self._n_elements = 0
        self._has_changed = False

    def run(self) -> bool:
        """Rewrite the parts that trimesh does not read; return whether anything changed.

        Raises:
            AssetError: a file of a buffer is shorter than the buffer.
        """
        self._check_files()
        for texture in self._tree.get("textures", []):
            if WEBP in texture.get("extensions", {}) and "source" not in texture:
                texture["source"] = texture["extensions"][WEBP]["source"]
                self._has_changed = True
        for number, material in enumerate(self._tree.get("materials", [])):
            self._use_diffuse(material)
            self._has_changed |= mark_material(material, number)
        for mesh in self._tree.get("meshes", []):
            for primitive in mesh.get("primitives", []):
                self._rewrite(primitive)
        if self._buffer_bytes:
            text = base64.b64encode(self._buffer_bytes).decode()
            uri = f"data:application/octet-stream;base64,{text}"
            entry = {"uri": uri, "byteLength": len(self._buffer_bytes)}
            self._tree.setdefault("buffers", []).append(entry)
        return self._has_changed

    def _use_diffuse(self, material: Tree) -> None:
        """Use the diffuse part of a specular-glossiness material as its base colour."""
        extension = material.get("extensions", {}).pop(SPECULAR, None)
        if extension is None:
            return
        parts = (part for part in ("Factor", "Texture") if f"diffuse{part}" in extension)
        base = {f"baseColor{part}": extension[f"diffuse{part}"] for part in parts}
        material["pbrMetallicRoughness"] = base
        self._has_changed = True

    def _rewrite(self, primitive: Tree) -> None:
        attributes = primitive.get("attributes", {})
        if "POSITION" in attributes and not self._is_plain(attributes["POSITION"]):
            attributes["POSITION"] = self._float_accessor(attributes["POSITION"])
        self._set_coordinates(primitive, attributes)
        self._set_directions(primitive, attributes)
        if "COLOR_0" in attributes and "material" in primitive:
            self._set_colour(primitive, attributes.pop("COLOR_0"))
        elif "COLOR_0" in attributes and not self._is_plain(attributes["COLOR_0"]):
            attributes["COLOR_0"] = self._float_accessor(attributes["COLOR_0"])
        if primitive.get("mode") == FAN:
            self._set_fan(primitive)
        elif "indices" in primitive and "sparse" in self._accessor(primitive["indices"]):
            indices = self._values(primitive["indices"]).astype("<u4")
            primitive["indices"] = self._add(indices, UNSIGNED_INT, "SCALAR")

    def _set_coordinates(self, primitive: Tree, attributes: Tree) -> None:
        """Make the texture coordinates of the base colour the first ones, as plain floats."""
        texture = self._base_texture(primitive)
        transform = texture.get("extensions", {}).get(TRANSFORM, {})
        name = f"TEXCOORD_{transform.get('texCoord', texture.get('texCoord', 0))}"
        if name not in attributes:
            return
        index = attributes[name]
        is_float = self._accessor(index).get("componentType") == FLOAT
        if not transform and is_float and self._is_plain(index):
            texcoord = index
        else:
            key = (index, json.dumps(transform, sort_keys=True))
            texcoord = self._accessors.get(key, -1)
            if texcoord < 0:
                uv = _transform_uv(self._values(index), transform)
                texcoord = self._accessors[key] = self._add(uv, FLOAT, "VEC2")
        if attributes.get("TEXCOORD_0") != texcoord:
            attributes["TEXCOORD_0"] = texcoord
            self._has_changed = True

    def _base_texture(self, primitive: Tree) -> Tree:
        """Return the reference to a texture whose coordinates a primitive uses."""
        if "material" not in primitive:
            return {}
        return coordinate_reference(self._tree["materials"][primitive["material"]])

    def _set_directions(self, primitive: Tree, attributes: Tree) -> None:
        """Pass on normals and tangents as plain floats, where the material has maps."""
        if "material" not in primitive:
            return
        if not has_maps(self._tree["materials"][primitive["material"]]):
            return
        for name, marked_name in (("NORMAL", MARKED_NORMAL), ("TANGENT", MARKED_TANGENT)):
            if name in attributes:
                attributes[marked_name] = self._float_accessor(attributes[name])
        if "NORMAL" in attributes:
            attributes["NORMAL"] = attributes[MARKED_NORMAL]

    def _set_colour(self, primitive: Tree, index: int) -> None:
        """Copy the material of a primitive, multiplied by the mean colour of the vertices."""
        self._has_changed = True
        mean = self._values(index)[:, :3].mean(axis=0, dtype=np.float64).tolist()
        if min(mean) > 1.0 - 1e-3:
            return  # white, as in most files with colours
        material = self._tree["materials"][primitive["material"]]
        base = material.get("pbrMetallicRoughness", {})
        factor = base.get("baseColorFactor", [1.0, 1.0, 1.0, 1.0])
        factor = [*(a * b for a, b in zip(factor, mean, strict=False)), *factor[3:]]
        base = {**base, "baseColorFactor": factor}
        self._tree["materials"].append({**material, "pbrMetallicRoughness": base})
        primitive["material"] = len(self._tree["materials"]) - 1

    def _set_fan(self, primitive: Tree) -> None:
        if "indices" in primitive:
            corners = self._values(primitive["indices"]).astype("<u4").ravel()
        else:
            n = self._accessor(primitive["attributes"]["POSITION"])["count"]
            corners = np.arange(n, dtype="<u4")
        hub = np.full(max(len(corners) - 2, 0), corners[0] if len(corners) else 0, "<u4")
        triangles = np.stack([hub, corners[1:-1], corners[2:]], axis=-1)
        primitive["indices"] = self._add(triangles.reshape(-1, 1), UNSIGNED_INT, "SCALAR")
        primitive["mode"] = 4

    def _accessor(self, index: int) -> Tree:
        accessor: Tree = self._tree["accessors"][index]
        return accessor

    def _is_plain(self, index: int) -> bool:
        accessor = self._accessor(index)
        return not accessor.get("normalized") and "sparse" not in accessor

    def _float_accessor(self, index: int) -> int:
        """Return the index of a plain accessor with the values of another."""
        if index not in self._accessors:
            kind = self._accessor(index)["type"]
            self._accessors[index] = self._add(self._values(index), FLOAT, kind)
        return self._accessors[index]

    def _values(self, index: int) -> Numbers:
        """Return the numbers of an accessor, (n, k); normalised ones are between -1 and 1."""
        accessor = self._accessor(index)
        n, k = accessor["count"], LENGTHS[accessor["type"]]
        self._n_elements += n
        if self._n_elements > MAX_ELEMENTS:
            raise AssetError(f"has accessors of more than {MAX_ELEMENTS} elements in all")
        dtype = np.dtype(DTYPES[accessor["componentType"]])
        if "bufferView" in accessor:
            values = self._numbers(accessor, dtype, n, k)
        else:
            values = np.zeros((n, k), dtype)
        if "sparse" in accessor:
            try:
                values = self._replace_values(values, accessor["sparse"])
            except (IndexError, KeyError, TypeError, ValueError):
                raise AssetError(
                    f"its accessors[{index}].sparse is invalid; expected indices below {n}, and "
                    "as many values, in views of its buffers"
                ) from None
        if accessor.get("normalized") and dtype.kind in "iu":
            max_value = np.iinfo(dtype).max
            values = np.maximum(values.astype(np.float32) / np.float32(max_value), np.float32(-1.0))
        return values

    def _replace_values(self, values: Numbers, sparse_part: Tree) -> Numbers:
        """Return values with those of a sparse accessor; raise one of many types of exceptions."""
        values, count = values.copy(), sparse_part["count"]
        index_view = sparse_part["indices"]
        index_dtype = np.dtype(DTYPES[index_view["componentType"]])
        indices = self._numbers(index_view, index_dtype, count, 1)[:, 0]
        values[indices] = self._numbers(sparse_part["values"], values.dtype, count, values.shape[1])
        return values

    def _numbers(self, part: Tree, dtype: np.dtype[Any], n: int, k: int) -> Numbers:
        """Return the numbers of a view of a buffer, (n, k); raise TypeError beyond its end."""
        view = self._tree["bufferViews"][part["bufferView"]]
        start = view.get("byteOffset", 0)
        data = memoryview(self._buffer(view["buffer"]))[start : start + view["byteLength"]]
        stride = view.get("byteStride") or dtype.itemsize * k
        return np.ndarray((n, k), dtype, data, part.get("byteOffset", 0), (stride, dtype.itemsize))

    def _check_files(self) -> None:
        """Raise AssetError if a file of a buffer is shorter than the buffer."""
        for index, buffer in enumerate(self._tree.get("buffers", [])):
            uri, n_bytes = buffer.get("uri"), buffer["byteLength"]
            if uri is None or uri.startswith("data:"):
                continue
            with suppress(FileNotFoundError):  # trimesh reports it
                n_found = len(self._buffer(index))
                if n_found < n_bytes:
                    raise AssetError(
                        f"its buffers[{index}].byteLength is {n_bytes}; expected at most the "
                        f"{n_found} bytes of {uri[:200]!r}"
                    )

    def _buffer(self, index: int) -> bytes:
        if index not in self._read:
            uri = self._tree["buffers"][index].get("uri")
            if uri is None:
                self._read[index] = self._chunk
            else:
                _, mark, text = uri.partition("base64,")
                self._read[index] = base64.b64decode(text) if mark else self._resolve(uri)
        return self._read[index]

    def _add(self, values: Numbers, component: int, kind: str) -> int:
        self._has_changed = True
        data = np.ascontiguousarray(values, DTYPES[component]).tobytes()
        view = {
            "buffer": len(self._tree["buffers"]),  # the one that is added at the end
            "byteOffset": len(self._buffer_bytes),
            "byteLength": len(data),
        }
        self._buffer_bytes += data
        self._tree["bufferViews"].append(view)
        accessor = {  # without the limits that a POSITION should have; trimesh needs none
            "bufferView": len(self._tree["bufferViews"]) - 1,
            "componentType": component,
            "count": len(values),
            "type": kind,
        }
        self._tree["accessors"].append(accessor)
        return len(self._tree["accessors"]) - 1


def _transform_uv(uv: Numbers, transform: Tree) -> Numbers:
    """Scale, rotate and move texture coordinates (KHR_texture_transform), (n, 2)."""
    angle = float(transform.get("rotation", 0.0))
    cos, sin = math.cos(angle), math.sin(angle)
    scale, offset = transform.get("scale", [1.0, 1.0]), transform.get("offset", [0.0, 0.0])
    u, v = uv[:, 0] * scale[0], uv[:, 1] * scale[1]
    transformed_uv: Numbers = np.stack(
        [cos * u + sin * v + offset[0], cos * v - sin * u + offset[1]], axis=-1
    )
    return transformed_uv
