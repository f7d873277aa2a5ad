"""glTF files in plainer terms: what trimesh does not read, written as what it does.

Numbers that are normalised or sparse become plain ones; texture coordinates are those of the base
colour, with its transform applied; a colour of the vertices becomes their mean, times that of the
material; a fan becomes triangles. A file that requires an extension that is not read is refused.
"""

from __future__ import annotations

import base64
import json
import math
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import AssetError
from .gltf_limits import HEAD, MAX_ELEMENTS

Numbers = npt.NDArray[Any]
Tree = dict[str, Any]

READ = (
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_materials_",
)
"""Extensions, or beginnings of their names, without which a file would be another one. Of lights
and of what materials have beside a base colour nothing is drawn."""
DTYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""By ``componentType``."""
FLOAT, UNSIGNED = 5126, 5125
LENGTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
"""Numbers of an element, by ``type``."""
FAN = 6
TRANSFORM = "KHR_texture_transform"
SPECULAR = "KHR_materials_pbrSpecularGlossiness"
WEBP = "EXT_texture_webp"


def plain(data: bytes, suffix: str, resolve: Callable[[str], bytes]) -> bytes:
    """Return a ``.gltf`` or ``.glb`` file in plain terms; as it is, where it is plain.

    Args:
        data: the file.
        suffix: which of the two it is.
        resolve: returns the bytes of a file next to it.

    Raises:
        AssetError: it requires an extension that is not read, or its numbers are too many.
        Exception: of many kinds, where it is not as glTF should be.
    """
    is_binary = suffix == ".glb"
    end = HEAD + int.from_bytes(data[12:16], "little") if is_binary else len(data)
    try:
        tree = json.loads(data[HEAD:end] if is_binary else data)
    except (ValueError, RecursionError):
        return data  # trimesh says what is wrong
    if not isinstance(tree, dict):
        return data
    _check_extensions(tree)
    rewriting = _Rewriting(tree, data[end + 8 :] if is_binary else b"", resolve)
    if not rewriting.done():
        return data
    text = json.dumps(tree).encode()
    if not is_binary:
        return text
    text += b" " * (-len(text) % 4)
    rest = data[end:]
    head = b"glTF" + struct.pack("<II", 2, HEAD + len(text) + len(rest))
    return head + struct.pack("<I", len(text)) + b"JSON" + text + rest


def _check_extensions(tree: Tree) -> None:
    required = tree.get("extensionsRequired", [])
    for name in required if isinstance(required, list) else []:
        if not str(name).startswith(READ):
            raise AssetError(
                f"needs the extension {str(name)[:60]!r}, which is not read; export it without"
            )


class _Rewriting:
    """One file on its way; `done` changes the tree.

    Args:
        tree: its JSON.
        chunk: the binary part of a ``.glb``.
        resolve: returns the bytes of a file next to it.
    """

    def __init__(self, tree: Tree, chunk: bytes, resolve: Callable[[str], bytes]) -> None:
        self._tree, self._chunk, self._resolve = tree, chunk, resolve
        self._read: dict[int, bytes] = {}
        self._made: dict[object, int] = {}
        self._added = bytearray()
        self._n_elements = 0
        self._has_changed = False

    def done(self) -> bool:
        """Change what is not plain; returns whether anything was."""
        for texture in self._tree.get("textures", []):
            if WEBP in texture.get("extensions", {}) and "source" not in texture:
                texture["source"] = texture["extensions"][WEBP]["source"]
                self._has_changed = True
        for material in self._tree.get("materials", []):
            self._use_diffuse(material)
        for mesh in self._tree.get("meshes", []):
            for primitive in mesh.get("primitives", []):
                self._rewrite(primitive)
        if self._added:
            uri = "data:application/octet-stream;base64," + base64.b64encode(self._added).decode()
            entry = {"uri": uri, "byteLength": len(self._added)}
            self._tree.setdefault("buffers", []).append(entry)
        return self._has_changed

    def _use_diffuse(self, material: Tree) -> None:
        """Take the diffuse part of a material of specular and glossiness for its base colour."""
        found = material.get("extensions", {}).pop(SPECULAR, None)
        if found is None:
            return
        names = {"diffuseFactor": "baseColorFactor", "diffuseTexture": "baseColorTexture"}
        base = {new: found[old] for old, new in names.items() if old in found}
        material["pbrMetallicRoughness"] = base
        self._has_changed = True

    def _rewrite(self, primitive: Tree) -> None:
        """Write a primitive in plain terms."""
        attributes = primitive.get("attributes", {})
        if "POSITION" in attributes and not self._is_plain(attributes["POSITION"]):
            attributes["POSITION"] = self._floats(attributes["POSITION"])
        self._set_coordinates(primitive, attributes)
        if "COLOR_0" in attributes and "material" in primitive:
            self._set_colour(primitive, attributes.pop("COLOR_0"))
        elif "COLOR_0" in attributes and not self._is_plain(attributes["COLOR_0"]):
            attributes["COLOR_0"] = self._floats(attributes["COLOR_0"])
        if primitive.get("mode") == FAN:
            self._set_fan(primitive)
        elif "indices" in primitive and "sparse" in self._accessor(primitive["indices"]):
            indices = self._values(primitive["indices"]).astype("<u4")
            primitive["indices"] = self._add(indices, UNSIGNED, "SCALAR")

    def _set_coordinates(self, primitive: Tree, attributes: Tree) -> None:
        """Make the coordinates of the base colour's texture the only ones, as numbers 0..1."""
        texture = self._base_texture(primitive)
        transform = texture.get("extensions", {}).get(TRANSFORM, {})
        name = f"TEXCOORD_{transform.get('texCoord', texture.get('texCoord', 0))}"
        if name not in attributes:
            return
        index = attributes[name]
        is_float = self._accessor(index).get("componentType") == FLOAT
        if not transform and is_float and self._is_plain(index):
            new = index
        else:
            new = self._made.get(key := (index, json.dumps(transform, sort_keys=True)), -1)
            if new < 0:
                uv = _transformed(self._values(index), transform)
                new = self._made[key] = self._add(uv, FLOAT, "VEC2")
        if attributes.get("TEXCOORD_0") != new:
            attributes["TEXCOORD_0"] = new
            self._has_changed = True

    def _base_texture(self, primitive: Tree) -> Tree:
        """The reference of a primitive's material to the texture of its base colour."""
        if "material" not in primitive:
            return {}
        material = self._tree["materials"][primitive["material"]]
        found = material.get("pbrMetallicRoughness", {}).get("baseColorTexture", {})
        return found if isinstance(found, dict) else {}

    def _set_colour(self, primitive: Tree, index: int) -> None:
        """Give a primitive a material of its own, times the mean colour of its vertices."""
        self._has_changed = True
        mean = self._values(index)[:, :3].mean(axis=0, dtype=np.float64).tolist()
        if min(mean) > 1.0 - 1e-3:
            return  # white: most files that have one
        material = self._tree["materials"][primitive["material"]]
        base = material.get("pbrMetallicRoughness", {})
        factor = base.get("baseColorFactor", [1.0, 1.0, 1.0, 1.0])
        factor = [*(a * b for a, b in zip(factor, mean, strict=False)), *factor[3:]]
        base = {**base, "baseColorFactor": factor}
        self._tree["materials"].append({**material, "pbrMetallicRoughness": base})
        primitive["material"] = len(self._tree["materials"]) - 1

    def _set_fan(self, primitive: Tree) -> None:
        """Write a fan as triangles."""
        if "indices" in primitive:
            corners = self._values(primitive["indices"]).astype("<u4").ravel()
        else:
            n = self._accessor(primitive["attributes"]["POSITION"])["count"]
            corners = np.arange(n, dtype="<u4")
        first = np.full(max(len(corners) - 2, 0), corners[0] if len(corners) else 0, "<u4")
        triangles = np.stack([first, corners[1:-1], corners[2:]], axis=-1)
        primitive["indices"] = self._add(triangles.reshape(-1, 1), UNSIGNED, "SCALAR")
        primitive["mode"] = 4

    def _accessor(self, index: int) -> Tree:
        found: Tree = self._tree["accessors"][index]
        return found

    def _is_plain(self, index: int) -> bool:
        accessor = self._accessor(index)
        return not accessor.get("normalized") and "sparse" not in accessor

    def _floats(self, index: int) -> int:
        """The number of a plain accessor with the values of another."""
        if index not in self._made:
            kind = self._accessor(index)["type"]
            self._made[index] = self._add(self._values(index), FLOAT, kind)
        return self._made[index]

    def _values(self, index: int) -> Numbers:
        """The numbers of an accessor, (n, k); the normalised between -1 and 1."""
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
            sparse = accessor["sparse"]
            values, count = values.copy(), sparse["count"]
            places = sparse["indices"]
            of_places = np.dtype(DTYPES[places["componentType"]])
            at = self._numbers(places, of_places, count, 1)[:, 0]
            values[at] = self._numbers(sparse["values"], dtype, count, k)
        if accessor.get("normalized") and dtype.kind in "iu":
            largest = np.iinfo(dtype).max
            values = np.maximum(values.astype(np.float32) / np.float32(largest), np.float32(-1.0))
        return values

    def _numbers(self, part: Tree, dtype: np.dtype[Any], n: int, k: int) -> Numbers:
        """Numbers of a view of a buffer, (n, k); raises TypeError beyond its end."""
        view = self._tree["bufferViews"][part["bufferView"]]
        start = view.get("byteOffset", 0)
        data = memoryview(self._buffer(view["buffer"]))[start : start + view["byteLength"]]
        stride = view.get("byteStride") or dtype.itemsize * k
        return np.ndarray((n, k), dtype, data, part.get("byteOffset", 0), (stride, dtype.itemsize))

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
        """Add an accessor with these numbers; returns its number."""
        self._has_changed = True
        data = np.ascontiguousarray(values, DTYPES[component]).tobytes()
        view = {
            "buffer": len(self._tree["buffers"]),  # the one that is added at the end
            "byteOffset": len(self._added),
            "byteLength": len(data),
        }
        self._added += data
        self._tree["bufferViews"].append(view)
        accessor = {  # without the limits that a POSITION should have; trimesh asks for none
            "bufferView": len(self._tree["bufferViews"]) - 1,
            "componentType": component,
            "count": len(values),
            "type": kind,
        }
        self._tree["accessors"].append(accessor)
        return len(self._tree["accessors"]) - 1


def _transformed(uv: Numbers, transform: Tree) -> Numbers:
    """Scaled, turned and moved texture coordinates (KHR_texture_transform), (n, 2)."""
    angle = float(transform.get("rotation", 0.0))
    cos, sin = math.cos(angle), math.sin(angle)
    scale, offset = transform.get("scale", [1.0, 1.0]), transform.get("offset", [0.0, 0.0])
    u, v = uv[:, 0] * scale[0], uv[:, 1] * scale[1]
    moved: Numbers = np.stack(
        [cos * u + sin * v + offset[0], cos * v - sin * u + offset[1]], axis=-1
    )
    return moved
