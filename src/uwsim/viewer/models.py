"""Meshes and textures of a scene as the page reads them."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from ..assets.mesh import Model, Texture
from ..rendering.merged import Merged, Piece, merged
from .pack import Blob

QUALITY = 95
"""Of textures as WebP with losses, 0..100."""
MAX_LOSS = 12.0
"""A texture of which one value in 100 loses more is kept exactly, [grey levels] ..."""
MAX_EXACT = 70_000
"""... if that takes no more bytes."""


class Models:
    """Collects meshes and textures, each once.

    Args:
        blob: where their numbers go.
    """

    def __init__(self, blob: Blob) -> None:
        self._blob = blob
        self.meshes: list[dict[str, Any]] = []
        """The meshes so far, as in the head."""
        self.textures: list[dict[str, Any]] = []
        """The textures so far, as in the head."""
        self._known: dict[int, tuple[Model, list[dict[str, Any]]]] = {}
        self._images: dict[str, int] = {}

    def looks(self, model: Model) -> list[dict[str, Any]]:
        """Return what a model consists of: number of the mesh and of the texture, and the rest."""
        if id(model) not in self._known:
            looks = [
                {
                    "mesh": self._mesh(each),
                    "texture": None if each.texture is None else self._texture(each.texture),
                    "opacity": each.opacity,
                    "two_sided": each.two_sided,
                }
                for each in merged(model)
            ]
            self._known[id(model)] = model, looks  # holds the model, so that its id stays its own
        return self._known[id(model)][1]

    def pattern(self, pixels: npt.NDArray[np.uint8]) -> int:
        """Return the number of the texture of a projector's pattern (h, w, 4), exact."""
        return self._add("pattern", pixels, _encoded(pixels, lossless=True), repeats=False)

    def _mesh(self, each: Merged) -> int:
        vertices, add = each.vertices, self._blob.add
        used = each.triangles.ravel()
        small = len(vertices) < 2**16
        self.meshes.append(
            {
                "positions": add(vertices["vertex"]),
                "normals": add(np.rint(vertices["vertex_normal"] * 32767.0).astype("<i2")),
                "uvs": None if each.texture is None else add(vertices["uv"]),
                "tints": add(np.rint(vertices["tint"] * 65535.0).astype("<u2")),
                "triangles": add(used.astype("<u2" if small else "<u4")),
                "pieces": [_piece(piece) for piece in each.pieces],
            }
        )
        return len(self.meshes) - 1

    def _texture(self, texture: Texture) -> int:
        if texture.name in self._images:
            return self._images[texture.name]
        data = _encoded(texture.pixels, quality=QUALITY, method=4)
        if _loss(texture.pixels, data) > MAX_LOSS:
            exact = _encoded(texture.pixels, lossless=True, quality=60, method=4)
            data = exact if len(exact) <= MAX_EXACT else data
        return self._add(texture.name, texture.pixels, data, repeats=texture.repeats)

    def _add(self, name: str, pixels: npt.NDArray[np.uint8], data: bytes, *, repeats: bool) -> int:
        height, width = pixels.shape[:2]
        self._images[name] = len(self.textures)
        self.textures.append(
            {
                "type": "image/webp",
                "bytes": self._blob.add_bytes(data),
                "width": width,
                "height": height,
                "repeats": repeats,
            }
        )
        return self._images[name]


def _encoded(pixels: npt.NDArray[np.uint8], **options: Any) -> bytes:
    """Return an image (h, w, 3 or 4) as WebP."""
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, "WEBP", exact=True, **options)
    return stream.getvalue()


def _loss(pixels: npt.NDArray[np.uint8], data: bytes) -> float:
    """Return what 99 of 100 values of an image lose at most [grey levels]."""
    found = np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), dtype=np.int16)
    return float(np.percentile(np.abs(found - pixels), 99.0))


def _piece(piece: Piece) -> list[float]:
    """First index, count, centre, radius, lower and upper corner, normal, density."""
    low, high = piece.corners.min(axis=0), piece.corners.max(axis=0)
    values = [*piece.centre, piece.radius, *low, *high, *piece.normal, piece.density]
    return [piece.first, piece.size, *(float(f"{value:.6g}") for value in values)]
