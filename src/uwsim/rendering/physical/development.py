"""The passes that turn an image of surfaces without water into one through physical water.

The surface pass has written the radiance J of each pixel's surface and its range. Then follow, on
whole images: what each level of blur scatters (half the resolution), the wider levels at halves of
the resolution before, their Gaussians, the sum from the widest to the narrowest with the veil of
the lamps, and the composition with exposure and curve. A reference in numpy is in the tests.
"""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np

from ...base.geometry import Intrinsics, Pose
from ...optics import Medium
from ..caustics.light_shafts import RATIO as SHAFT_RATIO
from ..lights.lamp import Lamp
from .blur_plan import MAX_LEVELS, plan_blur
from .blur_weights import N_SHARES, compute_share_table
from .cloud_pass import CloudPass
from .open_water_map import OpenWaterMap
from .optics_block import OpticsBlock
from .particle_pass import ParticlePass
from .physical_water import PhysicalWater
from .scattered_light import FIRST_LEVEL_UNIT, LEVEL_SAMPLERS, ScatteredLight, create_texture
from .visible_particles import VisibleParticles
from .whole_images import Switches, WholeImagePasses

SURFACE_UNIT, MAP_UNIT, TABLE_UNIT = 0, 5, 6
"""The texture units of the image of surfaces, the open water, and the weights."""
LAMP_MAP_UNIT, CLOUD_UNIT, PARTICLE_UNIT = 2, 10, 13
"""The texture units of the lamps' shadow maps, as in the surface pass, of the first of the three
textures of clouds, which follow the blur and use units of its levels, and of the particles."""
SHAFT_UNIT = 3
"""The texture unit of light shafts, which the surface pass uses for a projector."""
SAMPLERS = {
    "surface_image": SURFACE_UNIT,
    "open_water_map": MAP_UNIT,
    "weight_table": TABLE_UNIT,
    **LEVEL_SAMPLERS,
    "lamp_maps": LAMP_MAP_UNIT,
    "particle_image": PARTICLE_UNIT,
    "cloud_layers_map": CLOUD_UNIT,
    "cloud_lamplight_map": CLOUD_UNIT + 1,
    "cloud_daylight_map": CLOUD_UNIT + 2,
    "shaft_image": SHAFT_UNIT,
}
"""The texture unit of every sampler of these passes."""


class Development:
    """The passes of physical water; one for a renderer.

    Args:
        context: the context of the renderer.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._block = OpticsBlock(context)
        self._map = OpenWaterMap(context)
        self._table = create_texture(context, (N_SHARES, 1 + MAX_LEVELS))
        self._table_key: tuple[Medium, tuple[float, ...]] | None = None
        self._passes = WholeImagePasses(context, SAMPLERS)
        self._scattered_light = ScatteredLight(context, self._passes, SURFACE_UNIT)
        self._particles = ParticlePass(context, SAMPLERS)
        self._clouds = CloudPass(context, SAMPLERS)

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
            shares = compute_share_table(*key, plan.highest_frequency)
            pixels = np.zeros((1 + MAX_LEVELS, N_SHARES, 4), np.float32)
            pixels[: len(shares), :, :3] = shares
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
        is_dry: bool = False,
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
            is_dry: True if the camera is in air, so that the image of surfaces is complete.
        """
        is_dry = is_dry and particles is None
        plan = plan_blur(intrinsics, has_blur=water.has_blur)
        n_veils = n_lamps if water.has_lamp_veil else 0
        self._context.enable_only(moderngl.NOTHING)
        surfaces.use(SURFACE_UNIT)
        self.use_textures()
        switches: Switches = (("BLUR", 1),) if plan.n_levels else ()
        if is_dry:
            switches, shafts = (("DRY", 1),), None
        elif plan.n_levels > 0 or n_veils > 0:
            size = intrinsics.width, intrinsics.height
            self._scattered_light.draw(plan, size, n_veils).use(FIRST_LEVEL_UNIT)
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
        target.use()
        self._passes.find_array("developed", switches).render(moderngl.TRIANGLES, vertices=3)
