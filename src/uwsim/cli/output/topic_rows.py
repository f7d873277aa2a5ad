"""The topics of a scene as plain values, for ``uwsim info``."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from ...devices.device import DeviceSpec
from ...scene.spec import SceneSpec
from ...scene.unsupported import describe_limitation
from ...schema.names import prefixed_name
from ...simulation import Simulation
from ...topics import InterfaceSpec, element_name
from ...topics.simulated_device_ros import unwrap_interfaces

Fields = dict[str, Any]
TOPIC_FIELDS = ("topic", "image_topic", "info_topic")
"""The fields of an interface that is not simulated which name topics."""


def topic_rows(scene: SceneSpec, simulation: Simulation) -> list[Fields]:
    """Return every topic of an interface or device, with its type, direction and rate."""
    types: Mapping[str, str] = simulation.bus.topics
    rows = []
    for interface in unwrap_interfaces(scene.ros_interfaces):
        name = element_name(interface)
        is_subscribed = interface.subscribes
        for field in interface.message_types() or TOPIC_FIELDS:
            topic = getattr(interface, field, "")
            if not topic:
                continue
            topic_name = topic.strip().lstrip("/")
            rows.append(
                {
                    "topic": f"/{topic_name}",
                    "type": types.get(topic_name),
                    "direction": "listens" if is_subscribed else "publishes",
                    "rate_hz": None if is_subscribed else getattr(interface, "rate", None),
                    "of": _source_name(interface),
                    "interface": prefixed_name(name),
                    "limit": describe_limitation("rosInterfaces", name),
                }
            )
    rows += _device_topics(scene, types)
    return rows + _further_topics(simulation, {str(row["topic"]) for row in rows})


def _further_topics(simulation: Simulation, listed_topics: Collection[str]) -> list[Fields]:
    """Return the other topics of the scene, such as ``/tf`` and the events of packets."""
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
        if f"/{topic}" not in listed_topics
        for ends in [simulation.bus.endpoints(topic)]
    ]


def _device_topics(scene: SceneSpec, types: Mapping[str, str]) -> list[Fields]:
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


def _source_name(interface: InterfaceSpec) -> str:
    for field in ("vehicle_name", "camera_name", "name"):
        if value := getattr(interface, field, None):
            return str(value)
    return ""
