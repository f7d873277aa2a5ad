"""Draw calls over whole images: the programs and vertex arrays of the passes of physical water."""

from __future__ import annotations

import moderngl

from ..lights.lamps import LAMPS
from ..program import build
from .cloud_pass import CLOUDS
from .optics_block import OPTICS

SCREEN = "screen"
"""The vertex shader of passes without one of their own."""
OWN_VERTICES = ("scattered", "blurred", "developed")
"""The passes whose vertex shader computes what is constant or linear over the image."""

Switches = tuple[tuple[str, int], ...]


class WholeImagePasses:
    """The programs of passes over whole images, compiled when they are first used.

    Args:
        context: the context of the renderer.
        samplers: the texture unit of every sampler.
    """

    def __init__(self, context: moderngl.Context, samplers: dict[str, int]) -> None:
        self._context, self._samplers = context, samplers
        self._arrays: dict[object, moderngl.VertexArray] = {}

    def find_array(self, effect: str, switches: Switches) -> moderngl.VertexArray:
        """Return the vertex array of a pass; draw its three vertices as a triangle."""
        key = effect, switches
        if key not in self._arrays:
            program = build(
                self._context,
                effect,
                defines=dict(switches),
                blocks=(OPTICS, LAMPS, CLOUDS),
                samplers=self._samplers,
                vertex=None if effect in OWN_VERTICES else SCREEN,
            )
            self._arrays[key] = self._context.vertex_array(program, [])
        return self._arrays[key]
