"""The materials of a mesh file: colours and textures."""

from __future__ import annotations

import hashlib
import io
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import AssetError
from ..mesh import Texture

MAX_TEXTURE_SIDE = 2048
"""The greatest side of a texture [px]; larger ones are reduced."""
MAX_PIXELS = 8192 * 8192
"""The greatest number of pixels of an image, which is decoded as a whole [px]."""
MAX_TOTAL_PIXELS = 4 * MAX_PIXELS
"""The greatest number of pixels of all images of a model [px]."""
FORMATS = ("BMP", "DDS", "GIF", "JPEG", "MPO", "PNG", "PPM", "SGI", "TGA", "TIFF", "WEBP")
"""The image formats that are decoded; Pillow reads others, some of which are programs."""


def check_image_size(data: bytes, name: object) -> None:
    """Reject an image that is too large for Pillow, which trimesh would silently leave out.

    Raises:
        AssetError: the image is too large.
    """
    from PIL import Image

    try:
        with Image.open(io.BytesIO(data)):
            pass
    except Image.DecompressionBombError as error:
        raise AssetError(
            f"{name}: an image of too many pixels; at most {MAX_PIXELS / 1e6:.0f} million are read"
        ) from error
    except Exception:  # no image, or a broken one: its readers report it
        pass


def open_image(data: bytes) -> Any:
    """Open an image that is decoded later; raise the errors of Pillow if it is not one."""
    from PIL import Image

    return Image.open(io.BytesIO(data))


def is_broken(path: Path, *, is_decoded: bool) -> bool:
    """Return whether an image file cannot be opened, or cannot be decoded, which takes longer."""
    from PIL import Image

    try:
        with Image.open(path) as image:
            if is_decoded and image.width * image.height <= MAX_PIXELS:
                image.load()
    except Exception:  # Pillow raises whatever its decoders raise
        return True
    return False


GREY = (0.7, 0.7, 0.7)
"""The colour of a part without a material."""
WHITE = (1.0, 1.0, 1.0)
"""The colour of a part without a material in glTF 2.0 (3.7.2.1, "default material")."""

Appearance = tuple[tuple[float, float, float], Texture | None]


class Materials:
    """The materials of one file; parts with the same material share one texture."""

    def __init__(self, path: Path) -> None:
        self._path, self._is_gltf = path, path.suffix.lower() in (".gltf", ".glb")
        self._n_pixels = 0
        self.has_broken_image = False
        """True if an image could not be decoded."""
        self._appearances: dict[int, tuple[Any, Appearance]] = {}

    def appearance(self, visual: Any) -> Appearance:
        """Return the colour and texture of a trimesh visual.

        Raises:
            AssetError: the image is too large, or of an unsupported type.
        """
        material = getattr(visual, "material", None)
        if material is None:
            if getattr(visual, "kind", None) not in ("face", "vertex"):
                return (WHITE if self._is_gltf else GREY), None
            colours = np.asarray(visual.face_colors, dtype=np.float64)
            red, green, blue = (colours[:, :3].mean(axis=0) / 255.0).tolist()
            return (red, green, blue), None
        if id(material) not in self._appearances:
            self._appearances[id(material)] = material, self._material_appearance(material)
        return self._appearances[id(material)][1]

    def _material_appearance(self, material: Any) -> Appearance:
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
        if n > MAX_PIXELS or self._n_pixels > MAX_TOTAL_PIXELS:
            raise AssetError(
                f"{self._path}: an image has {image.width} x {image.height} pixels; at most "
                f"{MAX_PIXELS / 1e6:.0f} million are read, and {MAX_TOTAL_PIXELS / 1e6:.0f} "
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
