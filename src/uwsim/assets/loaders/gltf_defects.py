"""Parts of glTF files that cannot be used, and are left out with a remark.

trimesh leaves out images that it cannot open, and coordinates that are not numbers, without a word.
`read_defects` finds both in the file itself. What makes a file invalid as a whole is found by
`gltf_structure`; images that open and cannot be decoded are found by `materials`.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import numpy as np

from ...errors import AssetError
from .gltf_limits import GLB_JSON_START
from .materials import check_image_size, open_image

Tree = dict[str, Any]

FLOAT = 5126
"""The ``componentType`` of numbers that may be infinite."""
LENGTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
"""The number of components of an element, by ``type``."""
WEBP = "EXT_texture_webp"
CONSEQUENCES = {
    "NORMAL": "normals are computed from the faces",
    "TANGENT": "tangents are computed from the texture coordinates",
    "TEXCOORD": "0 is used for them",
    "COLOR": "the colour may be wrong",
}
"""The consequences of numbers that are not finite, by the beginning of the attribute."""
MAX_REMARKS = 5
"""The greatest number of remarks on a file."""


def read_defects(data: bytes, suffix: str, resolve: Callable[[str], bytes]) -> list[str]:
    """Return remarks on images that cannot be opened, and on numbers that are not finite.

    Args:
        data: a file that `gltf_structure` has checked.
        suffix: ``.gltf`` or ``.glb``.
        resolve: a function that returns the bytes of a file next to it.

    Raises:
        AssetError: an image is too large, or outside the folders that may be read.
    """
    chunk = b""
    if suffix == ".glb":
        end = GLB_JSON_START + int.from_bytes(data[12:16], "little")
        data, chunk = data[GLB_JSON_START:end], data[end + 8 :]
    file = _File(json.loads(data), chunk, resolve)
    remarks = [*file.find_images(), *file.find_numbers()]
    if len(remarks) > MAX_REMARKS:
        remarks[MAX_REMARKS:] = [f"{len(remarks) - MAX_REMARKS} more of its parts are left out"]
    return remarks


class _File:
    """The images and numbers of a file.

    Args:
        tree: the JSON of the file, in which indices and lengths are valid.
        chunk: the binary part of a ``.glb``.
        resolve: a function that returns the bytes of a file next to it.
    """

    def __init__(self, tree: Tree, chunk: bytes, resolve: Callable[[str], bytes]) -> None:
        self._tree, self._chunk, self._resolve = tree, chunk, resolve
        self._buffers: dict[int, bytes] = {}

    def find_images(self) -> Iterator[str]:
        """Report the images of textures that cannot be opened."""
        sources = {_image_index(texture) for texture in self._tree.get("textures", [])}
        for number, image in enumerate(self._tree.get("images", [])):
            if number in sources and (defect := self._image_defect(f"images[{number}]", image)):
                yield f"its images[{number}] {defect}: the materials are drawn without it"

    def find_numbers(self) -> Iterator[str]:
        """Report attributes of vertices, besides positions, whose numbers are not finite."""
        are_finite: dict[int, bool] = {}
        for number, mesh in enumerate(self._tree.get("meshes", [])):
            for part, primitive in enumerate(mesh["primitives"]):
                place = f"meshes[{number}].primitives[{part}].attributes"
                for name, index in primitive["attributes"].items():
                    consequence = CONSEQUENCES.get(name.partition("_")[0])
                    if consequence is None:
                        continue
                    if index not in are_finite:
                        are_finite[index] = self._is_finite(self._tree["accessors"][index])
                    if not are_finite[index]:
                        text = "has numbers that are infinite or not numbers"
                        yield f"its {place}.{name[:40]} {text}: {consequence}"

    def _image_defect(self, place: str, image: Tree) -> str:
        """Return why an image cannot be used; empty if it can be opened."""
        uri = image.get("uri")
        if uri is None and "bufferView" not in image:
            return "has neither a uri nor a bufferView"
        if uri is not None and not isinstance(uri, str):
            return f"has the uri {uri!r:.60}, which is no text"
        is_link = uri is not None and "://" in uri
        try:
            data = self._image_bytes(image)
        except AssetError:
            raise
        except FileNotFoundError:
            reason = "is a link, and nothing is downloaded" if is_link else "is missing"
            return f"is {str(uri)[:200]!r}, which {reason}"
        except Exception:  # errors of base64 and of lengths
            return "has data that cannot be read"
        check_image_size(data, f"its {place}")
        try:
            with open_image(data) as opened_image:
                width, height = opened_image.size
        except Exception:  # Pillow raises whatever its readers raise
            return "is not an image that can be read"
        return "" if width * height > 0 else f"has {width} x {height} pixels"

    def _image_bytes(self, image: Tree) -> bytes:
        if "uri" in image:
            return self._read_uri(image["uri"])
        view = self._tree["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        return self._buffer(view["buffer"])[start : start + view["byteLength"]]

    def _is_finite(self, accessor: Tree) -> bool:
        """Return whether the numbers of an accessor are finite, except those of a sparse part."""
        if accessor.get("componentType") != FLOAT or "bufferView" not in accessor:
            return True
        k = LENGTHS.get(accessor["type"], 0)
        view = self._tree["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0)
        with suppress(Exception):  # the readers report lengths and missing files
            data = memoryview(self._buffer(view["buffer"]))[start : start + view["byteLength"]]
            stride = (view.get("byteStride") or 4 * k, 4)
            offset = accessor.get("byteOffset", 0)
            values = np.ndarray((accessor["count"], k), "<f4", data, offset, stride)
            return bool(np.isfinite(values).all())
        return True

    def _buffer(self, index: int) -> bytes:
        if index not in self._buffers:
            uri = self._tree["buffers"][index].get("uri")
            self._buffers[index] = self._chunk if uri is None else self._read_uri(uri)
        return self._buffers[index]

    def _read_uri(self, uri: str) -> bytes:
        _, mark, text = uri.partition("base64,")
        return base64.b64decode(text) if mark else self._resolve(uri)


def _image_index(texture: Tree) -> object:
    """Return the index of the image of a texture, as `gltf_rewriting` chooses it."""
    if "source" in texture:
        return texture["source"]
    extensions = texture.get("extensions")
    extension = extensions.get(WEBP) if isinstance(extensions, dict) else None
    index = extension.get("source") if isinstance(extension, dict) else None
    return index if isinstance(index, int) else None
