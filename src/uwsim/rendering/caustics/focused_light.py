"""The sunlight that a moving surface focuses, in an image: caustics and light shafts."""

from __future__ import annotations

import math

import moderngl

from ...base.geometry import Intrinsics, Pose
from ..physical.moving_surface import MovingSurface
from ..physical.physical_water import PhysicalWater
from .caustic_light import CausticLight
from .light_shafts import LightShafts

SAMPLERS = {"caustic_maps": 9, "swell_map": 10}
"""The texture unit of the maps of caustics and of the grid of long waves."""

Switches = tuple[tuple[str, int], ...]


class FocusedLight:
    """The caustics and the light shafts of a renderer.

    Args:
        context: the context of the renderer.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._caustics: CausticLight | None = None
        self._shafts: LightShafts | None = None

    def prepare(
        self,
        water: PhysicalWater,
        surface: MovingSurface | None,
        world_from_camera: Pose,
        surface_height: float,
        floor_depth: float = math.inf,
    ) -> Switches:
        """Update the maps, the uniform block and the textures before surfaces are drawn.

        Args:
            water: the water.
            surface: the moving surface; None: it is level.
            world_from_camera: the pose of the camera; OpenGL axes.
            surface_height: the height of the still surface in W [m].
            floor_depth: the depth of the lowest point of the ground; infinity if unknown [m].

        Returns:
            The switches of the shaders of surfaces.
        """
        if surface is None or not water.has_focused_light:
            return ()
        if not (water.has_caustics or water.has_light_shafts):
            return ()
        if self._caustics is None:
            self._caustics = CausticLight(self._context)
        switches = self._caustics.prepare(
            water, surface, world_from_camera, surface_height, floor_depth
        )
        self._use_textures()
        return switches if water.has_caustics else ()

    def draw_shafts(
        self,
        water: PhysicalWater,
        surface: MovingSurface | None,
        intrinsics: Intrinsics,
        surfaces: moderngl.Texture,
    ) -> moderngl.Texture | None:
        """Draw light shafts; return None if there are none.

        Args:
            water: the prepared water.
            surface: the moving surface; None: it is level.
            intrinsics: the pinhole of the camera.
            surfaces: the radiance and the range of surfaces, four floats.
        """
        if surface is None or not (water.has_focused_light and water.has_light_shafts):
            return None
        if self._shafts is None:
            self._shafts = LightShafts(self._context, SAMPLERS)
        self._use_textures()
        assert self._caustics is not None
        return self._shafts.draw(
            intrinsics,
            surfaces,
            has_swell=surface.waves is not None,
            n_slices=self._caustics.n_slices,
        )

    def _use_textures(self) -> None:
        assert self._caustics is not None
        self._caustics.use(SAMPLERS["caustic_maps"], SAMPLERS["swell_map"])
