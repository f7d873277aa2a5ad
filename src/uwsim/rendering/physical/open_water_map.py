"""The radiance of open water over the image, as a small texture."""

from __future__ import annotations

import moderngl
import numpy as np

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.linear import rotate_rows
from .daylight_field import compute_open_water
from .physical_water import PhysicalWater

SIZE = (41, 31)
"""The number of columns and rows of the texture."""


class OpenWaterMap:
    """The texture of the open water's radiance B; its outer texels are at the image's corners."""

    def __init__(self, context: moderngl.Context) -> None:
        self.texture: moderngl.Texture = context.texture(SIZE, 4, dtype="f4")
        """The texture, of four floats."""
        self.texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
        self.texture.repeat_x = self.texture.repeat_y = False
        self._pixels = np.zeros((SIZE[1], SIZE[0], 4), np.float32)
        self._key: object = None

    def update(
        self,
        water: PhysicalWater,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        surface_height: float,
        light_rate: float,
    ) -> None:
        """Compute and upload the radiance, unless it is that of the last image."""
        depth = surface_height - float(world_from_camera.position[2])
        key = water, intrinsics, depth, light_rate, world_from_camera.rotation.tobytes()
        if key == self._key:
            return
        self._key = key
        rays = compute_corner_rays(intrinsics)
        directions = rotate_rows(world_from_camera.rotation, rays.reshape(-1, 3))
        radiance = compute_open_water(water, depth, directions, light_rate)
        self._pixels[..., :3] = radiance.reshape(SIZE[1], SIZE[0], 3)
        self.texture.write(self._pixels.tobytes())


def compute_corner_rays(intrinsics: Intrinsics) -> Array:
    """Compute the unit rays of a grid over the image, from corner to corner, camera frame (OpenGL).

    Returns:
        The rays, (rows, columns, 3).
    """
    lens = intrinsics
    columns = np.linspace(-0.5, lens.width - 0.5, SIZE[0])[None, :]
    rows = np.linspace(-0.5, lens.height - 0.5, SIZE[1])[:, None]
    y = -(rows - lens.cy) / lens.fy + 0.0 * columns
    x = (columns - lens.cx - lens.skew * y) / lens.fx
    rays = np.stack([x, y, np.full_like(x, -1.0)], axis=-1)
    unit: Array = rays / np.sqrt((rays * rays).sum(axis=-1, keepdims=True))
    return unit
