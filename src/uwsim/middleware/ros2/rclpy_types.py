"""The Python message classes of the installed ROS 2 packages, for the types of the bus.

A message is passed to rclpy as CDR bytes, in the layout of uwsim's own definition. A class of rclpy
is therefore used only if it has the same fields. `RclpyTypes.faults` returns one line for each
reason why endpoints have no class: a missing package, a missing type, or different fields.
"""

from __future__ import annotations

import importlib.util
from collections import defaultdict
from typing import Any

from rosbags.interfaces import Nodetype

from ..types import FOLDER, PLACEHOLDER, WireService, ros2_store, wire_type

RCLPY_NAMES = {"bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float"}
RCLPY_NAMES |= {"float64": "double"}
"""The names in rclpy of types of fields, by their names in rosbags, where the two differ."""
OWN_PACKAGE = "underwater_sensor_msgs"
"""The package that comes with uwsim."""


class RclpyTypes:
    """The classes of rclpy for types of the bus, and a list of the types without a class."""

    def __init__(self) -> None:
        self._endpoints_by_reason: defaultdict[str, set[str]] = defaultdict(set)

    def message(self, type: type, topic: str) -> Any | None:
        """Return the class of the messages on ``topic``; None if rclpy has no such class."""
        wire = wire_type(type)
        assert wire is not None
        return self._find(wire.ros2_name, (wire.ros2_name,), topic)

    def service(self, kind: WireService, name: str) -> Any | None:
        """Return the class of the type of the service ``name``; None if rclpy has no such class."""
        request, response = kind.request.ros2_name, kind.response.ros2_name
        return self._find(kind.ros2_name, (request, response), name)

    def faults(self) -> list[str]:
        """Return one line for each reason found since the last call.

        A reason is a missing package, a missing type, or different fields.
        """
        endpoints_by_reason, self._endpoints_by_reason = self._endpoints_by_reason, defaultdict(set)
        return [
            f"not on the graph: {', '.join(f'/{name}' for name in sorted(names))}. {reason}; or "
            "set UWSIM_ROS2=dds, which does not need rclpy"
            for reason, names in sorted(endpoints_by_reason.items())
        ]

    def _find(self, name: str, layouts: tuple[str, ...], endpoint_name: str) -> Any | None:
        package = name.partition("/")[0]
        cls = _class_of(name)
        if cls is not None and all(has_same_fields(layout) for layout in layouts):
            return cls
        if cls is not None:
            reason = f"The installed {package} defines {name} with other fields than uwsim"
        elif importlib.util.find_spec(package) is not None:
            reason = f"The installed {package} has no {name}"
        else:
            command = install_command(package)
            reason = f"The ROS 2 package {package} is not installed: {command}"
        self._endpoints_by_reason[reason].add(endpoint_name)
        return None


def install_command(package: str) -> str:
    """Return the command that installs a package for rclpy."""
    if package == OWN_PACKAGE:
        return f"colcon build --base-paths {FOLDER / OWN_PACKAGE}"
    return f"apt install ros-$ROS_DISTRO-{package.replace('_', '-')}"


def has_same_fields(name: str) -> bool:
    """Return whether the class of rclpy has the same fields, also nested, as uwsim's definition."""
    cls = _class_of(name)
    if cls is None:
        return False
    fields = [
        (field, _type_text(description))
        for field, description in ros2_store().fielddefs[name][1]
        if field != PLACEHOLDER
    ]
    if list(cls.get_fields_and_field_types().items()) != fields:
        return False
    nested_types = [_nested_type(description) for _, description in ros2_store().fielddefs[name][1]]
    return all(has_same_fields(nested_type) for nested_type in nested_types if nested_type)


def _class_of(name: str) -> Any | None:
    """Return rclpy's class of ``package/msg/Name`` or ``package/srv/Name_Request``, else None."""
    package, kind, base = name.split("/")
    service, _, half = base.rpartition("_")
    try:
        module = importlib.import_module(f"{package}.{kind}")
        if kind == "srv" and half in ("Request", "Response"):
            return getattr(getattr(module, service), half)
        return getattr(module, base)
    except (ImportError, AttributeError):
        return None


def _nested_type(description: Any) -> str:
    """Return the message type of a field or of its elements; empty if they are no messages."""
    kind, content = description
    if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        kind, content = content[0]
    return str(content) if kind == Nodetype.NAME else ""


def _type_text(description: Any) -> str:
    """Return the type of a field as rclpy writes it."""
    kind, content = description
    if kind == Nodetype.NAME:
        package, _, base = content.split("/")
        return f"{package}/{base}"
    if kind == Nodetype.BASE:
        base, bound = content
        return f"{base}<{bound}>" if bound else RCLPY_NAMES.get(base, base)
    item, length = _type_text(content[0]), content[1]
    if kind == Nodetype.ARRAY:
        return f"{item}[{length}]"
    return f"sequence<{item}, {length}>" if length else f"sequence<{item}>"
