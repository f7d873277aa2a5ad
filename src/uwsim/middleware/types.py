"""Names, hashes and definitions of the bus's message and service types in ROS 1 and ROS 2.

The definitions are texts: those of ROS, which rosbags ships, and the ``.msg`` and ``.srv`` files in
the folders of ``messages``. From these, rosbags derives the MD5 sum by which ROS 1 compares types,
the RIHS01 hash by which ROS 2 does, and the definition that is stored in bags.

A class of the bus is found by its name in ROS 1 or ROS 2, ``geometry_msgs/Twist`` or
``geometry_msgs/msg/Twist``. For types that `uwsim.messages` lacks, such as ``std_msgs/Int32``, it
is the class of rosbags (ROS 2 Jazzy).
"""

from __future__ import annotations

import functools
import hashlib
import importlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, TypesysError, get_types_from_msg, get_typestore

from .. import messages
from ..errors import UnknownName
from ..messages.services import SERVICES as OWN_SERVICES
from ..messages.services import Service
from ..messages.simulation_control import MESSAGES, SIMULATION_SERVICES

SERVICES: dict[str, Service] = {**OWN_SERVICES, **SIMULATION_SERVICES}
"""The service types by their names in ROS 2."""
FOLDER = Path(messages.__file__).parent
"""The folder of the packages, with ``msg/`` and ``srv/``."""
EVENT_INFO = "service_msgs/msg/ServiceEventInfo"
"""The type with a ``char`` field, which is uint8 in ROS 2; rosbags hashes it as another type."""
PLACEHOLDER = "structure_needs_at_least_one_member"
"""The field of a ROS 2 type without fields."""
TF_MESSAGE = "geometry_msgs/TransformStamped[] transforms"
"""The definition of ``tf2_msgs/TFMessage``, which rosbags has for ROS 2 only."""


@dataclass(frozen=True, kw_only=True)
class WireType:
    """A message type with its names, hashes and definitions in ROS."""

    message: type
    """The class on the bus."""
    ros1_name: str
    """The name in ROS 1, ``package/Name``."""
    md5: str
    """The MD5 sum in ROS 1; empty if ROS 1 has no such type."""
    ros1_definition: str
    """The definition in ROS 1, including nested types; empty if ROS 1 has no such type."""
    ros2_name: str
    """The name in ROS 2, ``package/msg/Name``."""
    type_hash: str
    """The hash in ROS 2: ``RIHS01_`` and 64 hexadecimal digits."""
    ros2_definition: str
    """The definition in ROS 2, including nested types."""


@dataclass(frozen=True, kw_only=True)
class WireService:
    """A service type with its names and hashes in ROS."""

    service: Service
    """The service type on the bus, with its classes."""
    ros1_name: str
    """The name in ROS 1, ``package/Name``."""
    md5: str
    """The MD5 sum in ROS 1, over request and response."""
    request: WireType
    """The type of requests, named ``package/NameRequest`` in ROS 1."""
    response: WireType
    """The type of responses."""
    ros2_name: str
    """The name in ROS 2, ``package/srv/Name``."""
    type_hash: str
    """The hash in ROS 2: ``RIHS01_`` and 64 hexadecimal digits."""


@functools.cache
def message_class(name: str) -> type:
    """Return the class of a message type by its ROS 1 or ROS 2 name.

    Raises:
        UnknownName: there is no such type; the error message suggests the nearest name.
    """
    type_name = full_name(name)
    message_type = _classes().get(type_name) or ros2_store().types.get(type_name)
    if message_type is None:
        raise UnknownName("message type", name, sorted(ros2_store().types))
    return message_type


@functools.cache
def service(name: str) -> Service:
    """Return a service type by its ROS 1 or ROS 2 name; raise UnknownName if there is none."""
    package, _, base = name.partition("/")
    type_name = f"{package}/srv/{base.rpartition('/')[2]}"
    if type_name not in SERVICES:
        raise UnknownName("service type", name, SERVICES)
    return SERVICES[type_name]


@functools.cache
def service_of(request: type) -> Service | None:
    """Return the service whose requests are of this class; None if it has no definition."""
    return next((kind for kind in SERVICES.values() if kind.request is request), None)


@functools.cache
def wire_type(message: type) -> WireType | None:
    """Return the ROS type of a class of the bus; None for a class without a definition."""
    name = str(getattr(message, "__msgtype__", ""))
    if name not in ros2_store().fielddefs:
        return None
    ros2_text, _ = ros2_store().generate_msgdef(name, ros_version=2)
    try:
        ros1_text, md5 = ros1_store().generate_msgdef(name, ros_version=1)
    except TypesysError:
        ros1_text, md5 = "", ""
    package, _, base = name.partition("/")
    return WireType(
        message=message,
        ros1_name=f"{package}/{base.rpartition('/')[2].replace('_Re', 'Re')}",
        md5=md5,
        ros1_definition=ros1_text,
        ros2_name=name,
        type_hash=ros2_store().hash_rihs01(name),
        ros2_definition=ros2_text,
    )


@functools.cache
def wire_service(service_type: Service) -> WireService:
    """Return a service type with its names and hashes."""
    request, response = wire_type(service_type.request), wire_type(service_type.response)
    assert request is not None
    assert response is not None
    return WireService(
        service=service_type,
        ros1_name=service_type.name.replace("/srv/", "/"),
        md5=_md5_of_service(service_type.name),
        request=request,
        response=response,
        ros2_name=service_type.name,
        type_hash=_hash_of_service(service_type.name),
    )


