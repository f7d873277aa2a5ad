r"""Weathering: light and dark patches on the textures of a model, different for each pattern.

.. math:: c' = c\,(1 + s\,n_k(u, v))

cut to 0..255, with :math:`n_k` smooth noise of zero mean and unit deviation that the pattern's
number k names, in 6 cells along the shorter side of a texture and finer ones, and the strength s.
Not modelled: growth that changes the shape, colours of their own. Meshes without a texture stay as
they are.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..base.numerics.opencv import deterministic_opencv
from .mesh import Model, Texture

KEPT = 16
"""So many weathered models are kept: each seed of a scene that varies has others."""


@lru_cache(maxsize=KEPT)
def weathered(model: Model, pattern: int, strength: float) -> Model:
    """Return the model with a pattern of clouds on it; pattern 0 or strength 0 is the model."""
    if pattern == 0 or strength == 0.0:
        return model
    textures: dict[int, Texture] = {}  # one object a texture, however many meshes wear it
    meshes = []
    for mesh in model.meshes:
        texture = mesh.texture
        if texture is not None:
            made = textures.get(id(texture)) or _clouded(texture, pattern, strength)
            textures[id(texture)] = made
            mesh = replace(mesh, texture=made)
        meshes.append(mesh)
    return replace(model, meshes=tuple(meshes))


def _clouded(texture: Texture, pattern: int, strength: float) -> Texture:
    from .procedural.textures import noise

    height, width = texture.pixels.shape[:2]
    with deterministic_opencv():
        name = f"weathering/{pattern}"
        clouds = noise(name, height, width, cells=6, octaves=5, tiles=texture.repeats)
    factor = 1.0 + np.float32(strength) * clouds  # (h, w)
    pixels = texture.pixels.copy()
    clouded = np.rint(pixels[..., :3] * factor[..., None])
    pixels[..., :3] = np.clip(clouded, 0.0, 255.0).astype(np.uint8)
    return replace(texture, name=f"{texture.name}+{pattern}*{strength:g}", pixels=pixels)
