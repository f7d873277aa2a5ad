"""The sun's shadow map: one depth picture of the casters, redrawn only when they moved."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np

from ..geometry import Array
from .instance import INSTANCE, Instances, Slots
from .program import build

SMALL, LARGE = 512, 1024
"""Edges of the map [texels]; the small one costs a third of the large one to draw."""

FINE_TEXEL = 0.008
"""The small map is used while its texels are no larger than this [m]."""

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
        self._maps = {size: _depth_map(context, size) for size in (SMALL, LARGE)}
        self.texture = self._maps[SMALL]
        """The map now in use."""
        self._framebuffers = {
            size: context.framebuffer(depth_attachment=texture)
            for size, texture in self._maps.items()
        }
        self._program = build(context, "shadow", defines={}, blocks=[INSTANCE], samplers={})
        self._slots = Slots(context)
        self._drawn: object = None
        self.texture_from_world = np.eye(4)
        """W to texture coordinates and depth of the map, 0..1."""
        self.lift = 0.0
        """How far a receiver is pushed off along its normal [m]."""

    def update(
        self, instances: Instances, casters: Sequence[int], sun: Array, version: object
    ) -> None:
        """Draw the map, unless ``version`` and ``sun`` are those of the last drawing.

        Args:
            instances: All there are.
            casters: Rows of what casts shadows.
            sun: Unit vector towards the sun in W, (3,).
            version: Changes whenever a caster moved, came or went.
        """
        key = (version, tuple(sun))
        if key == self._drawn:
            return
        self._drawn = key
        _, spheres, _ = instances.owned(casters)
        clip_from_world, edge = _fit(spheres, sun)
        size = SMALL if edge / SMALL <= FINE_TEXEL else LARGE
        self.texture = self._maps[size]
        self.texture_from_world = _TO_TEXTURE @ clip_from_world
        self.lift = 1.5 * edge / size
        context = self._context
        self._framebuffers[size].use()
        self._framebuffers[size].clear(depth=1.0)
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        context.polygon_offset = 1.5, 2.0
        self._slots.fill(instances, casters, clip_from_world)
        for slot, row in enumerate(casters):
            self._slots.bind(slot)
            context.front_face = "cw" if instances.is_mirrored[row] else "ccw"
            for batch in instances.batches[row]:
                if batch.two_sided:
                    context.disable(moderngl.CULL_FACE)
                else:
                    context.enable(moderngl.CULL_FACE)
                batch.draw(self._program)
        context.polygon_offset = 0.0, 0.0

    def take_over(self) -> None:
        """Become the target of drawing: what was drawn so far goes to the rasteriser's threads."""
        self._framebuffers[SMALL].use()


def _fit(spheres: Array, sun: Array) -> tuple[Array, float]:
    """The sun's orthographic camera round all casters, (4, 4), and the edge of its view [m].

    Args:
        spheres: round the casters in W: centre and radius, (n, 4) [m].
        sun: Unit vector towards the sun in W, (3,).
    """
    forward = -sun
    aside = np.cross(forward, [0.0, 0.0, 1.0] if abs(sun[2]) < 0.9 else [1.0, 0.0, 0.0])
    aside /= np.linalg.norm(aside)
    axes = np.stack([aside, np.cross(aside, forward), forward])  # (3, 3)
    centres, radii = spheres[:, :3] @ axes.T, spheres[:, 3:]  # (n, 3), (n, 1) [m]
    low, high = (centres - radii).min(axis=0), (centres + radii).max(axis=0)
    half = max(high[0] - low[0], high[1] - low[1]) / 2.0
    reach = 20.0  # [m] below the casters where shadows still fall
    middle = (low + high) / 2.0
    scale = np.array([1.0 / half, 1.0 / half, 2.0 / (high[2] + reach - low[2])])
    matrix = np.eye(4)
    matrix[:3, :3] = axes * scale[:, None]
    matrix[:3, 3] = -scale * [middle[0], middle[1], (high[2] + reach + low[2]) / 2.0]
    return matrix, 2.0 * half


def _depth_map(context: moderngl.Context, size: int) -> moderngl.Texture:
    texture = context.depth_texture((size, size))
    texture.compare_func = "<="
    texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    texture.repeat_x = texture.repeat_y = False
    return texture
