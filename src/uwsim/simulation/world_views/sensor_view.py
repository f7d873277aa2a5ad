"""A scene as its sensors see it."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base.geometry import Intrinsics, Pose
from ...sensors.pinhole import cast_depth
from ..physical_scene import PhysicalScene
from .scene_view import SceneView


class SensorView(SceneView):
    """A scene as its sensors see it (`uwsim.world.SensorWorld`).

    Args:
        scene: the scene.
        is_blind: measure depths by rays, not by the renderer.
    """

    def __init__(self, scene: PhysicalScene, *, is_blind: bool) -> None:
        super().__init__(scene)
        spec = scene.model.scene
        self._scenery, self._is_blind = scene.scenery, is_blind
        self.world_from_localized = spec.world_from_localized
        """The transform of W from L: the scene's offset."""
        self.compatibility = scene.model.compatibility
        """The compatibility quirks that are on."""
        self.rays = scene.rays
        """The surfaces of the scene at their present poses."""
        self.sea_water = spec.ocean_state.sea_water
        """The water as an acoustic medium."""
        self.surface_height = spec.ocean_state.ocean_surface_height
        """The height of the water's surface in W [m]."""
        self.density_levels = scene.model.density_levels
        """The depth [m] and density [kg/m3] of the water's levels; one level of uniform water."""
        self.earth_origin = spec.earth_origin
        """The geodetic position of the origin of W; None if the scene states none."""
        self.compiled_water = scene.water.velocity_function
        self.water_velocity = scene.water.velocity
        self.render = scene.scenery.render
        self.stream = scene.stream

    def depth(self, world_from_camera: Pose, intrinsics: Intrinsics) -> npt.NDArray[np.float64]:
        """Measure the depth of each pixel, (h, w) [m]; in a blind world by rays, not the renderer.

        Their depths differ by the renderer's rounding, about 1e-6 of the depth, and at the edges of
        bodies, where a pixel may be of either.
        """
        if self._is_blind:
            return cast_depth(self.rays, world_from_camera, intrinsics)
        return self._scenery.depth(world_from_camera, intrinsics)
