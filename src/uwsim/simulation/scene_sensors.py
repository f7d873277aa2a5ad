"""The sensors of a scene, by XML element and name, and the topics on which they publish."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from ..devices.fault import FaultSpec
from ..errors import UnknownName
from ..model.scene_model import SceneModel
from ..sensors.sensor import Sensor
from ..sensors.virtual_camera import VirtualCamera
from .faulty_topic import FaultyTopic, make_faults
from .vehicles import SceneVehicles
from .world_views.sensor_view import SensorView


class SceneSensors:
    """The sensors of a scene, and its devices with measurements, for example force sensors.

    If several sensors have the same element and name, only the last is kept.

    Args:
        model: the compiled scene.
        vehicles: the vehicles of the scene.
        world: the view of the scene for sensors.
    """

    def __init__(self, model: SceneModel, vehicles: SceneVehicles, world: SensorView) -> None:
        self._spec, self._world = model.scene, world
        self._sensors: dict[tuple[str, str], Sensor] = {}
        for index, element, sensor in model.sensor_specs:
            # a sensor on a missing link is left out, as in the original UWSim
            with suppress(UnknownName):
                self._sensors[element, sensor.name] = sensor.bind(world, vehicles[index])
        self.bound_sensors: tuple[Sensor, ...] = tuple(self._sensors.values())
        """The sensors, without devices that measure, in the file's order."""
        self._cameras = {
            name: sensor
            for (_, name), sensor in self._sensors.items()
            if isinstance(sensor, VirtualCamera)
        }
        self.cameras = tuple(self._cameras)
        """The names of the virtual cameras, in the file's order."""
        self.faulty_topics: list[FaultyTopic] = []
        """The topics on which simulated faults modify the messages."""
        self.is_silent: Callable[[], bool] | None = None
        """A function that returns whether no sensor publishes now; None: all always do."""

    def add(self, element: str, name: str, device: Sensor) -> None:
        """Add a device with measurements, by its XML element and name."""
        self._sensors[element, name] = device

    def camera(self, name: str) -> VirtualCamera:
        """Return the virtual camera with a name; raise UnknownName if there is none."""
        if name not in self._cameras:
            raise UnknownName("virtual camera", name, self._cameras)
        return self._cameras[name]

    def sensor(self, name: str, elements: tuple[str, ...]) -> Sensor:
        """Return the sensor, or device with measurements, of one of these XML elements and a name.

        Raises:
            UnknownName: there is none.
        """
        sensors = {
            sensor_name: sensor
            for (element, sensor_name), sensor in self._sensors.items()
            if element in elements
        }
        if name not in sensors:
            raise UnknownName(" or ".join(elements), name, sensors)
        return sensors[name]

    def has_faults(self, sensor: str) -> bool:
        """Return whether faults modify the messages of a sensor before they are published."""
        if self.is_silent is not None:
            return True
        parts = [part for vehicle in self._spec.vehicles for part in vehicle.parts_of(FaultSpec)]
        return any(part.sensor == sensor for part in parts)

    def publisher(self, sensor: str, topic: str, type_: type) -> Callable[[Any], None]:
        """Return the function that applies the faults of a sensor and publishes its messages."""
        world = self._world
        publish: Callable[[Any], None] = world.bus.publisher(topic, type_)
        if self.is_silent is not None:
            publish = _make_silenced(publish, self.is_silent)
        faults = make_faults(self._spec, sensor, topic, type_, world.stream)
        if not faults:
            return publish
        self.faulty_topics.append(FaultyTopic(faults, publish, lambda: world.time))
        return self.faulty_topics[-1].publish


def _make_silenced(
    publish: Callable[[Any], None], is_silent: Callable[[], bool]
) -> Callable[[Any], None]:
    def publish_unless_silent(message: Any) -> None:
        if not is_silent():
            publish(message)

    return publish_unless_silent
