"""Warnings about shared names and topics, and about topic names that are invalid in ROS."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ...errors import Diagnostic
from ...schema import format_tag
from ...sensors.virtual_camera import VirtualCameraSpec
from ...topics import InterfaceSpec, element_name
from ...topics.interface import VehiclePublisherSpec
from ...topics.simulated_device_ros import unwrap_interfaces
from ..subjects import CheckedScene

TOPIC_NAME = re.compile(r"[A-Za-z]\w*(/\w+)*", re.ASCII)
"""The pattern of a valid topic name in ROS, without the leading slash that it may have."""


def shared_object_names(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of objects with the name of an earlier vehicle or object."""
    owners: dict[str, str] = {vehicle.name: "a vehicle" for vehicle in scene.spec.vehicles}
    shared_names: set[str] = set()
    for spec in scene.spec.objects:
        if spec.name in owners and spec.name not in shared_names:
            shared_names.add(spec.name)
            yield scene.warning(
                spec,
                f"the object {spec.name!r} has the name of {owners[spec.name]} before it; searches "
                "find the first",
            )
        owners.setdefault(spec.name, "an object")


def shared_part_names(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of parts of one kind with the same name, and of shared names in one vehicle."""
    names_by_kind: set[tuple[str, str]] = set()
    for vehicle in scene.spec.vehicles:
        elements: dict[str, str] = {}
        for element, part in vehicle.all_parts():
            name = getattr(part, "name", None)
            if name is None:
                continue
            if (element, name) in names_by_kind and not isinstance(part, VirtualCameraSpec):
                message = f"several are called {name!r}; interfaces find the last"
            elif name in elements and elements[name] != element:
                message = (
                    f"{name!r} is the name of a <{elements[name]}> of the vehicle, too; they "
                    "share random streams and faults"
                )
            else:
                message = ""
            if message:
                yield scene.warning(part, f"{format_tag(element)}: {message}")
            names_by_kind.add((element, name))
            elements.setdefault(name, element)


def shared_topics(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of topics with two publishers, and of invalid topic names."""
    publishers: dict[str, tuple[str, str]] = {}  # topic -> element, name of the source
    for interface in unwrap_interfaces(scene.spec.ros_interfaces):
        element, source = element_name(interface), source_of(interface) or ""
        for field in interface.message_types():
            topic = str(getattr(interface, field))
            key = topic.strip("/")
            if not TOPIC_NAME.fullmatch(key):
                message = f"the topic {topic!r} is no valid topic name in ROS"
                yield scene.warning(interface, f"{format_tag(element)}: {message}")
            if interface.subscribes:
                continue
            other = publishers.get(key)
            if other is not None and isinstance(interface, VehiclePublisherSpec):
                yield scene.warning(
                    interface,
                    f"the topic {topic!r} carries {source!r} and {other[1]!r}; readers get both",
                )
            elif other is not None:
                yield scene.warning(
                    interface,
                    f"{format_tag(element)}: the topic {topic!r} of {source!r} carries "
                    f"{other[1]!r} of {format_tag(other[0])}, too; readers get both",
                )
            publishers.setdefault(key, (element, source))


def source_of(interface: InterfaceSpec) -> str | None:
    """Return the name of the vehicle, camera or sensor of an interface; None if it names none."""
    names = (getattr(interface, field, None) for field in ("vehicle_name", "camera_name", "name"))
    return next((str(name) for name in names if name is not None), None)
