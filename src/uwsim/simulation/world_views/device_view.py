"""The view of a running scene for its devices."""

from __future__ import annotations

from ...base.geodesy import Geodetic
from ...base.geometry import Array
from ...network import Network
from ..connections import OpenConnections
from ..datagrams import Datagrams
from ..physical_scene import PhysicalScene
from .scene_view import SceneView


class DeviceView(SceneView):
    """The view of a running scene for its devices (`uwsim.world.DeviceWorld`)."""

    def __init__(
        self,
        scene: PhysicalScene,
        network: Network,
        datagrams: Datagrams,
        connections: OpenConnections | None = None,
    ) -> None:
        super().__init__(scene)
        self._scenery = scene.scenery
        self._objects, self._grips = scene.model.scene.objects, scene.engine.grips
        self.world_from_localized = scene.model.scene.world_from_localized
        """The pose of L, the frame of the scene file, in W."""
        self.compatibility = scene.model.compatibility
        """The compatibility quirks that are on."""
        self.ned_origin = scene.model.scene.earth_origin or Geodetic(latitude=0.0, longitude=0.0)
        """The geodetic position of the origin of W; 0, 0 if the scene gives none."""
        self.rays = scene.rays
        """The ray casting against the scene."""
        self.network = network
        """The packets between communication devices."""
        self.datagrams = datagrams.open
        self.connections = connections
        """The connections to programs outside; None if the simulation has none."""
        self.create_timer = scene.schedule.create_timer
        self.actuators = scene.vehicles.actuators
        self.stream = scene.stream

    def dig(self, point: Array) -> int:
        """Remove sand around a point in W (3,) [m]; return the number of columns that lost sand."""
        return sum(heap.dig(point) for heap in self._scenery.heaps)

    def pickable_object(self, surface: int) -> int | None:
        """Return the index of a surface's object; None if no device can pick the object up.

        Args:
            surface: the index of the surface, as in `uwsim.rays.Hits`.
        """
        objects = {part.id: part.object for part in self._scenery.parts}
        object_index = objects.get(surface)
        if object_index is None or self._objects[object_index].is_ground:
            return None
        return object_index if self._grips.can_hold(object_index) else None
