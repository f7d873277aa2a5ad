"""The types of the bus among those that rclpy has: packages that somebody compiled.

A message goes to rclpy as CDR bytes, in the layout of uwsim's own definition. So a class of rclpy
is taken only if it has the same fields. What is not there is collected, and told a package a line.
"""

from __future__ import annotations

import importlib.util
from collections import defaultdict
from typing import Any

from rosbags.interfaces import Nodetype

from ..types import FOLDER, PLACEHOLDER, WireService, ros2_store, wire_type

BASES = {"bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float"}
BASES |= {"float64": "double"}
"""Types of fields that rclpy names otherwise."""
OURS = "underwater_sensor_msgs"
"""The package that comes with uwsim."""


class RclpyTypes:
    """Finds classes of rclpy, and keeps what is not to be found."""

    def __init__(self) -> None:
        self._absent: defaultdict[str, set[str]] = defaultdict(set)  # why -> topics and services

    def message(self, type: type, place: str) -> Any | None:
        """Return the class of a message for a topic, ``place``; None if there is none."""
        wire = wire_type(type)
        assert wire is not None
        return self._found(wire.ros2_name, (wire.ros2_name,), place)

    def service(self, kind: WireService, place: str) -> Any | None:
        """Return the class of a service type for a service, ``place``; None if there is none."""
        halves = (kind.request.ros2_name, kind.response.ros2_name)
        return self._found(kind.ros2_name, halves, place)

    def faults(self) -> list[str]:
        """Return a line for each package, or type, that is lacking since the last call."""
        absent, self._absent = self._absent, defaultdict(set)
        return [
            f"not on the graph: {', '.join(f'/{place}' for place in sorted(places))}. {why}; or "
            "UWSIM_ROS2=dds, which does without rclpy"
            for why, places in sorted(absent.items())
        ]

    def _found(self, name: str, layouts: tuple[str, ...], place: str) -> Any | None:
        package = name.partition("/")[0]
        found = _class_of(name)
        if found is not None and all(has_our_fields(each) for each in layouts):
            return found
        if found is not None:
            why = f"{name} has other fields in rclpy's {package} than in uwsim"
        elif importlib.util.find_spec(package) is not None:
            why = f"rclpy's {package} has no {name}"
        else:
            why = f"rclpy has no {package}: {how_to_get(package)}"
        self._absent[why].add(place)
        return None


def how_to_get(package: str) -> str:
    """Return what to do about a package that rclpy lacks."""
    if package == OURS:
        return f"colcon build --base-paths {FOLDER / OURS}"
    return f"apt install ros-$ROS_DISTRO-{package.replace('_', '-')}"


def has_our_fields(name: str) -> bool:
    """Whether the class of rclpy has the fields of uwsim's definition, those inside included."""
    found = _class_of(name)
    if found is None:
        return False
    ours = [
        (field, _type_text(description))
        for field, description in ros2_store().fielddefs[name][1]
        if field != PLACEHOLDER
    ]
    if list(found.get_fields_and_field_types().items()) != ours:
        return False
    inside = [_inner(description) for _, description in ros2_store().fielddefs[name][1]]
    return all(has_our_fields(each) for each in inside if each)


def _class_of(name: str) -> Any | None:
    """Return the class of rclpy of ``package/msg/Name``, or ``package/srv/Name_Request``."""
    package, kind, base = name.split("/")
    service, _, half = base.rpartition("_")
    try:
        module = importlib.import_module(f"{package}.{kind}")
        if kind == "srv" and half in ("Request", "Response"):
            return getattr(getattr(module, service), half)
        return getattr(module, base)
    except (ImportError, AttributeError):
        return None


def _inner(description: Any) -> str:
    """Return the message type inside a field; empty if it has none."""
    kind, inner = description
    if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        kind, inner = inner[0]
    return str(inner) if kind == Nodetype.NAME else ""


def _type_text(description: Any) -> str:
    """Return the type of a field as rclpy writes it."""
    kind, inner = description
    if kind == Nodetype.NAME:
        package, _, base = inner.split("/")
        return f"{package}/{base}"
    if kind == Nodetype.BASE:
        base, bound = inner
        return f"{base}<{bound}>" if bound else BASES.get(base, base)
    item, length = _type_text(inner[0]), inner[1]
    if kind == Nodetype.ARRAY:
        return f"{item}[{length}]"
    return f"sequence<{item}, {length}>" if length else f"sequence<{item}>"
