"""A scene as its scene updaters see it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ...model.robots import find_file
from ...world import World
from ..physical_scene import PhysicalScene
from ..scene_sensors import SceneSensors
from .scene_view import SceneView


class StageView(SceneView):
    """A scene as its updaters see it: its setters (`uwsim.world.Stage`)."""

    def __init__(self, scene: PhysicalScene, sensors: SceneSensors, world: World) -> None:
        super().__init__(scene)
        self._scenery, self._sensors = scene.scenery, sensors
        self._vehicles, self._data_path = scene.vehicles, scene.model.data_path
        self.world = world
        """The bodies, cameras and contacts, as measures see them."""
        self.vehicles = scene.vehicles.names
        """The names of the vehicles, in the file's order."""
        self.set_fog = scene.scenery.set_fog
        self.set_light_rate = scene.scenery.set_light_rate
        self.set_current = scene.water.set
        self.create_timer = scene.schedule.create_timer
        self.stream = scene.stream

    @property
    def fog_colour(self) -> tuple[float, float, float]:
        """The colour of the fog [0..1]."""
        return self._scenery.state.water.fog_colour

    def find(self, name: str, *, named_by: str) -> Path:
        """Find a file named in the file ``named_by``; AssetNotFound lists the folders searched."""
        return find_file(name, named_by, self._data_path)

    def set_camera_noise(self, std: float) -> None:
        """Set the noise [0..1] of every colour camera."""
        for name in self._sensors.cameras:
            self._sensors.camera(name).state.std = std

    def set_joints(self, vehicle: str, values: Mapping[int, float]) -> None:
        """Set joints by their number in the joint vector [rad or m], clamped to limits."""
        scene_vehicle = self._vehicles.find(vehicle)
        joints = scene_vehicle.joints
        for number, value in values.items():
            if 0 <= number < len(joints):
                joints[number] = value
        scene_vehicle.set_joints(joints)

    def put_back(self, vehicle: str) -> None:
        """Place a vehicle at its pose in the scene, at rest; UnknownName if there is none."""
        self._vehicles.find(vehicle).reset_pose(None)
