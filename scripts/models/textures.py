"""Textures of models: those of the package, and worn paint and cement."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from uwsim.assets.mesh import Texture
from uwsim.assets.procedural.textures import (
    Colour,
    fill,
    mix,
    noise,
    paint_text,
    to_texture,
)
from uwsim.base import rng

from .cached import cache_image

Grey = npt.NDArray[Any]
"""A grey image, (h, w), about 0..1."""
Pixels = npt.NDArray[Any]
"""A colour image, (h, w, 3), 0..1, red green blue, row 0 at the top."""

__all__ = [
    "Colour",
    "Grey",
    "Pixels",
    "cement",
    "fill",
    "mix",
    "noise",
    "paint_text",
    "shading",
    "smoothstep",
    "to_texture",
    "worn_paint",
]


def smoothstep(low: float, high: float, value: Grey) -> Grey:
    """Return 0 below ``low``, 1 above ``high``, and a smooth step between."""
    t = np.clip((value - np.float32(low)) / np.float32(high - low), 0.0, 1.0)
    ramp: Grey = t * t * (3.0 - 2.0 * t)
    return ramp


def shading(height_map: Grey, strength: float, *, tiles: bool = False) -> Grey:
    """Return the shading of a height map, about 1: brighter on slopes that face the top left."""
    border = cv2.BORDER_WRAP if tiles else cv2.BORDER_REFLECT
    border_map = cv2.copyMakeBorder(height_map, 1, 1, 1, 1, border)
    slope = border_map[2:, 2:] - border_map[:-2, :-2]
    slope *= np.float32(strength)
    slope += np.float32(1.0)
    shade: Grey = np.clip(slope, 0.35, 1.7, out=slope)
    return shade


@cache_image
def worn_paint(name: str, colour: Colour, *, size: int = 256, grain: float = 0.06) -> Texture:
    """Return the texture of used paint or metal: cloudy, with fine scratches."""
    clouds = noise(f"{name}/clouds", size, size, cells=3, octaves=6)
    image = fill(size, size, colour) * (1.0 + np.float32(grain) * clouds)[:, :, None]
    streak = cv2.GaussianBlur(
        noise(f"{name}/streaks", size, size, cells=size // 2, octaves=1), (25, 1), 0
    )
    image *= (1.0 + np.float32(grain * 1.2) * streak / streak.std())[:, :, None]
    return to_texture(name, image)


@cache_image
def cement(name: str, colour: Colour, *, size: int = 512, joints: int = 0) -> Texture:
    """Return cement with stains and pores; ``joints`` tiles along each side when not 0."""
    clouds = noise(f"{name}/clouds", size, size, cells=2, octaves=7, gain=0.62)
    pores = noise(f"{name}/pores", size, size, cells=size // 4, octaves=2)
    image = fill(size, size, colour) * (1.0 + 0.07 * clouds)[:, :, None]
    image *= (1.0 - 0.30 * smoothstep(1.9, 2.6, pores) + 0.02 * pores)[:, :, None]
    if joints:
        stream = rng.stream(0, f"assets/{name}/tiles")
        shade = stream.normal(1.0, 0.035, (joints, joints)).astype(np.float32)
        image *= cv2.resize(shade, (size, size), interpolation=cv2.INTER_NEAREST)[:, :, None]
        edge = (np.arange(size) * joints / size) % 1.0
        distance = np.minimum(edge, 1.0 - edge) * size / joints  # pixels to the nearest joint
        gap = np.minimum(distance[:, None], distance[None, :]).astype(np.float32)
        image *= (1.0 - 0.45 * (1.0 - smoothstep(0.8, 2.4, gap)))[:, :, None]
    return to_texture(name, image)
