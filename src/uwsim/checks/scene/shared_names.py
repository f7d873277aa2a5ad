"""Warnings about names and topics that parts of a scene share, and that ROS cannot name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ...errors import Diagnostic
from ...schema import format_tag
from ...sensors.virtual_camera import VirtualCameraSpec
from ...topics import InterfaceSpec, element_of
from ...topics.interface import VehiclePublisherSpec
from ...topics.simulated_device_ros import unwrapped
from ..subjects import CheckedScene

NAME = re.compile(r"[A-Za-z]\w*(/\w+)*", re.ASCII)
"""Of a topic in ROS, without the slash that it may begin with."""


def shared_object_names(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of objects that are hidden by another thing of the same name."""
    first: dict[str, str] = {vehicle.name: "a vehicle" for vehicle in scene.spec.vehicles}
    shared: set[str] = set()
    for thing in scene.spec.objects:
        if thing.name in first and thing.name not in shared:
            shared.add(thing.name)
            yield scene.warning(
                thing,
                f"the object {thing.name!r} is called as {first[thing.name]} before it; searches "
                "find the first",
            )
        first.setdefault(thing.name, "an object")


def shared_part_names(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Of one kind the last of a name is found; parts of one vehicle share noise and faults."""
    of_kind: set[tuple[str, str]] = set()
    for vehicle in scene.spec.vehicles:
        of_vehicle: dict[str, str] = {}
        for element, part in vehicle.all_parts():
            name = getattr(part, "name", None)
            if name is None:
                continue
            if (element, name) in of_kind and not isinstance(part, VirtualCameraSpec):
                why = f"several are called {name!r}; interfaces find the last"
            elif name in of_vehicle and of_vehicle[name] != element:
                why = (
                    f"{name!r} is the name of a <{of_vehicle[name]}> of the vehicle, too; they "
                    "share random streams and faults"
                )
            else:
                why = ""
            if why:
                yield scene.warning(part, f"{format_tag(element)}: {why}")
            of_kind.add((element, name))
            of_vehicle.setdefault(name, element)


def shared_topics(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of topics with two publishers, and of those that ROS cannot name."""
    writers: dict[str, tuple[str, str]] = {}
    for interface in unwrapped(scene.spec.ros_interfaces):
        element, own = element_of(interface), source_of(interface) or ""
        for field in interface.carries():
            topic = str(getattr(interface, field))
            key = topic.strip("/")
            if not NAME.fullmatch(key):
                why = "is no name of a topic in ROS"
                yield scene.warning(interface, f"{format_tag(element)}: the topic {topic!r} {why}")
            if interface.subscribes:
                continue
            other = writers.get(key)
            if other is not None and isinstance(interface, VehiclePublisherSpec):
                yield scene.warning(
                    interface,
                    f"the topic {topic!r} carries {own!r} and {other[1]!r}; readers get both",
                )
            elif other is not None:
                yield scene.warning(
                    interface,
                    f"{format_tag(element)}: the topic {topic!r} of {own!r} carries {other[1]!r} "
                    f"of {format_tag(other[0])}, too; readers get both",
                )
            writers.setdefault(key, (element, own))


def source_of(interface: InterfaceSpec) -> str | None:
    """Return the vehicle, camera or sensor that an interface publishes; None if it names none."""
    named = (getattr(interface, each, None) for each in ("vehicle_name", "camera_name", "name"))
    return next((str(each) for each in named if each is not None), None)
