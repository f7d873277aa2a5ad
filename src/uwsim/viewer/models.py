"""Meshes and textures of a scene as the page reads them."""

from __future__ import annotations

import hashlib
import io
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from ..assets.mesh import Model, Texture
from ..rendering.materials.maps import find_maps, find_mask
from ..rendering.materials.masked_levels import compute_masked_levels
from ..rendering.materials.reflectance import compute_table
from ..rendering.merged import MergedMesh, Piece, merge_model
from .pack import Blob, Ref

TEXTURE_QUALITY = 95
"""The quality of lossy WebP and JPEG textures, 0..100."""
NUMBER_MAPS = ("normal_map", "finish_map")
"""The maps whose channels are numbers and not colours, by their names in the shaders."""
MAX_LOSS = 12.0
"""The greatest 99th percentile of the error of a lossy texture [grey levels]; see `_encode`."""
RGB_CHANNELS = 3
"""The number of channels of an image without alpha."""
MAX_EXACT_BYTES = 70_000
"""The greatest size of a lossless texture [bytes]; a larger texture is stored lossy."""


class Models:
    """The meshes and textures of a scene, each once.

    Args:
        blob: the binary part of the pack, to which their arrays are appended.
        has_finish: True if finish and emission are included, which only physical water needs.
    """

    def __init__(self, blob: Blob, *, has_finish: bool = False) -> None:
        self._blob, self._has_finish = blob, has_finish
        self.meshes: list[dict[str, Any]] = []
        """The entries of ``meshes`` in the head so far."""
        self.textures: list[dict[str, Any]] = []
        """The entries of ``textures`` in the head so far."""
        self._visuals: dict[int, tuple[Model, list[dict[str, Any]]]] = {}
        self._texture_indices: dict[str, int] = {}
        self._mesh_indices: dict[bytes, int] = {}  # by the digest of their numbers

    def visuals(self, model: Model) -> list[dict[str, Any]]:
        """Return the entries of ``visuals`` in the head for a model: one for each merged mesh."""
        if id(model) not in self._visuals:
            visuals = [
                {
                    "mesh": self._mesh(part),
                    "texture": None if part.texture is None else self._base(part.texture, part),
                    "opacity": part.opacity,
                    "two_sided": part.two_sided,
                    **self._material(part),
                }
                for part in merge_model(model)
            ]
            self._visuals[id(model)] = model, visuals  # keeps the model, so that its id is unique
        return self._visuals[id(model)][1]

    def _material(self, part: MergedMesh) -> dict[str, Any]:
        """Return the entry ``material`` of a visual; nothing, if the page needs none."""
        maps, material = self._maps(part), part.material
        cutoff = None if material is None else material.alpha_cutoff
        if material is None or not (maps or self._has_finish or cutoff is not None):
            return {}
        return {
            "material": {
                "maps": {
                    name: self._texture(texture, has_numbers=name in NUMBER_MAPS)
                    for name, texture in maps.items()
                },
                "cutoff": cutoff,
                "emits": self._has_finish and any(material.emission),
            }
        }

    def _maps(self, part: MergedMesh) -> dict[str, Texture]:
        """Return the maps of a mesh that the page needs, by their names in the shaders."""
        maps = find_maps(part.material)
        return {
            name: texture
            for name, texture in maps.items()
            if name == "normal_map" or self._has_finish
        }

    def reflectance(self) -> dict[str, Ref]:
        """Return the entry ``reflectance`` of the head; nothing if no surface has a finish."""
        if not any("finish" in mesh for mesh in self.meshes) or not self._has_finish:
            return {}
        return {"reflectance": self._blob.add(compute_table())}

    def pattern(self, pixels: npt.NDArray[np.uint8]) -> int:
        """Return the index of the texture of a projector's pattern (h, w, 4), lossless."""
        data = _encode_image(pixels, "webp", lossless=True)
        return self._add("pattern", pixels, ("webp", data), repeats=False)

    def _mesh(self, part: MergedMesh) -> int:
        arrays, pieces = self._arrays(part), [_piece(piece) for piece in part.pieces]
        digest = hashlib.sha256(repr(pieces).encode())
        for name, array in arrays.items():
            digest.update(f"{name} {array.size} {array.dtype}".encode())
            digest.update(np.ascontiguousarray(array).tobytes())
        key = digest.digest()
        if key not in self._mesh_indices:
            self._mesh_indices[key] = len(self.meshes)
            rows = {name: self._blob.add(array) for name, array in arrays.items()}
            self.meshes.append({"uvs": None, **rows, "pieces": pieces})
        return self._mesh_indices[key]

    def _arrays(self, part: MergedMesh) -> dict[str, npt.NDArray[Any]]:
        """Return the arrays of a mesh that the page needs, by their names in the head."""
        vertices, indices, maps = part.vertices, part.triangles.ravel(), self._maps(part)
        arrays = {}
        if part.material is not None and (maps or self._has_finish):
            arrays["finish"] = vertices["finish"]
            arrays["emissions"] = vertices["emission"]
        if "normal_map" in maps:
            arrays["tangents"] = np.rint(vertices["tangent"] * 32767.0).astype("<i2")
        arrays["positions"] = vertices["vertex"]
        arrays["normals"] = np.rint(vertices["vertex_normal"] * 32767.0).astype("<i2")
        if part.texture is not None or maps:
            arrays["uvs"] = vertices["uv"]
        arrays["tints"] = np.rint(vertices["tint"] * 65535.0).astype("<u2")
        arrays["triangles"] = indices.astype("<u2" if len(vertices) < 2**16 else "<u4")
        return arrays

    def _base(self, texture: Texture, part: MergedMesh) -> int:
        """Return the index of a base colour; with holes, it has its smaller images (`levels`)."""
        index, mask = self._texture(texture), find_mask(part.texture, part.material)
        if mask is not None and "levels" not in self.textures[index]:
            self.textures[index]["levels"] = [
                self._blob.add_bytes(_encode_image(pixels, "webp", lossless=True))
                for pixels in compute_masked_levels(texture.pixels, mask.cutoff)
            ]
        return index

    def _texture(self, texture: Texture, *, has_numbers: bool = False) -> int:
        if texture.name in self._texture_indices:
            return self._texture_indices[texture.name]
        file = _encode(texture, has_numbers=has_numbers)
        return self._add(texture.name, texture.pixels, file, repeats=texture.repeats)

    def _add(
        self, name: str, pixels: npt.NDArray[np.uint8], file: tuple[str, bytes], *, repeats: bool
    ) -> int:
        """Return the index of a new texture from its file: the format and the bytes."""
        image_format, data = file
        height, width = pixels.shape[:2]
        self._texture_indices[name] = len(self.textures)
        self.textures.append(
            {
                "type": f"image/{image_format}",
                "bytes": self._blob.add_bytes(data),
                "width": width,
                "height": height,
                "repeats": repeats,
            }
        )
        return self._texture_indices[name]


