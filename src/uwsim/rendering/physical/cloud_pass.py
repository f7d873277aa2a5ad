r"""The pass that draws clouds of sediment into three coarse textures.

Each puff (`uwsim.particles.puffs`) is drawn as some smaller Gaussians of its mass, variance and
centre, so that clouds have billows. The textures have the optical depth of all clouds up to four
ranges, between which a pixel takes the value of its own range, and the mean light of the clouds.
With the optical depth :math:`\tau` before the surface, the light is

.. math::
    I = I_{water} e^{-\tau} + (1 - e^{-\tau})\, [B + h\, (J_d - B)] +
        \frac{1 - e^{-k\tau}}{k}\, \sum_{lamps} \pi\, p(\Theta)\, E\, e^{-c_v (t + d)}

A thin cloud scatters the lamps' light once, with the phase function p of the water. The factor
k = 0.1 limits that of a thick one: it is as bright as a surface of the albedo :math:`\pi p / k`,
some 0.1. In daylight a thick cloud has the radiance :math:`J_d` of a level surface of its
colour. Surfaces, veil and particles behind and in a cloud are dimmed alike.

Not modelled: shadows of and in clouds, the blur by their scattering, the colour of thin parts.
"""

from __future__ import annotations

import moderngl
import numpy as np

from ..frame import FRAME
from ..lights.lamps import LAMPS
from ..program import Block, build
from .optics_block import OPTICS
from .visible_particles import LUMP, VisibleClouds

EDGE = 8
"""The edge of a texel of the clouds [px], as in ``shaders/cloud_edge.glsl``."""
CLOUDS = Block("Clouds", 10, {"cloud_layers": "vec4", "cloud_colour": "vec4"})
N_LAYERS = 4
LAYER_MARGIN = 2.5
"""The distance from centres at which the layers begin and end, in widths [1]."""


class CloudPass:
    """The pass that draws clouds; one for a renderer.

    Args:
        context: the context of the renderer.
        samplers: the texture unit of every sampler.
    """

    def __init__(self, context: moderngl.Context, samplers: dict[str, int]) -> None:
        self._context, self._samplers = context, samplers
        self._framebuffers: dict[tuple[int, int], moderngl.Framebuffer] = {}
        self._programs: dict[int, tuple[moderngl.Program, moderngl.VertexArray]] = {}
        self._lumps = context.buffer(reserve=256 * LUMP.itemsize, dynamic=True)
        self._values = np.zeros((), dtype=CLOUDS.dtype)
        self._block = context.buffer(reserve=CLOUDS.dtype.itemsize, dynamic=True)

    def draw(
        self, clouds: VisibleClouds, size: tuple[int, int], n_lamps: int
    ) -> tuple[moderngl.Texture, ...]:
        """Draw clouds; the textures of surfaces and open water must be bound.

        Args:
            clouds: the clouds.
            size: the width and height of the image [px].
            n_lamps: the number of lamps.

        Returns:
            The textures of the layers, of the lamps' light, and of the daylight.
        """
        context, lumps = self._context, clouds.lumps
        framebuffer = self._find_framebuffer(size)
        framebuffer.use()
        framebuffer.clear(0.0, 0.0, 0.0, 0.0)
        if lumps.nbytes > self._lumps.size:
            self._lumps.orphan(2 * lumps.nbytes)
        self._lumps.write(lumps.tobytes())
        places = lumps["place"].astype(np.float64)
        ranges = np.sqrt((places[:, :3] ** 2).sum(axis=1))
        first = max(float((ranges - LAYER_MARGIN * places[:, 3]).min()), 0.0)
        end = float((ranges + LAYER_MARGIN * places[:, 3]).max())
        self._values["cloud_layers"] = first, (end - first) / (N_LAYERS - 1), 0.0, 0.0
        self._values["cloud_colour"][:3] = clouds.colour
        self._block.write(self._values.tobytes())
        self._block.bind_to_uniform_block(CLOUDS.binding)
        context.enable_only(moderngl.BLEND)
        context.blend_func = moderngl.ONE, moderngl.ONE
        array = self._find_array(n_lamps)
        array.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=len(lumps))
        context.enable_only(moderngl.NOTHING)
        textures = framebuffer.color_attachments
        return tuple(texture for texture in textures if isinstance(texture, moderngl.Texture))

    def _find_framebuffer(self, size: tuple[int, int]) -> moderngl.Framebuffer:
        if size not in self._framebuffers:
            coarse_size = -(-size[0] // EDGE), -(-size[1] // EDGE)
            textures = [self._context.texture(coarse_size, 4, dtype="f4") for _ in range(3)]
            for texture in textures:
                texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
                texture.repeat_x = texture.repeat_y = False
            self._framebuffers[size] = self._context.framebuffer(textures)
        return self._framebuffers[size]

    def _find_array(self, n_lamps: int) -> moderngl.VertexArray:
        if n_lamps not in self._programs:
            program = build(
                self._context,
                "cloud",
                defines={"LAMPS": n_lamps} if n_lamps else {},
                blocks=(FRAME, OPTICS, LAMPS, CLOUDS),
                samplers=self._samplers,
            )
            members = (self._lumps, "4f 1f/i", "place", "depth")
            self._programs[n_lamps] = program, self._context.vertex_array(program, [members])
        return self._programs[n_lamps][1]
