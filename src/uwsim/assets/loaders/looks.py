"""Materials of a mesh file: colours and textures."""

from __future__ import annotations

import hashlib
import io
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import AssetError
from ..mesh import Texture

MAX_TEXTURE_SIDE = 2048
"""Textures are reduced to this many pixels a side."""
MAX_PIXELS = 8192 * 8192
"""Largest image [px]: it is decoded whole."""
MAX_PIXELS_IN_ALL = 4 * MAX_PIXELS
"""Of all images of a model [px]."""
FORMATS = ("BMP", "DDS", "GIF", "JPEG", "MPO", "PNG", "PPM", "SGI", "TGA", "TIFF", "WEBP")
"""Images that are decoded; Pillow knows others, some of them programs."""


def check_size(data: bytes, name: object) -> None:
    """Refuse an image that is too large for Pillow, which trimesh would silently leave out.

    Raises:
        AssetError: it is one.
    """
    from PIL import Image

    try:
        with Image.open(io.BytesIO(data)):
            pass
    except Image.DecompressionBombError as error:
        raise AssetError(
            f"{name}: an image of too many pixels; at most {MAX_PIXELS / 1e6:.0f} million are read"
        ) from error
    except Exception:  # no image, or a broken one: whoever wants one says so
        pass


def opened(data: bytes) -> Any:
    """Return an image that is decoded later, with what Pillow raises if it is none."""
    from PIL import Image

    return Image.open(io.BytesIO(data))


def is_broken(path: Path, *, is_decoded: bool) -> bool:
    """Whether a file of an image cannot be opened, or not decoded, which takes longer."""
    from PIL import Image

    try:
        with Image.open(path) as image:
            if is_decoded and image.width * image.height <= MAX_PIXELS:
                image.load()
    except Exception:  # Pillow raises whatever its decoders raise
        return True
    return False


GREY = (0.7, 0.7, 0.7)
"""The colour of what has none."""
WHITE = (1.0, 1.0, 1.0)
"""The same by the specification of glTF 2.0 (3.7.2.1, "default material")."""

Look = tuple[tuple[float, float, float], Texture | None]


class Looks:
    """The materials of one file; parts of one material share its texture."""

    def __init__(self, path: Path) -> None:
        self._path, self._is_gltf = path, path.suffix.lower() in (".gltf", ".glb")
        self._n_pixels = 0
        self.has_broken_image = False
        """Whether an image could not be decoded."""
        self._of_material: dict[int, tuple[Any, Look]] = {}

    def of(self, visual: Any) -> Look:
        """Colour and texture of a trimesh visual.

        Raises:
            AssetError: its image is too large, or of a type that is not read.
        """
        material = getattr(visual, "material", None)
        if material is None:
            if getattr(visual, "kind", None) not in ("face", "vertex"):
                return (WHITE if self._is_gltf else GREY), None
            colours = np.asarray(visual.face_colors, dtype=np.float64)
            red, green, blue = (colours[:, :3].mean(axis=0) / 255.0).tolist()
            return (red, green, blue), None
        if id(material) not in self._of_material:
            self._of_material[id(material)] = material, self._look(material)
        return self._of_material[id(material)][1]

    def _look(self, material: Any) -> Look:
        image = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
        texture = None if image is None else self._texture(image)
        if texture is not None and not self._is_gltf:
            # A file's diffuse factor beside an image is usually an exporter's default: not used.
            return (1.0, 1.0, 1.0), texture
        factor = getattr(material, "baseColorFactor", None)
        if factor is None and hasattr(material, "diffuse"):
            factor = material.diffuse
        numbers = np.asarray(factor if factor is not None else (255, 255, 255), dtype=np.float64)
        numbers = numbers[:3] / (255.0 if numbers.max() > 1.0 else 1.0)
        red, green, blue = np.clip(numbers, 0.0, 1.0).tolist()
        return (red, green, blue), texture

    def _texture(self, image: Any) -> Texture | None:
        """Decode an image, which was only opened; None if it is broken."""
        n = image.width * image.height
        self._n_pixels += n
        if n > MAX_PIXELS or self._n_pixels > MAX_PIXELS_IN_ALL:
            raise AssetError(
                f"{self._path}: an image of {image.width} x {image.height} pixels; at most "
                f"{MAX_PIXELS / 1e6:.0f} million are read, and {MAX_PIXELS_IN_ALL / 1e6:.0f} "
                "in a model."
            )
        if image.format not in (None, *FORMATS):
            raise AssetError(
                f"{self._path}: an image is {image.format}; expected {', '.join(FORMATS)}."
            )
        try:
            rgb = image.convert("RGB")
            rgb.thumbnail((MAX_TEXTURE_SIDE, MAX_TEXTURE_SIDE))
            pixels = np.array(rgb, dtype=np.uint8)
        except Exception:  # Pillow raises whatever its decoders raise
            self.has_broken_image = True
            return None
        digest = hashlib.sha256(pixels.tobytes()).hexdigest()[:16]
        return Texture(name=f"{self._path}#{digest}", pixels=pixels)
