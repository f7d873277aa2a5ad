"""A scene as its devices see it."""

from __future__ import annotations

from ...base.geodesy import Geodetic
from ...base.geometry import Array
from ...network import Network
from ..datagrams import Datagrams
from ..physical_scene import PhysicalScene
from .scene_view import SceneView


class DeviceView(SceneView):
    """A scene as its devices see it (`uwsim.world.DeviceWorld`)."""

    def __init__(self, scene: PhysicalScene, network: Network, datagrams: Datagrams) -> None:
        super().__init__(scene)
        self._scenery = scene.scenery
        self._objects, self._grips = scene.model.scene.objects, scene.engine.grips
        self.world_from_localized = scene.model.scene.world_from_localized
        """The transform of W from L: the scene's offset."""
        self.compatibility = scene.model.compatibility
        """The compatibility quirks that are on."""
        self.ned_origin = scene.model.scene.earth_origin or Geodetic(latitude=0.0, longitude=0.0)
        """The geodetic position of the origin of W."""
        self.rays = scene.rays
        """The surfaces of the scene at their present poses."""
        self.network = network
        """The packets between communication devices."""
        self.datagrams = datagrams.open
        self.create_timer = scene.schedule.create_timer
        self.actuators = scene.vehicles.actuators
        self.stream = scene.stream

    def dig(self, point: Array) -> int:
        """Remove sand around a point in W (3,) [m]; return the number of columns that lost some."""
        return sum(heap.dig(point) for heap in self._scenery.heaps)

    def pickable_object(self, surface: int) -> int | None:
        """Return the number of the object with a surface; None if no device can pick it up."""
        objects = {part.id: part.object for part in self._scenery.parts}
        object_index = objects.get(surface)
        if object_index is None or self._objects[object_index].is_ground:
            return None
        return object_index if self._grips.can_hold(object_index) else None
