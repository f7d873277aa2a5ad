"""Message and service types of the bus as ROS 1 and ROS 2 know them: names, hashes, definitions.

The source is text: ROS's own definitions, which rosbags ships, and the files of a folder
for each package in ``messages``. From it rosbags derives the MD5 sum by which ROS 1 compares types,
the RIHS01 hash of ROS 2, and the definition that goes into bags.

A class of the bus is looked up by either name, ``geometry_msgs/Twist`` or
``geometry_msgs/msg/Twist``. Types that `uwsim.messages` lacks (``std_msgs/Int32``) are the classes
of rosbags (ROS 2 Jazzy).
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
"""Service types by their names in ROS 2."""
FOLDER = Path(messages.__file__).parent
"""Where ``msg/`` and ``srv/`` are."""
EVENT_INFO = "service_msgs/msg/ServiceEventInfo"
"""Its ``char`` is ROS 2's uint8, also for the hash, which rosbags takes for another type."""
PLACEHOLDER = "structure_needs_at_least_one_member"
"""The field of a type of ROS 2 that has none."""
TF_MESSAGE = "geometry_msgs/TransformStamped[] transforms"
"""Definition of ``tf2_msgs/TFMessage``, which rosbags has for ROS 2 only."""


@dataclass(frozen=True, kw_only=True)
class WireType:
    """A message type outside the process."""

    message: type
    """The class on the bus."""
    ros1_name: str
    """``package/Name``."""
    md5: str
    """MD5 sum of ROS 1; empty if ROS 1 has no such type."""
    ros1_definition: str
    """Full text in ROS 1, with the types inside it; empty if it has none."""
    ros2_name: str
    """``package/msg/Name``."""
    type_hash: str
    """``RIHS01_`` and 64 hexadecimal digits."""
    ros2_definition: str
    """Full text in ROS 2, with the types inside it."""


@dataclass(frozen=True, kw_only=True)
class WireService:
    """A service type outside the process."""

    service: Service
    """Its classes on the bus."""
    ros1_name: str
    """``package/Name``."""
    md5: str
    """MD5 sum of ROS 1, over request and response."""
    request: WireType
    """Its request; named ``package/NameRequest`` in ROS 1."""
    response: WireType
    """Its response."""
    ros2_name: str
    """``package/srv/Name``."""
    type_hash: str
    """RIHS01 hash of the service."""


@functools.cache
def message_class(name: str) -> type:
    """Return the class of a message type by its ROS 1 or ROS 2 name.

    Raises:
        UnknownName: there is none; the message has the nearest.
    """
    full = full_name(name)
    found = _classes().get(full) or ros2_store().types.get(full)
    if found is None:
        raise UnknownName("message type", name, sorted(ros2_store().types))
    return found


@functools.cache
def service(name: str) -> Service:
    """Return a service type by its ROS 1 or ROS 2 name; UnknownName if there is none."""
    package, _, base = name.partition("/")
    full = f"{package}/srv/{base.rpartition('/')[2]}"
    if full not in SERVICES:
        raise UnknownName("service type", name, SERVICES)
    return SERVICES[full]


@functools.cache
def service_of(request: type) -> Service | None:
    """Return the service whose requests are of this class; None if it has no definition."""
    return next((each for each in SERVICES.values() if each.request is request), None)


@functools.cache
def wire_type(message: type) -> WireType | None:
    """Return the type of a class of the bus; None for a class without a definition."""
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
def wire_service(of: Service) -> WireService:
    """Return a service type with its names and hashes."""
    request, response = wire_type(of.request), wire_type(of.response)
    assert request is not None
    assert response is not None
    return WireService(
        service=of,
        ros1_name=of.name.replace("/srv/", "/"),
        md5=_md5_of_service(of.name),
        request=request,
        response=response,
        ros2_name=of.name,
        type_hash=_hash_of_service(of.name),
    )


@functools.cache
def ros2_store() -> Any:
    """Return rosbags' types of ROS 2 (Jazzy) and ours; it reads into the classes of the bus."""
    store: Any = get_typestore(Stores.ROS2_JAZZY)
    _register_ours(store)
    constants, fields = store.fielddefs[EVENT_INFO]
    gid = ("client_gid", (Nodetype.ARRAY, ((Nodetype.BASE, ("uint8", 0)), 16)))
    store.fielddefs[EVENT_INFO] = (
        constants,
        [gid if each[0] == gid[0] else each for each in fields],
    )
    for name in SERVICES:
        _register_event(store, name)
    store.types.update(_classes())
    return store


