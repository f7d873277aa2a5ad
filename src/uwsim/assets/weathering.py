r"""Weathering: light and dark patches on the textures of a model, different for each pattern.

.. math:: c' = c\,(1 + s\,n_k(u, v))

clipped to 0..255. :math:`n_k` is smooth noise of zero mean and unit deviation, which the pattern's
number k selects, with 6 cells along the shorter side of a texture and finer ones; s is the
strength. Not modelled: growth that changes the shape or has its own colour. Meshes without a
texture do not change.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..base.numerics.opencv import deterministic_opencv
from .images import PixelImage
from .mesh import Model, Texture

CACHE_SIZE = 16
"""The number of cached models; each seed of a scene with variations has other models."""


@lru_cache(maxsize=CACHE_SIZE)
def weather_model(model: Model, pattern: int, strength: float) -> Model:
    """Return the model with a pattern of patches; unchanged with the pattern 0 or strength 0."""
    if pattern == 0 or strength == 0.0:
        return model
    textures: dict[int, Texture] = {}  # one for all meshes that share the texture
    meshes = []
    for mesh in model.meshes:
        texture = mesh.texture
        if texture is not None:
            weathered_texture = textures.get(id(texture)) or _add_clouds(texture, pattern, strength)
            textures[id(texture)] = weathered_texture
            mesh = replace(mesh, texture=weathered_texture)
        meshes.append(mesh)
    return replace(model, meshes=tuple(meshes))


def _add_clouds(texture: Texture, pattern: int, strength: float) -> Texture:
    from .procedural.textures import noise

    height, width = texture.pixels.shape[:2]
    with deterministic_opencv():
        name = f"weathering/{pattern}"
        clouds = noise(name, height, width, cells=6, octaves=5, tiles=texture.repeats)
    factor = 1.0 + np.float32(strength) * clouds  # (h, w)
    pixels = texture.pixels.copy()
    colours = np.rint(pixels[..., :3] * factor[..., None])
    pixels[..., :3] = np.clip(colours, 0.0, 255.0).astype(np.uint8)
    return replace(texture, name=f"{texture.name}+{pattern}*{strength:g}", image=PixelImage(pixels))
