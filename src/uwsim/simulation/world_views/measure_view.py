"""The view of a running scene for measures and triggers."""

from __future__ import annotations

from ...base.geometry import Array
from ...world import ImageContent, ImageView
from ..access.image_views import bind_image_view
from ..physical_scene import PhysicalScene
from ..scene_sensors import SceneSensors
from .scene_view import SceneView
from .surroundings_view import SurroundingsView


class MeasureView(SceneView):
    """The view of a running scene for measures and triggers (`uwsim.world.World`)."""

    def __init__(self, scene: PhysicalScene, sensors: SceneSensors) -> None:
        super().__init__(scene)
        self._scene, self._sensors = scene, sensors
        self.world_from_localized = scene.model.scene.world_from_localized
        """The pose of L, the frame of the scene file, in W."""
        self.compatibility = scene.model.compatibility
        """The compatibility quirks that are on."""
        self.body = scene.bodies.find
        self.contacts = scene.contacts.find
        self.contact_forces = scene.contacts.forces
        self.camera = sensors.camera
        self.surroundings = SurroundingsView(scene)
        """The lines, holes and surfaces of the scene."""
        self.actuators = scene.vehicles.actuators
        self._vehicles = scene.vehicles
        self.stream = scene.stream
        self.joint_position = scene.engine.poses.fixtures.position

    def twist(self, name: str) -> Array:
        """Return the twist of a vehicle's base over ground, in base axes, (6,) [m/s, rad/s]."""
        return self._vehicles.find(name).velocity

    def image_view(
        self, name: str, content: ImageContent, size: tuple[int, int] | None
    ) -> ImageView:
        """Return the images of a camera or a sonar, with noise of their own.

        Args:
            name: the name of the sensor.
            content: the content of the images.
            size: the width and height of a camera's images [px]; None: those of the sensor.

        Raises:
            UnknownName: there is no such sensor.
            BadSetting: the sensor has no such content or size.
        """
        return bind_image_view(self._scene, self._sensors, name, content, size)