@functools.cache
def ros1_store() -> Any:
    """Return rosbags' types of ROS 1 (Noetic) and ours."""
    store = get_typestore(Stores.ROS1_NOETIC)
    store.register(get_types_from_msg(TF_MESSAGE, "tf2_msgs/msg/TFMessage"))
    _register_ours(store)
    return store


def full_name(name: str) -> str:
    """``package/Name`` as ``package/msg/Name``; a full name stays."""
    package, _, base = name.strip().partition("/")
    return name.strip() if "/" in base else f"{package}/msg/{base}"


def is_fieldless(name: str) -> bool:
    """Whether a type, by its full name, has no fields, as the request of ``std_srvs/Empty``."""
    return all(field == PLACEHOLDER for field, _ in ros2_store().fielddefs[name][1])


@functools.cache
def _classes() -> dict[str, type]:
    """Full name -> class of the bus, of all messages and of both halves of the services.

    A message that `uwsim.messages` does not list is in the module of its package.
    """
    public = [getattr(messages, name) for name in messages.__all__]
    public += MESSAGES
    public += [half for each in SERVICES.values() for half in (each.request, each.response)]
    found = {each.__msgtype__: each for each in public if hasattr(each, "__msgtype__")}
    modules = {
        name.split("/")[0]: kind.__module__ for name, kind in found.items() if "/msg/" in name
    }
    for path in FOLDER.glob("*/msg/*.msg"):
        package, name = path.parts[-3], f"{path.parts[-3]}/msg/{path.stem}"
        if name not in found:
            module = modules.get(package, f"{messages.__name__}.{package}")
            found[name] = getattr(importlib.import_module(module), path.stem)
    return found


def _register_ours(store: Any) -> None:
    """Register the types of ``messages/``, those that others need first."""
    texts = {
        name: _text(name)
        for name in sorted(_classes())
        if "/msg/" in name and name not in get_typestore(Stores.ROS2_JAZZY).types
    }
    found: dict[str, Any] = {}
    for name, text in texts.items():
        if name not in store.fielddefs:
            found |= get_types_from_msg(text, name)
    for name in SERVICES:
        for half, text in zip(("Request", "Response"), _halves(name), strict=True):
            (fields,) = get_types_from_msg(text, f"{name}_{half}").values()
            found[f"{name}_{half}"] = fields
    store.register(found)


def _text(name: str) -> str:
    """The definition of a type of ours."""
    package, kind, base = name.split("/")
    return (FOLDER / package / kind / f"{base}.{kind}").read_text(encoding="utf-8")


def _halves(name: str) -> tuple[str, str]:
    lines = _text(name).splitlines()
    cut = lines.index("---")
    return "\n".join(lines[:cut]), "\n".join(lines[cut + 1 :])


def _md5_of_service(name: str) -> str:
    """MD5 sum over the texts that the sums of its two halves are over."""
    md5 = hashlib.md5(usedforsecurity=False)
    for half in ("Request", "Response"):
        md5.update(_md5_text(f"{name}_{half}").encode())
    return md5.hexdigest()


def _md5_text(name: str) -> str:
    """The text whose MD5 sum is that of a type in ROS 1: constants, then fields.

    A type inside is its own MD5 sum there.
    """
    store = ros1_store()
    constants, fields = store.fielddefs[name]
    fields = [each for each in fields if each[0] != PLACEHOLDER]
    lines = [f"{kind} {field}={value}" for field, kind, value in constants]
    for field, (kind, inner) in fields:
        suffix = ""
        if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            (kind, inner), count = inner
            suffix = f"[{count or ''}]"
        if kind == Nodetype.BASE:
            lines.append(f"{inner[0]}{suffix} {field}")
        elif inner in ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration"):
            lines.append(f"{inner.rpartition('/')[2].lower()}{suffix} {field}")
        else:
            lines.append(f"{store.generate_msgdef(inner, ros_version=1)[1]} {field}")
    return "\n".join(lines)


def _register_event(store: Any, name: str) -> None:
    """Register the types that the RIHS01 hash of a service is over."""
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
