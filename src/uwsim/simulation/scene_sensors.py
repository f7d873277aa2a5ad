"""The sensors of a scene, by element and name, and the topics that they publish on."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from ..devices.fault import FaultSpec
from ..errors import UnknownName
from ..model.scene_model import SceneModel
from ..sensors.sensor import Sensor
from ..sensors.virtual_camera import VirtualCamera
from .faulty_topic import FaultyTopic, faults_of
from .vehicles import SceneVehicles
from .world_views.sensor_view import SensorView


class SceneSensors:
    """The sensors of a scene, and its devices that measure.

    Where two share element and name, the last has it.

    Args:
        model: of the scene.
        vehicles: its vehicles, in the file's order.
        world: the scene as sensors see it.
    """

    def __init__(self, model: SceneModel, vehicles: SceneVehicles, world: SensorView) -> None:
        self._spec, self._world = model.scene, world
        self._sensors: dict[tuple[str, str], Sensor] = {}
        for index, element, sensor in model.sensor_specs:
            # a sensor on a link that is not there is left out, as in the original
            with suppress(UnknownName):
                self._sensors[element, sensor.name] = sensor.bind(world, vehicles[index])
        self.bound: tuple[Sensor, ...] = tuple(self._sensors.values())
        """The sensors that are no devices, in the file's order."""
        self._cameras = {
            name: sensor
            for (_, name), sensor in self._sensors.items()
            if isinstance(sensor, VirtualCamera)
        }
        self.cameras = tuple(self._cameras)
        """Names of the virtual cameras, in the file's order."""
        self.faulty_topics: list[FaultyTopic] = []
        """The topics of sensors with faults."""

    def add(self, element: str, name: str, device: Sensor) -> None:
        """Add a device that measures."""
        self._sensors[element, name] = device

    def camera(self, name: str) -> VirtualCamera:
        """Find a virtual camera; UnknownName if there is none."""
        if name not in self._cameras:
            raise UnknownName("virtual camera", name, self._cameras)
        return self._cameras[name]

    def sensor(self, name: str, elements: tuple[str, ...]) -> Sensor:
        """Find a sensor, or a device that measures, of one of these elements; else UnknownName."""
        known = {given: each for (kind, given), each in self._sensors.items() if kind in elements}
        if name not in known:
            raise UnknownName(" or ".join(elements), name, known)
        return known[name]

    def has_faults(self, sensor: str) -> bool:
        """Whether something becomes of the messages of a sensor before they are published."""
        parts = [part for each in self._spec.vehicles for part in each.parts_of(FaultSpec)]
        return any(part.sensor == sensor for part in parts)

    def publisher(self, sensor: str, topic: str, type_: type) -> Callable[[Any], None]:
        """Return what publishes the messages of a sensor on a topic, with the sensor's faults."""
        world = self._world
        publish: Callable[[Any], None] = world.bus.publisher(topic, type_)
        faults = faults_of(self._spec, sensor, topic, type_, world.stream)
        if not faults:
            return publish
        self.faulty_topics.append(FaultyTopic(faults, publish, lambda: world.time))
        return self.faulty_topics[-1].publish
