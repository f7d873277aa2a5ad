"""The materials of a mesh file: colours, textures, and maps of normals and finish."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import AssetError
from ..images import PixelImage
from ..mesh import Material, Texture
from .gltf_materials import GltfMaterial

MAX_TEXTURE_SIDE = 2048
"""The greatest side of a texture [px]; larger ones are reduced."""
MAX_PIXELS = 8192 * 8192
"""The greatest number of pixels of an image, which is decoded as a whole [px]."""
MAX_TOTAL_PIXELS = 4 * MAX_PIXELS
"""The greatest number of pixels of all images of a model [px]."""
ALPHA_CHANNELS = 4
"""The number of channels of an image with alpha."""
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


@dataclass(frozen=True, kw_only=True)
class Appearance:
    """The appearance of a part of a file."""

    colour: tuple[float, float, float]
    """The colour, by which the texture is multiplied."""
    texture: Texture | None = None
    """The texture of the base colour."""
    material: Material | None = None
    """The properties besides the base colour."""
    opacity: float = 1.0
    """The opacity, 0 to 1."""
    two_sided: bool = True
    """True if back faces are drawn."""
    has_maps: bool = False
    """True if the normals and tangents of the file are used."""


class Materials:
    """The materials of one file; parts with the same material share one texture.

    Args:
        path: the file.
        gltf_materials: the numbers of the materials of a glTF file, by their names.
    """

    def __init__(self, path: Path, gltf_materials: Mapping[str, GltfMaterial]) -> None:
        self._path, self._is_gltf = path, path.suffix.lower() in (".gltf", ".glb")
        self._gltf_materials = gltf_materials
        self._n_pixels = 0
        self.has_broken_image = False
        """True if an image could not be decoded."""
        self._appearances: dict[int, tuple[Any, Appearance]] = {}
        self._maps: dict[object, tuple[object, Texture | None]] = {}

    def appearance(self, visual: Any) -> Appearance:
        """Return the appearance of a trimesh visual.

        Raises:
            AssetError: the image is too large, or of an unsupported type.
        """
        material = getattr(visual, "material", None)
        if material is None:
            if getattr(visual, "kind", None) not in ("face", "vertex"):
                return Appearance(colour=WHITE if self._is_gltf else GREY)
            colours = np.asarray(visual.face_colors, dtype=np.float64)
            red, green, blue = (colours[:, :3].mean(axis=0) / 255.0).tolist()
            return Appearance(colour=(red, green, blue))
        if id(material) not in self._appearances:
            self._appearances[id(material)] = material, self._material_appearance(material)
        return self._appearances[id(material)][1]

    def _material_appearance(self, material: Any) -> Appearance:
        numbers = self._gltf_materials.get(str(getattr(material, "name", "")))
        has_holes = numbers is not None and numbers.alpha_cutoff is not None
        is_blended = numbers is not None and numbers.opacity < 1.0
        image = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
        texture = None
        if image is not None:
            texture = self._texture(image, "RGBA" if has_holes and has_alpha(image) else "RGB")
        colour = self._base_colour(material, texture)
        if numbers is None:
            return Appearance(colour=colour, texture=texture)
        properties = Material(
            roughness=numbers.roughness,
            metallic=numbers.metallic,
            finish_map=self._finish_map(material, numbers.occlusion_strength),
            normal_map=self._map(getattr(material, "normalTexture", None)),
            normal_scale=numbers.normal_scale,
            emission=numbers.emission,
            emission_map=self._map(getattr(material, "emissiveTexture", None)),
            alpha_cutoff=(
                numbers.alpha_cutoff
                if texture is not None and texture.pixels.shape[2] == ALPHA_CHANNELS
                else None
            ),
        )
        return Appearance(
            colour=colour,
            texture=texture,
            material=properties,
            opacity=numbers.opacity if is_blended else 1.0,
            two_sided=numbers.two_sided or not numbers.has_maps,
            has_maps=numbers.has_maps,
        )

    def _base_colour(self, material: Any, texture: Texture | None) -> tuple[float, float, float]:
        if texture is not None and not self._is_gltf:
            # A file's diffuse factor beside an image is usually an exporter's default: not used.
            return (1.0, 1.0, 1.0)
        factor = getattr(material, "baseColorFactor", None)
        if factor is None and hasattr(material, "diffuse"):
            factor = material.diffuse
        numbers = np.asarray(factor if factor is not None else (255, 255, 255), dtype=np.float64)
        numbers = numbers[:3] / (255.0 if numbers.max() > 1.0 else 1.0)
        red, green, blue = np.clip(numbers, 0.0, 1.0).tolist()
        return (red, green, blue)

    def _finish_map(self, material: Any, strength: float) -> Texture | None:
        """Return occlusion, roughness and metal in one texture; None without an image of them."""
        occlusion_image = getattr(material, "occlusionTexture", None)
        finish_image = getattr(material, "metallicRoughnessTexture", None)
        key = "finish", id(occlusion_image), id(finish_image), strength
        if key not in self._maps:
            occlusion, finish = self._map(occlusion_image), self._map(finish_image)
            pixels = pack_finish(
                None if occlusion is None else occlusion.pixels,
                None if finish is None else finish.pixels,
                strength,
            )
            texture = None if pixels is None else self._create_texture(pixels)
            self._maps[key] = (occlusion_image, finish_image), texture
        return self._maps[key][1]

    def _map(self, image: Any) -> Texture | None:
        """Return the texture of an image that is not a base colour, decoded once."""
        if image is None:
            return None
        if id(image) not in self._maps:
            self._maps[id(image)] = image, self._texture(image)
        return self._maps[id(image)][1]

    def _texture(self, image: Any, mode: str = "RGB") -> Texture | None:
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
            converted_image = convert_image(image, mode)
            converted_image.thumbnail((MAX_TEXTURE_SIDE, MAX_TEXTURE_SIDE))
            pixels = np.array(converted_image, dtype=np.uint8)
        except Exception:  # Pillow raises whatever its decoders raise
            self.has_broken_image = True
            return None
        return self._create_texture(pixels)

    def _create_texture(self, pixels: npt.NDArray[np.uint8]) -> Texture:
        digest = hashlib.sha256(pixels.tobytes()).hexdigest()[:16]
        return Texture(name=f"{self._path}#{digest}", image=PixelImage(pixels))


def has_alpha(image: Any) -> bool:
    """Return whether an image has an alpha channel, or a transparent colour."""
    return "A" in image.getbands() or "transparency" in image.info


def convert_image(image: Any, mode: str) -> Any:
    """Convert an image to 8 bits a channel; Pillow would clip grey values of 16 bits at 255."""
    from PIL import Image

    if image.mode.startswith("I;16") or image.mode == "I":
        values = np.asarray(image, dtype=np.float64) / 257.0
        image = Image.fromarray(np.clip(np.rint(values), 0.0, 255.0).astype(np.uint8))
    elif image.mode == "F":
        values = np.asarray(image, dtype=np.float64) * 255.0
        image = Image.fromarray(np.clip(np.rint(values), 0.0, 255.0).astype(np.uint8))
    return image.convert(mode)


def pack_finish(
    occlusion: npt.NDArray[np.uint8] | None, finish: npt.NDArray[np.uint8] | None, strength: float
) -> npt.NDArray[np.uint8] | None:
    """Pack occlusion, roughness and metal into one image, (h, w, 3); None if both are absent.

    Args:
        occlusion: an image whose red channel is occlusion.
        finish: an image whose green and blue channels are roughness and metal.
        strength: the strength of the occlusion, 0 to 1.
    """
    from PIL import Image

    images = [image for image in (occlusion, finish) if image is not None]
    if not images:
        return None
    height, width = (max(image.shape[k] for image in images) for k in range(2))

    def resize(image: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
        if image.shape[:2] == (height, width):
            return image
        scaled_image = Image.fromarray(image).resize((width, height), Image.Resampling.BILINEAR)
        return np.array(scaled_image, dtype=np.uint8)

    pixels = np.full((height, width, 3), 255, np.uint8)
    if finish is not None:
        pixels[..., 1:] = resize(finish)[..., 1:]
    if occlusion is not None:
        values = 255.0 + strength * (resize(occlusion)[..., 0] - 255.0)
        pixels[..., 0] = np.rint(values).astype(np.uint8)
    return pixels
