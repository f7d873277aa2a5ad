"""Types of DDS topics whose samples are ready-made CDR bytes.

Cyclone DDS wants a description of each type, and announces it. It is built here from the fields
that rosbags parses out of ``.msg`` text. Its samples, however, go through as bytes: the encoder of
cyclonedds for Python needs 40 ms for an image of 640x480 pixels, that of rosbags 1 ms.
"""

from __future__ import annotations

from typing import Any, ClassVar

from cyclonedds.idl import make_idl_struct, types
from rosbags.interfaces import Nodetype

from .names import type_name

CDR_HEADER = 4
"""Bytes in front of a sample: byte order and version."""
BASES: dict[str, Any] = {
    "bool": bool,
    "byte": types.byte,
    "octet": types.byte,
    "char": types.uint8,
    "float32": types.float32,
    "float64": types.float64,
    "int8": types.int8,
    "uint8": types.uint8,
    "int16": types.int16,
    "uint16": types.uint16,
    "int32": types.int32,
    "uint32": types.uint32,
    "int64": types.int64,
    "uint64": types.uint64,
}


class RawSample:
    """A sample: the bytes of CDR, its header included."""

    __idl__: ClassVar[Any]
    __idl_typename__: ClassVar[str]

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.sample_info: Any = None

    def serialize(self, *_: Any, **__: Any) -> bytes:
        """Return the bytes; called by cyclonedds."""
        return self.data

    @classmethod
    def deserialize(cls, data: bytes, *_: Any, **__: Any) -> RawSample:
        """Keep the bytes; called by cyclonedds."""
        return cls(data)

    @classmethod
    def deserialize_key(cls, data: bytes, *_: Any, **__: Any) -> RawSample:
        """Keep the bytes, for the notice that a writer is gone; called by cyclonedds."""
        return cls(data)


def raw_type(store: Any, ros_type: str, *, before: dict[str, Any] | None = None) -> type[RawSample]:
    """Return the type of the samples of a ROS type.

    Args:
        store: type store of rosbags that knows it.
        ros_type: ``package/msg/Name``.
        before: fields before those of the type.
    """
    built: dict[str, Any] = {}
    idl = _struct(store, ros_type, built, before or {})
    name = idl.__idl_typename__
    return type("Raw", (RawSample,), {"__idl__": idl.__idl__, "__idl_typename__": name})


def _struct(store: Any, ros_type: str, built: dict[str, Any], before: dict[str, Any]) -> Any:
    if ros_type not in built:
        _, fields = store.fielddefs[ros_type]
        kinds = {name: _kind(store, field, built) for name, field in fields}
        short = ros_type.rsplit("/", 1)[-1]
        built[ros_type] = make_idl_struct(
            f"{short}_", type_name(ros_type).replace("::", "."), before | kinds
        )
    return built[ros_type]


def _kind(store: Any, field: Any, built: dict[str, Any]) -> Any:
    """Return what cyclonedds calls the type of a field."""
    kind, what = field
    if kind == Nodetype.NAME:
        return _struct(store, what, built, {})
    if kind == Nodetype.BASE:
        name, bound = what
        if name in ("string", "wstring"):
            return types.bounded_str[bound] if bound else str
        return BASES[name]
    inner, length = _kind(store, what[0], built), what[1]
    if kind == Nodetype.ARRAY:
        return types.array[inner, length]
    return types.sequence[inner, length] if length else types.sequence[inner]
