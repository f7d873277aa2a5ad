"""The view of a running scene for scene updaters."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ...errors import UwsimError
from ...model.robots import find_file
from ...world import World
from ..physical_scene import PhysicalScene
from ..scene_sensors import SceneSensors
from .adjusted_water import AdjustedWater
from .scene_view import SceneView


class StageView(SceneView):
    """The view of a running scene for scene updaters, which change it (`uwsim.world.Stage`)."""

    def __init__(self, scene: PhysicalScene, sensors: SceneSensors, world: World) -> None:
        super().__init__(scene)
        self._scenery, self._sensors = scene.scenery, sensors
        self._vehicles, self._data_path = scene.vehicles, scene.model.data_path
        self.world = world
        """The view of the scene for measures: bodies, cameras and contacts."""
        self.vehicles = scene.vehicles.names
        """The names of the vehicles, in the file's order."""
        self.water = AdjustedWater(scene)
        """The waves and the physical water, which scene updaters change."""
        self.set_fog = scene.scenery.set_fog
        self.set_light_rate = scene.scenery.set_light_rate
        self.set_current = scene.water.set
        self.create_timer = scene.schedule.create_timer

    @property
    def fog_colour(self) -> tuple[float, float, float]:
        """The colour of the fog, RGB [0..1]."""
        return self._scenery.state.water.fog_colour

    def find(self, name: str, *, named_by: str) -> Path:
        """Return the path of a file that the file ``named_by`` names; raise AssetNotFound."""
        return find_file(name, named_by, self._data_path)

    def set_camera_noise(self, std: float | None) -> None:
        """Set the noise of virtual cameras: standard deviation, as a fraction of full scale [1].

        None: the noise of each camera in the scene file.
        Cameras with a response keep the noise of their electrons; raise UwsimError if all are such.
        """
        cameras = [self._sensors.camera(name) for name in self._sensors.cameras]
        if cameras and all(camera.has_response for camera in cameras):
            raise UwsimError(
                "Every camera of the scene has a <u:response>, whose noise is that of its "
                "electrons; expected a camera with <std>."
            )
        for camera in cameras:
            camera.state.std = camera.scene_std if std is None else std

    def set_joints(self, vehicle: str, values: Mapping[int, float]) -> None:
        """Set joints by their index in the joint vector [rad or m], clamped to the joint limits."""
        scene_vehicle = self._vehicles.find(vehicle)
        joints = scene_vehicle.joints
        for index, value in values.items():
            if 0 <= index < len(joints):
                joints[index] = value
        scene_vehicle.set_joints(joints)

    def put_back(self, vehicle: str) -> None:
        """Set a vehicle to its pose in the scene file, at rest; raise UnknownName."""
        self._vehicles.find(vehicle).reset_pose(None)
