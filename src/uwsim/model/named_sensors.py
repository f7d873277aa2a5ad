"""Look-up of the sensors that ``<u:sensorToROS>`` elements name, and of their message types."""

from __future__ import annotations

from collections.abc import Mapping

from ..errors import choices
from ..scene.spec import SceneSpec
from ..sensors.sensor import find_message_type
from ..sensors.virtual_camera import VirtualCameraSpec
from ..topics import InterfaceSpec
from ..topics.sensor_topic import SensorToROSSpec


class NamedSensors:
    """The sensors and measuring devices of a scene, by name."""

    def __init__(self, scene: SceneSpec) -> None:
        self._types: dict[str, dict[str, type]] = {}
        """The message type by element, by the name of the sensor."""
        self._cameras: set[str] = set()
        for vehicle in scene.vehicles:
            self._cameras |= {camera.name for camera in vehicle.parts_of(VirtualCameraSpec)}
            for element, part in vehicle.all_parts():
                type_ = find_message_type(type(part))
                if type_ is not None and element in SensorToROSSpec.sources:
                    name = str(getattr(part, "name", ""))
                    self._types.setdefault(name, {})[element] = type_

    def message_types(self, interface: InterfaceSpec) -> Mapping[str, type]:
        """Return the message types of an interface, by the field that contains the topic's name."""
        if not isinstance(interface, SensorToROSSpec):
            return interface.message_types()
        types = [*self._types.get(interface.name, {}).values()]
        return {"topic": types[-1]} if types else {}

    def error(self, interface: InterfaceSpec) -> str | None:
        """Return the error in the name of a ``<u:sensorToROS>``; None if it names one sensor."""
        if not isinstance(interface, SensorToROSSpec):
            return None
        name = interface.name
        elements = sorted(self._types.get(name, {}))
        if len(elements) == 1:
            return None
        if elements:
            kinds = "> and of a <".join(elements)
            return f"{name!r} is the name of a <{kinds}>; expected the name of one sensor"
        message = f"no sensor is called {name!r}"
        if name in self._cameras:
            message = f"{name!r} is a <virtualCamera>, which <VirtualCameraToROSImage> publishes"
        expected = "expected the name of a sensor, or of a device that measures"
        return f"{message}; {expected}.{choices(name, sorted(self._types), heading='Sensors')}"
