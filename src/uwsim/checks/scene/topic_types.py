"""Errors about topics of devices that carry another type of message."""

from __future__ import annotations

from collections.abc import Iterator

from ...bus.names import type_name
from ...devices.device import DeviceSpec
from ...errors import Diagnostic
from ...model.named_sensors import NamedSensors
from ...schema import format_tag
from ...topics import element_name
from ..subjects import CheckedScene


def device_topic_types(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report topics of devices whose type differs from that of an interface or another device."""
    owners: dict[str, tuple[type, str]] = {}  # by topic
    sensors = NamedSensors(scene.spec)
    for interface in scene.spec.ros_interfaces:
        owner = format_tag(element_name(interface))
        for field, message_type in sensors.message_types(interface).items():
            topic_name = str(getattr(interface, field)).strip("/")
            owners.setdefault(topic_name, (message_type, owner))
    for vehicle in scene.spec.vehicles:
        for element, device in vehicle.all_parts():
            for topic in device.topics if isinstance(device, DeviceSpec) else ():
                if topic.message_type is None:
                    continue
                owner = format_tag(element)
                key = topic.name.strip("/")
                other_type, other = owners.setdefault(key, (topic.message_type, owner))
                if other_type is topic.message_type:
                    continue
                names = sorted(k for k, (t, _) in owners.items() if t is topic.message_type)
                field_name = f"{format_tag(topic.element)}: " if topic.element else ""
                message = (
                    f"{owner}: {field_name}the topic {topic.name!r} of {other} carries "
                    f"{type_name(other_type)}; expected {type_name(topic.message_type)}"
                )
                if names:
                    message += f", as on {', '.join(repr(f'/{name}') for name in names[:4])}"
                yield scene.error(device, message, topic.element)
