"""Types of DDS topics whose samples are encoded CDR bytes.

Cyclone DDS requires a description of each type, and announces it. This module builds the
description from the fields that rosbags reads in ``.msg`` files. Samples, however, are passed as
bytes: the encoder of cyclonedds for Python takes 40 ms for an image of 640x480 pixels, that of
rosbags 1 ms.
"""

from __future__ import annotations

from typing import Any, ClassVar

from cyclonedds.idl import make_idl_struct, types
from rosbags.interfaces import Nodetype

from .names import type_name

CDR_HEADER = 4
"""The number of bytes before a sample: byte order and version."""
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
"""The types in cyclonedds of the scalar types of ROS."""


class RawSample:
    """A sample as CDR bytes, including the CDR header."""

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
        """Make a sample of the bytes; called by cyclonedds."""
        return cls(data)

    @classmethod
    def deserialize_key(cls, data: bytes, *_: Any, **__: Any) -> RawSample:
        """Make a sample of the bytes, when a writer has left; called by cyclonedds."""
        return cls(data)


def raw_type(store: Any, ros_type: str, *, prefix: dict[str, Any] | None = None) -> type[RawSample]:
    """Return the class of the samples of a ROS type.

    Args:
        store: the type store of rosbags that has the type.
        ros_type: the name of the type, ``package/msg/Name``.
        prefix: the types of additional fields before those of the ROS type, by name.
    """
    structs: dict[str, Any] = {}
    idl = _make_struct(store, ros_type, structs, prefix or {})
    name = idl.__idl_typename__
    return type("Raw", (RawSample,), {"__idl__": idl.__idl__, "__idl_typename__": name})


def _make_struct(store: Any, ros_type: str, structs: dict[str, Any], prefix: dict[str, Any]) -> Any:
    if ros_type not in structs:
        _, fields = store.fielddefs[ros_type]
        kinds = {name: _idl_type(store, field, structs) for name, field in fields}
        base_name = ros_type.rsplit("/", 1)[-1]
        structs[ros_type] = make_idl_struct(
            f"{base_name}_", type_name(ros_type).replace("::", "."), prefix | kinds
        )
    return structs[ros_type]


def _idl_type(store: Any, field: Any, structs: dict[str, Any]) -> Any:
    """Return the type in cyclonedds of a field."""
    kind, content = field
    if kind == Nodetype.NAME:
        return _make_struct(store, content, structs, {})
    if kind == Nodetype.BASE:
        name, bound = content
        if name in ("string", "wstring"):
            return types.bounded_str[bound] if bound else str
        return BASES[name]
    item_type, length = _idl_type(store, content[0], structs), content[1]
    if kind == Nodetype.ARRAY:
        return types.array[item_type, length]
    return types.sequence[item_type, length] if length else types.sequence[item_type]