def _encode(texture: Texture, *, has_numbers: bool) -> tuple[str, bytes]:
    """Encode a texture: the format and the bytes of the file.

    Args:
        texture: the texture. If it is from a JPEG file, the file is used: no second loss.
        has_numbers: True if its channels are numbers. Lossy WebP halves the resolution of
            differences between channels, so numbers are stored as JPEG, which can keep it.
    """
    if texture.jpeg is not None:
        return "jpeg", texture.jpeg
    pixels, image_format = texture.pixels, "webp"
    if has_numbers:
        image_format, options = "jpeg", {"subsampling": 0, "optimize": True}
        data = _encode_image(pixels, "jpeg", quality=TEXTURE_QUALITY, **options)
    else:
        data = _encode_image(pixels, "webp", quality=TEXTURE_QUALITY, method=4)
    if _loss(pixels, data) > MAX_LOSS:
        exact_data = _encode_image(pixels, "webp", lossless=True, quality=60, method=4)
        if len(exact_data) <= MAX_EXACT_BYTES:
            return "webp", exact_data
    return image_format, data


def _encode_image(pixels: npt.NDArray[np.uint8], image_format: str, **options: Any) -> bytes:
    stream = io.BytesIO()
    if image_format == "webp":
        options["exact"] = True  # the colours of transparent pixels too
    Image.fromarray(pixels).save(stream, image_format, **options)
    return stream.getvalue()


def _loss(pixels: npt.NDArray[np.uint8], data: bytes) -> float:
    """Return the 99th percentile of the error of an encoded image's values [grey levels]."""
    mode = "RGB" if pixels.shape[2] == RGB_CHANNELS else "RGBA"
    pixels_again = np.asarray(Image.open(io.BytesIO(data)).convert(mode), dtype=np.int16)
    return float(np.percentile(np.abs(pixels_again - pixels), 99.0))


def _piece(piece: Piece) -> list[float]:
    """Return first index, count, centre, radius, lower and upper corner, normal, density."""
    low, high = piece.corners.min(axis=0), piece.corners.max(axis=0)
    values = [*piece.centre, piece.radius, *low, *high, *piece.normal, piece.density]
    return [piece.first_index, piece.size, *(float(f"{value:.6g}") for value in values)]
