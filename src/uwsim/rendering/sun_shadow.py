"""The sun's shadow map: one depth picture of the casters, redrawn only when they moved."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np

from ..geometry import Array
from .instance import INSTANCE, Instance
from .program import build

SIZE = 1024
LARGEST_CASTER = 5.0
"""Bounding radius [m] above which a model casts no shadow: tanks and sea floors."""

_TO_TEXTURE = np.array(
    [[0.5, 0.0, 0.0, 0.5], [0.0, 0.5, 0.0, 0.5], [0.0, 0.0, 0.5, 0.5], [0.0, 0.0, 0.0, 1.0]]
)


class SunShadow:
    """Which points the sun reaches, for the vehicles and objects of the scene.

    Terrain receives shadows and casts none: the walls of a tank would put all of it in the dark,
    where in truth the surface of the water scatters the light inward. Points farther from the
    casters than their shadows reach are lit. Not modelled: refraction at the surface.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self.texture = context.depth_texture((SIZE, SIZE))
        self.texture.compare_func = "<="
        self.texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
        self.texture.repeat_x = self.texture.repeat_y = False
        self._framebuffer = context.framebuffer(depth_attachment=self.texture)
        self._program = build(context, "shadow", defines={}, blocks=[INSTANCE], samplers={})
        self._slot = context.buffer(reserve=INSTANCE.dtype.itemsize, dynamic=True)
        self._drawn: object = None
        self.texture_from_world = np.eye(4)
        """W to texture coordinates and depth of the map, 0..1."""
        self.lift = 0.0
        """How far a receiver is pushed off along its normal [m]."""

    def update(self, casters: Sequence[Instance], sun: Array, version: object) -> None:
        """Draw the map, unless ``version`` and ``sun`` are those of the last drawing.

        Args:
            casters: What casts shadows.
            sun: Unit vector towards the sun in W, (3,).
            version: Changes whenever a caster moved, came or went.
        """
        key = (version, tuple(sun))
        if key == self._drawn:
            return
        self._drawn = key
        clip_from_world, texel = _fit(casters, sun)
        self.texture_from_world = _TO_TEXTURE @ clip_from_world
        self.lift = 1.5 * texel
        context = self._context
        self._framebuffer.use()
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        context.polygon_offset = 1.5, 2.0
        self._framebuffer.clear(depth=1.0)
        self._slot.bind_to_uniform_block(INSTANCE.binding)
        values = np.zeros((), dtype=INSTANCE.dtype)
        for caster in casters:
            values["camera_from_model"] = (clip_from_world @ caster.world_from_model).T
            self._slot.write(values.tobytes())
            for batch in caster.batches:
                batch.draw(self._program)
        context.polygon_offset = 0.0, 0.0


def _fit(casters: Sequence[Instance], sun: Array) -> tuple[Array, float]:
    """An orthographic camera of the sun around all casters: (4, 4), and its texel [m]."""
    forward = -sun
    aside = np.cross(forward, [0.0, 0.0, 1.0] if abs(sun[2]) < 0.9 else [1.0, 0.0, 0.0])
    aside /= np.linalg.norm(aside)
    axes = np.stack([aside, np.cross(aside, forward), forward])  # (3, 3)
    spheres = np.concatenate([caster.spheres for caster in casters])
    centres, radii = spheres[:, :3] @ axes.T, spheres[:, 3:]  # (n, 3), (n, 1) [m]
    low, high = (centres - radii).min(axis=0), (centres + radii).max(axis=0)
    half = max(high[0] - low[0], high[1] - low[1]) / 2.0
    reach = 20.0  # [m] below the casters where shadows still fall
    middle = (low + high) / 2.0
    scale = np.array([1.0 / half, 1.0 / half, 2.0 / (high[2] + reach - low[2])])
    matrix = np.eye(4)
    matrix[:3, :3] = axes * scale[:, None]
    matrix[:3, 3] = -scale * [middle[0], middle[1], (high[2] + reach + low[2]) / 2.0]
    return matrix, 2.0 * half / SIZE
