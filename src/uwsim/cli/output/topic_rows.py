"""The topics of a scene as plain values, for ``uwsim info``."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from ...devices.device import DeviceSpec
from ...scene.spec import SceneSpec
from ...scene.unsupported import describe_limit
from ...schema.names import prefixed_name
from ...simulation import Simulation
from ...topics import InterfaceSpec, element_name
from ...topics.simulated_device_ros import unwrap_interfaces

Fields = dict[str, Any]
TOPIC_FIELDS = ("topic", "image_topic", "info_topic")
"""What names a topic in an interface that is not simulated."""


def topics(scene: SceneSpec, simulation: Simulation) -> list[Fields]:
    """Every topic of an interface or device: what it carries, which way, how often."""
    types: Mapping[str, str] = simulation.bus.topics
    found = []
    for interface in unwrap_interfaces(scene.ros_interfaces):
        name = element_name(interface)
        is_heard = interface.subscribes
        for field in interface.message_types() or TOPIC_FIELDS:
            topic = getattr(interface, field, "")
            if not topic:
                continue
            plain = topic.strip().lstrip("/")
            found.append(
                {
                    "topic": f"/{plain}",
                    "type": types.get(plain),
                    "direction": "listens" if is_heard else "publishes",
                    "rate_hz": None if is_heard else getattr(interface, "rate", None),
                    "of": _of(interface),
                    "interface": prefixed_name(name),
                    "limit": describe_limit("rosInterfaces", name),
                }
            )
    found += _device_topics(scene, types)
    return found + _further_topics(simulation, {str(each["topic"]) for each in found})


def _further_topics(simulation: Simulation, listed: Collection[str]) -> list[Fields]:
    """Topics that the scene has besides: the frames that it hears, what becomes of packets."""
    return [
        {
            "topic": f"/{topic}",
            "type": type_,
            "direction": "publishes" if ends is not None and ends.is_published else "listens",
            "rate_hz": None,
            "of": "",
            "interface": "",
            "limit": "",
        }
        for topic, type_ in simulation.bus.topics.items()
        if f"/{topic}" not in listed
        for ends in [simulation.bus.endpoints(topic)]
    ]


def _device_topics(scene: SceneSpec, types: Mapping[str, str]) -> list[Fields]:
    """The topics that devices have without an interface; of a device that is left out none."""
    return [
        {
            "topic": f"/{topic.name}",
            "type": types[topic.name],
            "direction": "listens" if topic.is_subscribed else "publishes",
            "rate_hz": topic.rate,
            "of": getattr(part, "name", ""),
            "interface": element,
            "limit": "",
        }
        for vehicle in scene.vehicles
        for element, part in vehicle.all_parts()
        if isinstance(part, DeviceSpec)
        for topic in part.topics
        if topic.name in types
    ]


def _of(interface: InterfaceSpec) -> str:
    """The vehicle, camera or device an interface is about."""
    for field in ("vehicle_name", "camera_name", "name"):
        if value := getattr(interface, field, None):
            return str(value)
    return ""
