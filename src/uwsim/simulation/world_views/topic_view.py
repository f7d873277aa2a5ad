"""The view of a running scene for the elements of ``<rosInterfaces>``."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ...errors import UnknownName
from ...forces import Force, Tether
from ...topics.frames import Frame
from ..frames import scene_frames
from ..markers import Markers
from ..physical_scene import PhysicalScene
from ..scene_sensors import SceneSensors
from ..scenery.segmenter import SceneSegmenter
from .scene_view import SceneView


class TopicView(SceneView):
    """The view of a running scene for interfaces (`uwsim.topics.interface.TopicWorld`).

    Args:
        scene: the scene.
        sensors: the sensors of the scene, and its devices that measure.
        markers: the markers that programs have added.
        forces: the forces of the scene.
        is_blind: True to publish black images, and to render nothing.
    """

    def __init__(
        self,
        scene: PhysicalScene,
        sensors: SceneSensors,
        markers: Markers,
        forces: Sequence[Force],
        *,
        is_blind: bool,
    ) -> None:
        super().__init__(scene)
        self._scene, self._forces = scene, forces
        self.is_blind = is_blind
        """True if images are black and nothing is rendered."""
        self.world_from_localized = scene.model.scene.world_from_localized
        """The pose of L, the frame of the scene file, in W."""
        self.compatibility = scene.model.compatibility
        """The compatibility quirks that are on."""
        self.sensors = sensors
        """The sensors and devices that publish."""
        self.contacts = scene.contacts
        """The contacts between bodies."""
        self.segmenter = SceneSegmenter(scene.scenery, scene.rays, is_blind=is_blind)
        """The source of segmentation images."""
        self.body = scene.bodies.find
        self.vehicle = scene.vehicles.find
        self._markers = markers
        self.create_timer = scene.schedule.create_timer
        self.defer_to_next_step = scene.schedule.defer_to_next_step

    def tether(self, name: str) -> Tether:
        """Find a tether by its name; raise UnknownName if there is none."""
        tethers = {force.name: force for force in self._forces if isinstance(force, Tether)}
        if name not in tethers:
            raise UnknownName("tether", name, tethers)
        return tethers[name]

    def frames(self, *, with_objects: bool) -> Callable[[], Sequence[Frame]]:
        """Return a function that lists the frames of vehicles, links and sensors.

        ``with_objects`` adds objects, segments of tethers, and the markers that exist then.
        """
        scene = self._scene
        frames = scene_frames(
            scene.model, scene.engine, scene.vehicles, scene.bodies, with_objects=with_objects
        )
        return lambda: [*frames, *(self._markers.frames() if with_objects else ())]
