"""The passes that turn an image of surfaces without water into one through physical water.

The surface pass has written the radiance J of each pixel's surface and its range. Then follow, on
whole images: what each level of blur scatters (half the resolution), the wider levels at halves of
the resolution before, their Gaussians, the sum from the widest to the narrowest with the veil of
the lamps, and the composition with exposure and curve. A reference in numpy is in the tests.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import moderngl
import numpy as np

from ...base.geometry import Intrinsics, Pose
from ...optics import Medium
from ..caustics.light_shafts import RATIO as SHAFT_RATIO
from ..lights.lamp import Lamp
from ..lights.lamps import LAMPS
from ..program import build
from .blur_plan import MAX_LEVELS, BlurPlan, compute_radius, plan_blur
from .blur_weights import N_RANGES, compute_weight_table
from .cloud_pass import CLOUDS, CloudPass
from .open_water_map import OpenWaterMap
from .optics_block import OPTICS, OpticsBlock
from .particle_pass import ParticlePass
from .physical_water import PhysicalWater
from .visible_particles import VisibleParticles

SURFACE_UNIT, MAP_UNIT, TABLE_UNIT, FIRST_LEVEL_UNIT = 0, 5, 6, 7
"""The texture units of the image of surfaces, the open water, the weights, and the first level."""
LAMP_MAP_UNIT, CLOUD_UNIT, PARTICLE_UNIT = 2, 10, 13
"""The texture units of the lamps' shadow maps, as in the surface pass, of the first of the three
textures of clouds, which follow the blur and use units of its levels, and of the particles."""
SHAFT_UNIT = 3
"""The texture unit of light shafts, which the surface pass uses for a projector."""
SAMPLERS = {
    "surface_image": SURFACE_UNIT,
    "open_water_map": MAP_UNIT,
    "weight_table": TABLE_UNIT,
    **{f"level_{i}": FIRST_LEVEL_UNIT + i for i in range(MAX_LEVELS - 2)},
    "lamp_maps": LAMP_MAP_UNIT,
    "particle_image": PARTICLE_UNIT,
    "cloud_layers_map": CLOUD_UNIT,
    "cloud_lamplight_map": CLOUD_UNIT + 1,
    "cloud_daylight_map": CLOUD_UNIT + 2,
    "shaft_image": SHAFT_UNIT,
}
"""The texture unit of every sampler of these passes."""
SCREEN = "screen"
"""The vertex shader of these passes."""

Switches = tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Level:
    """The textures of a coarse level of blur."""

    rows: moderngl.Framebuffer
    """The level after the Gaussian along its rows."""
    total: moderngl.Framebuffer
    """The level after its Gaussian, plus the wider levels."""


class Buffers:
    """The framebuffers of the blur for one size of images.

    Args:
        context: the context of the renderer.
        size: the width and height of the image [px].
        n_levels: the number of levels of blur.
    """

    def __init__(self, context: moderngl.Context, size: tuple[int, int], n_levels: int) -> None:
        self.sources: list[moderngl.Framebuffer] = []
        """The scattered light: of the first level, with the mean light beside it; then of all the
        others; then of these without the narrowest; and so on."""
        self.levels: list[Level] = []
        """The blurred levels, the narrowest first; one at least."""
        for level in range(max(n_levels, 1)):
            size = _halve(size)
            n_textures = min(n_levels, 1) + 1 if level == 0 else n_levels - level
            textures = [_texture(context, size) for _ in range(n_textures)]
            self.sources.append(context.framebuffer(textures))
            rows, total = (context.framebuffer([_texture(context, size)]) for _ in range(2))
            self.levels.append(Level(rows, total))


class Development:
    """The passes of physical water; one for a renderer.

    Args:
        context: the context of the renderer.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._block = OpticsBlock(context)
        self._map = OpenWaterMap(context)
        self._table = _texture(context, (N_RANGES, 1 + MAX_LEVELS))
        self._table_key: tuple[Medium, tuple[float, ...]] | None = None
        self._buffers: dict[object, Buffers] = {}
        self._particles = ParticlePass(context, SAMPLERS)
        self._clouds = CloudPass(context, SAMPLERS)
        self._programs: dict[object, tuple[moderngl.Program, moderngl.VertexArray]] = {}

    def prepare(
        self,
        water: PhysicalWater,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        surface_height: float,
        lamps: Sequence[Lamp],
        light_rate: float,
    ) -> None:
        """Fill the uniform block and the texture of the open water, before surfaces are drawn."""
        self._block.fill(water, intrinsics, lamps, light_rate)
        plan = plan_blur(intrinsics, has_blur=water.has_blur)
        key = water.medium, plan.sigmas
        if plan.n_levels and key != self._table_key:
            weights = compute_weight_table(*key, plan.highest_frequency)
            pixels = np.zeros((1 + MAX_LEVELS, N_RANGES, 4), np.float32)
            pixels[: len(weights), :, :3] = weights
            self._table.write(pixels.tobytes())
            self._table_key = key
        self._map.update(water, world_from_camera, intrinsics, surface_height, light_rate)

    def use_textures(self) -> None:
        """Bind the textures of the open water and of the weights."""
        self._map.texture.use(MAP_UNIT)
        self._table.use(TABLE_UNIT)

    def develop(
        self,
        water: PhysicalWater,
        intrinsics: Intrinsics,
        n_lamps: int,
        surfaces: moderngl.Texture,
        target: moderngl.Framebuffer,
        particles: VisibleParticles | None = None,
        shafts: moderngl.Texture | None = None,
        *,
        is_exposed: bool = True,
    ) -> None:
        """Draw the image of a camera from the image of surfaces.

        Args:
            water: the water, whose numbers are prepared.
            intrinsics: the pinhole of the camera.
            n_lamps: the number of lamps.
            surfaces: the radiance and the range of surfaces, four floats.
            target: the framebuffer of the colours.
            particles: the particles in view; None: none are drawn.
            shafts: the radiance of light shafts; None: there are none.
            is_exposed: True if exposure and curve follow; False: the target gets the light.
        """
        plan = plan_blur(intrinsics, has_blur=water.has_blur)
        n_veils = n_lamps if water.has_lamp_veil else 0
        self._context.enable_only(moderngl.NOTHING)
        surfaces.use(SURFACE_UNIT)
        self.use_textures()
        switches: Switches = (("BLUR", 1),) if plan.n_levels else ()
        if plan.n_levels > 0 or n_veils > 0:
            size = intrinsics.width, intrinsics.height
            self._draw_scattered(plan, size, n_veils).use(FIRST_LEVEL_UNIT)
            surfaces.use(SURFACE_UNIT)
            switches += (("SCATTERED", 1),)
        if particles is not None:
            size = intrinsics.width, intrinsics.height
            self._particles.draw(particles, size, n_lamps).use(PARTICLE_UNIT)
            switches += (("PARTICLES", 1),)
            if particles.clouds is not None:
                textures = self._clouds.draw(particles.clouds, size, n_lamps)
                for unit, texture in enumerate(textures, start=CLOUD_UNIT):
                    texture.use(unit)
                switches += (("CLOUDS", 1),)
        if shafts is not None:
            shafts.use(SHAFT_UNIT)
            switches += (("SHAFTS", SHAFT_RATIO),)
        if not is_exposed:
            switches += (("LIGHT", 1),)
        elif water.transfer == "linear":
            switches += (("LINEAR", 1),)
        self._draw("developed", switches, target)

    def _draw_scattered(
        self, plan: BlurPlan, size: tuple[int, int], n_veils: int
    ) -> moderngl.Texture:
        """Draw the light that coarse levels scatter, and the lamps' veil; return their sum."""
        key = size, plan.n_levels
        if key not in self._buffers:
            self._buffers[key] = Buffers(self._context, size, plan.n_levels)
        buffers = self._buffers[key]
        self._draw_sources(buffers, plan)
        for number in reversed(range(len(buffers.levels))):
            source, level = _textures(buffers.sources[number])[0], buffers.levels[number]
            spread = plan.spreads[number] if plan.n_levels else 0.0
            kernel: Switches = (
                ("RADIUS", compute_radius(spread)),
                ("SPREAD", round(1000.0 * spread)),
            )
            rows = source
            if spread > 0.0:
                source.use(FIRST_LEVEL_UNIT)
                self._draw("blurred_rows", kernel, level.rows)
                rows = _textures(level.rows)[0]
            switches = kernel
            rows.use(FIRST_LEVEL_UNIT)
            if number + 1 < len(buffers.levels):
                _textures(buffers.levels[number + 1].total)[0].use(FIRST_LEVEL_UNIT + 1)
                switches += (("WIDER", 1),)
            if number == 0 and n_veils:
                _textures(buffers.sources[0])[-1].use(FIRST_LEVEL_UNIT + 2)
                switches += (("LAMPS", n_veils),)
            if plan.n_levels == 0:
                switches += (("VEIL_ONLY", 1),)
            self._draw("blurred", switches, level.total)
        return _textures(buffers.levels[0].total)[0]

    def _draw_sources(self, buffers: Buffers, plan: BlurPlan) -> None:
        """Draw what the levels scatter."""
        n_levels = plan.n_levels
        switches: Switches = (("N_LEVELS", min(n_levels, 1)),)
        self._draw("scattered", switches, buffers.sources[0])
        if n_levels > 1:
            _textures(buffers.sources[0])[1].use(SURFACE_UNIT)
            switches = (("WIDE", 1), ("N_LEVELS", n_levels - 1))
            self._draw("scattered", switches, buffers.sources[1])
        for finer_source, source in zip(buffers.sources[1:], buffers.sources[2:], strict=False):
            for unit, texture in enumerate(_textures(finer_source)[1:]):
                texture.use(FIRST_LEVEL_UNIT + unit)
            self._draw("reduced", (("N_LEVELS", len(_textures(source))),), source)

    def _draw(self, effect: str, switches: Switches, target: moderngl.Framebuffer) -> None:
        key = effect, switches
        if key not in self._programs:
            program = build(
                self._context,
                effect,
                defines=dict(switches),
                blocks=(OPTICS, LAMPS, CLOUDS),
                samplers=SAMPLERS,
                vertex=SCREEN,
            )
            self._programs[key] = program, self._context.vertex_array(program, [])
        target.use()
        self._programs[key][1].render(moderngl.TRIANGLES, vertices=3)


def _textures(framebuffer: moderngl.Framebuffer) -> tuple[moderngl.Texture, ...]:
    return tuple(
        texture
        for texture in framebuffer.color_attachments
        if isinstance(texture, moderngl.Texture)
    )


def _texture(context: moderngl.Context, size: tuple[int, int]) -> moderngl.Texture:
    texture = context.texture(size, 4, dtype="f4")
    texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    texture.repeat_x = texture.repeat_y = False
    return texture


def _halve(size: tuple[int, int]) -> tuple[int, int]:
    width, height = size
    return -(-width // 2), -(-height // 2)
