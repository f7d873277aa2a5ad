"""The view of a running scene for its sensors."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base.geometry import Intrinsics, Pose
from ...sensors.pinhole import cast_depth
from ...world import WaterSurface
from ..physical_scene import PhysicalScene


class SensorView:
    """The view of a running scene for its sensors (`uwsim.world.SensorWorld`).

    Args:
        scene: the scene.
        is_blind: True to compute depth images by ray casting, not by rendering.
    """

    def __init__(self, scene: PhysicalScene, *, is_blind: bool) -> None:
        spec = scene.model.scene
        self._scene = scene
        self.bus = scene.bus
        """The topics and services."""
        self._scenery, self._is_blind = scene.scenery, is_blind
        self.world_from_localized = spec.world_from_localized
        """The pose of L, the frame of the scene file, in W."""
        self.compatibility = scene.model.compatibility
        """The compatibility quirks that are on."""
        self.body = scene.bodies.find
        """The function that returns a vehicle, link or object by name."""
        self.rays = scene.rays
        """The ray casting against the scene."""
        self.sea_water = spec.ocean_state.sea_water
        """The water as an acoustic medium."""
        self.surface = WaterSurface(
            spec.ocean_state.ocean_surface_height, scene.water.surface_function
        )
        """The surface of the water."""
        self.density_levels = scene.model.density_levels
        """The depth [m] and density [kg/m3] of each level of the water; uniform water has one."""
        self.earth_origin = spec.earth_origin
        """The geodetic position of the origin of W; None if the scene states none."""
        self.compiled_water = scene.water.velocity_function
        self.water_velocity = scene.water.velocity
        self.render = scene.scenery.render
        self.stream = scene.stream

    @property
    def time(self) -> float:
        """The simulation time [s]."""
        return self._scene.time

    def depth(self, world_from_camera: Pose, intrinsics: Intrinsics) -> npt.NDArray[np.float64]:
        """Return the distance along the optical axis for each pixel, (h, w) [m].

        Ray casting and rendering differ by the renderer's rounding, about 1e-6 of the depth. They
        also differ at the edges of bodies, where a pixel may show either surface.
        """
        if self._is_blind:
            return cast_depth(self.rays, world_from_camera, intrinsics)
        return self._scenery.depth(world_from_camera, intrinsics)
