"""A scene as its measures and triggers see it."""

from __future__ import annotations

from ..physical_scene import PhysicalScene
from ..scene_sensors import SceneSensors
from .scene_view import SceneView


class MeasureView(SceneView):
    """A scene as its measures and triggers see it (`uwsim.world.World`)."""

    def __init__(self, scene: PhysicalScene, sensors: SceneSensors) -> None:
        super().__init__(scene)
        self.world_from_localized = scene.model.scene.world_from_localized
        """The transform of W from L: the scene's offset."""
        self.compatibility = scene.model.compatibility
        """The compatibility quirks that are on."""
        self.body = scene.bodies.find
        self.contacts = scene.contacts.find
        self.contact_forces = scene.contacts.forces
        self.camera = sensors.camera
        self.actuators = scene.vehicles.actuators
        self.stream = scene.stream
