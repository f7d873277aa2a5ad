"""The sensor that a ``<u:sensorToROS>`` names: its message type, or why there is not one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..errors import choices
from ..scene.spec import SceneSpec
from ..sensors.sensor import measured_by
from ..sensors.virtual_camera import VirtualCameraSpec
from ..topics import InterfaceSpec
from ..topics.sensor_topic import SensorToROSSpec


def carried(interface: InterfaceSpec, scene: SceneSpec) -> Mapping[str, type]:
    """Return the types of an interface's messages, by the field that names the topic."""
    if not isinstance(interface, SensorToROSSpec):
        return interface.carries()
    parts = [part for _, name, part in _sensors(scene) if name == interface.name]
    type_ = measured_by(type(parts[-1])) if parts else None
    return {} if type_ is None else {"topic": type_}


def sensor_error(interface: InterfaceSpec, scene: SceneSpec) -> str | None:
    """Report why a ``<u:sensorToROS>`` does not name one sensor; None if it does."""
    if not isinstance(interface, SensorToROSSpec):
        return None
    name = interface.name
    kinds = sorted({kind for kind, known, _ in _sensors(scene) if known == name})
    if len(kinds) == 1:
        return None
    if kinds:
        return f"{name!r} is the name of a <{'> and of a <'.join(kinds)}>; expected that of one"
    found = f"no sensor is called {name!r}"
    if any(name == each.name for one in scene.vehicles for each in one.parts_of(VirtualCameraSpec)):
        found = f"{name!r} is a <virtualCamera>, which <VirtualCameraToROSImage> publishes"
    known = sorted({known for _, known, _ in _sensors(scene)})
    expected = "expected the name of a sensor, or of a device that measures"
    return f"{found}; {expected}.{choices(name, known, called='Sensors')}"


def _sensors(scene: SceneSpec) -> Iterator[tuple[str, str, object]]:
    """Give element, name and spec of all that a ``<u:sensorToROS>`` may name."""
    for vehicle in scene.vehicles:
        for element, part in vehicle.all_parts():
            if element in SensorToROSSpec.sources:
                yield element, str(getattr(part, "name", "")), part
