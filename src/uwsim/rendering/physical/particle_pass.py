r"""The pass that draws particles: marine snow and bubbles.

A particle of radius :math:`a` at range :math:`r` and irradiance E is a soft disc of its true
angular size with the radiance :math:`J = \rho E`, where a white surface in the irradiance 1 has the
radiance 1. Its image carries

.. math:: L\, \Omega = \rho E\, \frac{\pi a^2}{r^2} e^{-c r}

however many pixels it has: a disc below the least radius is drawn with that radius and less
coverage, and so are the blur of the lens, :math:`A\, |1/r - 1/F|` of an aperture A focused at F,
and the streak of the motion during the exposure. A particle that scatters evenly with the albedo
:math:`\omega` has :math:`\rho = \omega / 4`, and the irradiance of a level field counts twice: in
an isotropic field a particle with :math:`\omega = 1` is invisible. The light of lamps is that on
surfaces, with both legs, lobes and shadows.

Particles are drawn from the farthest to the nearest, each over those behind it with its coverage
:math:`\alpha`. The texture has the light :math:`S \leftarrow (1 - \alpha) S + \alpha\, e^{-c r}
(J - B)` with the light B of open water, and the coverage of all, by which the light of surfaces
behind decreases. The weights of the particles and of what is behind add up to 1: however dense the
particles are, no colour lies outside those of the particles, the water and the surfaces. Not
modelled: the shade of particles on each other, the blur of their light by the water, the sun's
shadow and caustics on them, and the change of the lobe of scattering with the direction.
"""

from __future__ import annotations

import moderngl
import numpy as np
import numpy.typing as npt

from ...particles import PARTICLE
from ..frame import FRAME
from ..lights.lamps import LAMPS
from ..program import Block, build
from .optics_block import OPTICS
from .visible_particles import VisibleParticles

MIN_RADIUS = 1.5
"""The least radius of the image of a particle [px]; smaller ones would flicker."""
LENS = Block("ParticleLens", 9, {"particle_lens": "vec4"})
FORMAT = "4f 4f 2f"
"""The format of `PARTICLE` for OpenGL."""
CORNERS = np.array([0, 1, 2, 2, 1, 3], np.uint32)
"""The vertices of the two triangles of a particle."""


class ParticlePass:
    """The pass that draws particles into a texture; one for a renderer.

    Args:
        context: the context of the renderer.
        samplers: the texture unit of every sampler.
    """

    def __init__(self, context: moderngl.Context, samplers: dict[str, int]) -> None:
        self._context, self._samplers = context, samplers
        self._framebuffers: dict[tuple[int, int], moderngl.Framebuffer] = {}
        self._programs: dict[int, tuple[moderngl.Program, moderngl.VertexArray]] = {}
        self._records = context.buffer(reserve=4096 * PARTICLE.itemsize, dynamic=True)
        self._corners = context.buffer(reserve=1024 * CORNERS.nbytes, dynamic=True)
        self._n_corners = 0  # the number of particles whose corners are in the buffer
        self._lens_values = np.zeros((), dtype=LENS.dtype)
        self._lens = context.buffer(reserve=LENS.dtype.itemsize, dynamic=True)

    def draw(
        self, particles: VisibleParticles, size: tuple[int, int], n_lamps: int
    ) -> moderngl.Texture:
        """Draw particles; the textures of surfaces and open water must be bound.

        Args:
            particles: the particles.
            size: the width and height of the image [px].
            n_lamps: the number of lamps.
        """
        context = self._context
        if size not in self._framebuffers:
            sums = context.texture(size, 4, dtype="f4")
            sums.filter = (moderngl.NEAREST, moderngl.NEAREST)
            self._framebuffers[size] = context.framebuffer([sums])
        framebuffer = self._framebuffers[size]
        framebuffer.use()
        framebuffer.clear(0.0, 0.0, 0.0, 0.0)
        records = particles.records
        if len(records):
            # Mesa's software renderer takes four vertices for each particle in less time than an
            # instance for each.
            vertices = np.repeat(sort_by_range(records), 4)
            if vertices.nbytes > self._records.size:
                self._records.orphan(2 * vertices.nbytes)
            self._records.write(vertices.tobytes())
            self._write_corners(len(records))
            self._lens_values["particle_lens"] = (
                0.5 * particles.aperture,
                1.0 / particles.focus_distance,
                MIN_RADIUS,
                0.0,
            )
            self._lens.write(self._lens_values.tobytes())
            self._lens.bind_to_uniform_block(LENS.binding)
            context.enable_only(moderngl.BLEND)
            context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
            array = self._find_array(n_lamps)
            array.render(moderngl.TRIANGLES, vertices=6 * len(records))
            context.enable_only(moderngl.NOTHING)
        texture = framebuffer.color_attachments[0]
        assert isinstance(texture, moderngl.Texture)
        return texture

    def _write_corners(self, n: int) -> None:
        """Write the indices of the vertices of at least n particles."""
        if n <= self._n_corners:
            return
        self._n_corners = 2 * n
        first_vertices = np.arange(0, 4 * self._n_corners, 4, dtype=np.uint32)
        corners = (first_vertices[:, None] + CORNERS).tobytes()
        self._corners.orphan(len(corners))
        self._corners.write(corners)

    def _find_array(self, n_lamps: int) -> moderngl.VertexArray:
        if n_lamps not in self._programs:
            program = build(
                self._context,
                "particle",
                defines={"LAMPS": n_lamps} if n_lamps else {},
                blocks=(FRAME, OPTICS, LAMPS, LENS),
                samplers=self._samplers,
            )
            members = (self._records, FORMAT, "place", "extent", "traits")
            self._programs[n_lamps] = (
                program,
                self._context.vertex_array(program, [members], self._corners),
            )
        return self._programs[n_lamps][1]


def sort_by_range(records: npt.NDArray[np.void]) -> npt.NDArray[np.void]:
    """Return particles from the farthest to the nearest; equal ranges keep their order."""
    place = records["place"]
    squares = place[:, 0] ** 2 + place[:, 1] ** 2 + place[:, 2] ** 2
    return records[np.argsort(-squares, kind="stable")]