@functools.cache
def ros2_store() -> Any:
    """Return rosbags' store of ROS 2 (Jazzy) types with ours; it decodes to classes of the bus."""
    store: Any = get_typestore(Stores.ROS2_JAZZY)
    _register_own_types(store)
    constants, fields = store.fielddefs[EVENT_INFO]
    gid = ("client_gid", (Nodetype.ARRAY, ((Nodetype.BASE, ("uint8", 0)), 16)))
    store.fielddefs[EVENT_INFO] = (
        constants,
        [gid if field[0] == gid[0] else field for field in fields],
    )
    for name in SERVICES:
        _register_event_types(store, name)
    store.types.update(_classes())
    return store


@functools.cache
def ros1_store() -> Any:
    """Return rosbags' store of ROS 1 (Noetic) types, with ours."""
    store = get_typestore(Stores.ROS1_NOETIC)
    store.register(get_types_from_msg(TF_MESSAGE, "tf2_msgs/msg/TFMessage"))
    _register_own_types(store)
    return store


def full_name(name: str) -> str:
    """Return ``package/msg/Name`` for ``package/Name``; a full name stays."""
    package, _, base = name.strip().partition("/")
    return name.strip() if "/" in base else f"{package}/msg/{base}"


def is_fieldless(name: str) -> bool:
    """Return whether a type, by full name, has no fields, as ``std_srvs/srv/Empty_Request``."""
    return all(field == PLACEHOLDER for field, _ in ros2_store().fielddefs[name][1])


@functools.cache
def _classes() -> dict[str, type]:
    """Return the classes of the bus by full name: all messages, requests and responses.

    A message that `uwsim.messages` does not list is in the module of its package.
    """
    kinds = [getattr(messages, name) for name in messages.__all__]
    kinds += MESSAGES
    kinds += [half for kind in SERVICES.values() for half in (kind.request, kind.response)]
    classes = {kind.__msgtype__: kind for kind in kinds if hasattr(kind, "__msgtype__")}
    modules = {
        name.split("/")[0]: kind.__module__ for name, kind in classes.items() if "/msg/" in name
    }
    for path in FOLDER.glob("*/msg/*.msg"):
        package, name = path.parts[-3], f"{path.parts[-3]}/msg/{path.stem}"
        if name not in classes:
            module = modules.get(package, f"{messages.__name__}.{package}")
            classes[name] = getattr(importlib.import_module(module), path.stem)
    return classes


def _register_own_types(store: Any) -> None:
    """Register the types of ``messages/``, dependencies first."""
    texts = {
        name: _read_definition(name)
        for name in sorted(_classes())
        if "/msg/" in name and name not in get_typestore(Stores.ROS2_JAZZY).types
    }
    definitions: dict[str, Any] = {}
    for name, text in texts.items():
        if name not in store.fielddefs:
            definitions |= get_types_from_msg(text, name)
    for name in SERVICES:
        for half, text in zip(("Request", "Response"), _split_definition(name), strict=True):
            (fields,) = get_types_from_msg(text, f"{name}_{half}").values()
            definitions[f"{name}_{half}"] = fields
    store.register(definitions)


def _read_definition(name: str) -> str:
    package, kind, base = name.split("/")
    return (FOLDER / package / kind / f"{base}.{kind}").read_text(encoding="utf-8")


def _split_definition(name: str) -> tuple[str, str]:
    lines = _read_definition(name).splitlines()
    cut = lines.index("---")
    return "\n".join(lines[:cut]), "\n".join(lines[cut + 1 :])


def _md5_of_service(name: str) -> str:
    """Return the MD5 sum of a service: over the texts of its request and response."""
    md5 = hashlib.md5(usedforsecurity=False)
    for half in ("Request", "Response"):
        md5.update(_md5_text(f"{name}_{half}").encode())
    return md5.hexdigest()


def _md5_text(name: str) -> str:
    """Return the text of which ROS 1 computes a type's MD5 sum: constants, then fields.

    In place of the type of a field that is a message, the text has the MD5 sum of that type.
    """
    store = ros1_store()
    constants, fields = store.fielddefs[name]
    fields = [entry for entry in fields if entry[0] != PLACEHOLDER]
    lines = [f"{kind} {field}={value}" for field, kind, value in constants]
    for field, (kind, content_type) in fields:
        suffix = ""
        if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            (kind, content_type), count = content_type
            suffix = f"[{count or ''}]"
        if kind == Nodetype.BASE:
            lines.append(f"{content_type[0]}{suffix} {field}")
        elif content_type in ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration"):
            lines.append(f"{content_type.rpartition('/')[2].lower()}{suffix} {field}")
        else:
            lines.append(f"{store.generate_msgdef(content_type, ros_version=1)[1]} {field}")
    return "\n".join(lines)


def _register_event_types(store: Any, name: str) -> None:
    """Register the types that the RIHS01 hash of a service covers."""
    package, _, base = name.partition("/")
    request, response = f"{name}_Request", f"{name}_Response"
    info = (Nodetype.NAME, EVENT_INFO)
    store.fielddefs[f"{name}_Event"] = (
        [],
        [
            ("info", info),
            ("request", (Nodetype.SEQUENCE, ((Nodetype.NAME, request), 1))),
            ("response", (Nodetype.SEQUENCE, ((Nodetype.NAME, response), 1))),
        ],
    )
    store.fielddefs[name] = (
        [],
        [
            ("request_message", (Nodetype.NAME, request)),
            ("response_message", (Nodetype.NAME, response)),
            ("event_message", (Nodetype.NAME, f"{package}/{base}_Event")),
        ],
    )


def _hash_of_service(name: str) -> str:
    return str(ros2_store().hash_rihs01(name))
