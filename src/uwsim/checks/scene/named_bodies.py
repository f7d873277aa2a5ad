"""The rule that the bodies that sensors name exist."""

from __future__ import annotations

from collections.abc import Iterator

from ...errors import Diagnostic, UnknownName
from ...scene.attachable import attachable_bodies
from ...schema import Spec, fields_of, line_of
from ...sensors import SensorSpec
from ..subjects import CheckedScene


def bodies_of_sensors(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report unknown bodies of sensors, such as the one that carries a beacon."""
    if len(scene.robots) < len(scene.spec.vehicles):  # reported where robots are read
        return
    bodies = attachable_bodies(scene.spec, scene.robots)
    for vehicle in scene.spec.vehicles:
        for sensor in vehicle.parts_of(SensorSpec):
            for line, name in body_names(sensor):
                if name not in bodies:
                    message = str(UnknownName("vehicle, link or object", name, bodies))
                    yield scene.error(line, f"{sensor.name!r}: {message}")


def body_names(spec: Spec) -> Iterator[tuple[int | None, str]]:
    """Yield the line and the name of each body that a part of a scene names."""
    for field in fields_of(type(spec)):
        value = field.value_in(spec)
        if field.xml.refers_to == "body" and isinstance(value, str):
            yield line_of(spec, field.tag), value
        for part in value if isinstance(value, tuple) else (value,):
            if isinstance(part, Spec):
                yield from body_names(part)
