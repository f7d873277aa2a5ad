"""The radiance of the sky and of the open water below the surface, as two small textures."""

from __future__ import annotations

import moderngl
import numpy as np

from ...base.geometry import Array
from ..physical.daylight_field import compute_open_water
from ..physical.physical_water import PhysicalWater
from .sky import Sky

SIZE = 128
"""The width and height of a hemisphere [px]."""


class Hemispheres:
    """A texture with two layers: the sky by upward, the water by downward directions.

    A direction (x, y, z) is at (x, y) / (1 + |z|), from -1 to 1 across the texture.

    Args:
        context: the context of the renderer.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self.texture: moderngl.TextureArray = context.texture_array((SIZE, SIZE, 2), 4, dtype="f4")
        """The layers, of four floats."""
        self.texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
        self.texture.repeat_x = self.texture.repeat_y = False
        self._key: object = None

    def update(self, water: PhysicalWater, sky: Sky, light_rate: float) -> None:
        """Compute and upload both layers, unless they are those of the last image."""
        key = water.medium, water.daylight, light_rate
        if key == self._key:
            return
        self._key = key
        directions = compute_directions()
        layers = (
            light_rate * sky.compute_radiance(directions),
            compute_open_water(water, 0.0, directions * [1.0, 1.0, -1.0], light_rate),
        )
        pixels = np.zeros((2, SIZE * SIZE, 4), np.float32)
        for layer, radiance in zip(pixels, layers, strict=True):
            layer[:, :3] = radiance
        self.texture.write(pixels.tobytes())


def compute_directions() -> Array:
    """Compute the upward unit vector of each texel, (SIZE^2, 3); outside of them the horizon's."""
    place = np.linspace(-1.0, 1.0, SIZE)
    x, y = (grid.ravel() for grid in np.meshgrid(place, place))
    radius = np.sqrt(x * x + y * y)
    stretch = np.maximum(radius, 1.0)
    square = np.minimum(radius * radius, 1.0)
    factor = 2.0 / (1.0 + square) / stretch
    return np.stack([factor * x, factor * y, (1.0 - square) / (1.0 + square)], axis=1)
