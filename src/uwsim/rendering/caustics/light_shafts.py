r"""Light shafts: the sun's beam that waves focus, scattered once by the water into the camera.

The radiance of open water (`physical.daylight_field`) has a part by the sun's beam below a level
surface. A moving surface multiplies the beam by the gain :math:`G` (`caustic_map`). The difference
along a ray to the surface in the range :math:`R` is

.. math::
    \Delta B = \frac{\pi}{\mu_w}\, \min(b\, p(\Theta), r\, b^* p^*(\Theta)) \int_0^R
        E_b(z)\, m(z)\, (G(x, z) - 1)\, e^{-c^* t}\, dt

with :math:`m` the contrast that scattering leaves (`caustic_light.find_contrast_loss`). The mean of
:math:`G` is 1, so the mean of open water stays, whatever the phase function is. The limit :math:`r`
keeps the sum from being negative: 3, but 15 on rays to a surface with the image of the sun, whose
aureole is the mean of these shafts.

The integral has up to 24 steps in an image of an eighth of the resolution. They end on cylinders
around the beam through the camera, whose radii grow as squares: so the points of one step lie along
beams, and few steps make straight shafts. Points on spheres make clouds. Each step reads the mean
of the map over a square from the maps' mipmaps. A square of the step's length would be as wide as
it is long, and hide the shafts beside each other; one of 0.3 of it leaves the contrast of 400
steps, within 16 %.

Not modelled: shadows of bodies in the shafts, and shafts that a camera in air sees.
"""

from __future__ import annotations

import moderngl

from ...base.geometry import Intrinsics
from ..frame import FRAME
from ..physical.optics_block import OPTICS
from ..program import build
from .caustic_light import CAUSTICS

RATIO = 8
"""The edge of a texel of the image of shafts [px]."""
N_STEPS = 24
"""The greatest number of steps along a ray."""
MAP_SHARE = 0.3
"""The edge of the square of a map that a step averages, over the way of the step [1]."""
SWITCHES = {
    "RATIO": RATIO,
    "N_STEPS": N_STEPS,
    "MAP_LEVEL": 1,
    "MAP_PERCENT": round(100 * MAP_SHARE),
}
"""The switches of the shader that are the same in all scenes; the page has them, too."""
SURFACE_UNIT = 0
"""The texture unit of the image of surfaces."""


class LightShafts:
    """The pass of light shafts of a renderer.

    Args:
        context: the context of the renderer.
        samplers: the texture unit of the maps of caustics.
    """

    def __init__(self, context: moderngl.Context, samplers: dict[str, int]) -> None:
        self._context = context
        self._samplers = samplers | {"surface_image": SURFACE_UNIT}
        self._buffers: dict[tuple[int, int], moderngl.Framebuffer] = {}
        self._programs: dict[object, moderngl.VertexArray] = {}

    def draw(
        self,
        intrinsics: Intrinsics,
        surfaces: moderngl.Texture,
        *,
        has_swell: bool,
        n_slices: int,
    ) -> moderngl.Texture:
        """Draw the shafts; return their radiance, which may be negative.

        The blocks of the image are filled, and the maps of caustics are bound.

        Args:
            intrinsics: the pinhole of the camera.
            surfaces: the radiance and the range of surfaces, four floats.
            has_swell: True if the surface has long waves.
            n_slices: the number of maps of caustics.
        """
        size = -(-intrinsics.width // RATIO), -(-intrinsics.height // RATIO)
        if size not in self._buffers:
            texture = self._context.texture(size, 4, dtype="f4")
            texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
            texture.repeat_x = texture.repeat_y = False
            self._buffers[size] = self._context.framebuffer([texture])
        self._context.enable_only(moderngl.NOTHING)
        surfaces.use(SURFACE_UNIT)
        buffer = self._buffers[size]
        buffer.use()
        self._find_program(has_swell, n_slices).render(moderngl.TRIANGLES, vertices=3)
        image = buffer.color_attachments[0]
        assert isinstance(image, moderngl.Texture)
        return image

    def _find_program(self, has_swell: bool, n_slices: int) -> moderngl.VertexArray:
        key = has_swell, n_slices
        if key not in self._programs:
            defines = {**SWITCHES, "N_SLICES": n_slices}
            program = build(
                self._context,
                "light_shafts",
                defines=defines | ({"SWELL": 1} if has_swell else {}),
                blocks=(FRAME, OPTICS, CAUSTICS),
                samplers=self._samplers,
                vertex="screen",
            )
            self._programs[key] = self._context.vertex_array(program, [])
        return self._programs[key]
