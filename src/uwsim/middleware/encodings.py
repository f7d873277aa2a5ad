"""Messages as bytes, in the encodings of ROS 2 (CDR) and of ROS 1.

The package rosbags encodes and decodes both. The classes on the bus are those of ROS 2; this module
maps them to the types of ROS 1, field by field: in ROS 1 a header has ``seq``, CameraInfo has ``D K
R P``, Range has no variance and Marker no texture. Arrays are converted to the dtype of the
definition. Bytes that do not match the type raise BadMessage.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.serde import SerdeError

from ..errors import BadMessage
from .types import is_fieldless, ros1_store, ros2_store

M = TypeVar("M")
EMPTY_CDR = b"\x00\x01\x00\x00\x00"
"""The CDR of a type without fields: ROS 2 gives it one byte."""
DTYPES = {"bool": "bool_", "byte": "uint8", "char": "uint8"}
"""The names in NumPy of the types of fields, where they differ."""
HEADER = "std_msgs/msg/Header"


class FieldView:
    """An object with the fields of a message as attributes, which rosbags can encode."""

    def __init__(self, values: dict[str, object]) -> None:
        self.__dict__.update(values)


def to_cdr(message: object) -> memoryview:
    """Return a message as CDR, little-endian, with its 4 bytes of encapsulation."""
    name = _name_of(type(message))
    if is_fieldless(name):
        return memoryview(EMPTY_CDR)
    try:
        return cast(
            memoryview, ros2_store().serialize_cdr(_cast(message, name), name, little_endian=True)
        )
    except Exception as error:
        raise BadMessage(f"{name} cannot be encoded: {error}") from error


def from_cdr(kind: type[M], data: bytes | memoryview) -> M:
    """Decode a message from CDR bytes; raise BadMessage if they do not match its type."""
    name = _name_of(kind)
    if is_fieldless(name):
        return kind()
    try:
        return cast(M, ros2_store().deserialize_cdr(data, name))
    except (SerdeError, ValueError, IndexError, TypeError, MemoryError) as error:
        raise BadMessage(f"{len(data)} bytes are not a {name}: {error}") from error


def to_ros1(message: object, *, seq: int = 0) -> memoryview:
    """Encode a message for ROS 1, with ``seq`` in its header.

    Raises:
        BadMessage: ROS 1 has no such type.
    """
    name = _name_of(type(message))
    if name not in ros1_store().fielddefs:
        raise BadMessage(f"ROS 1 has no type {name}.")
    if is_fieldless(name):
        return memoryview(b"")
    try:
        view = _to_ros1_view(_cast(message, name), seq, name)
        return cast(memoryview, ros1_store().serialize_ros1(view, name))
    except Exception as error:
        raise BadMessage(f"{name} cannot be encoded: {error}") from error


def from_ros1(kind: type[M], data: bytes | memoryview) -> M:
    """Decode a message from bytes of ROS 1; raise BadMessage if they do not match its type."""
    name = _name_of(kind)
    if name not in ros1_store().fielddefs:
        raise BadMessage(f"ROS 1 has no type {name}.")
    if is_fieldless(name):
        return kind()
    try:
        return cast(M, _make_reader(name)(ros1_store().deserialize_ros1(data, name)))
    except (SerdeError, ValueError, IndexError, TypeError, MemoryError, KeyError) as error:
        raise BadMessage(f"{len(data)} bytes are not a {name}: {error}") from error


def _name_of(kind: type) -> str:
    name = getattr(kind, "__msgtype__", None)
    if name not in ros2_store().fielddefs:
        raise BadMessage(f"{kind.__name__} has no message definition.")
    return str(name)


@functools.cache
def inner_type(description: Any) -> tuple[str, str]:
    """Return the form of a field and its inner type.

    The forms are ``one`` (a message), ``list`` (messages), ``base`` (a number or text), ``array``
    (numbers) and ``texts``.
    """
    kind, content = description
    if kind == Nodetype.NAME:
        return "one", content
    if kind == Nodetype.BASE:
        return "base", content[0]
    (kind, content), _ = content
    if kind == Nodetype.NAME:
        return "list", content
    return ("texts" if content[0] == "string" else "array"), content[0]


@functools.cache
def _array_fields(name: str) -> tuple[tuple[str, str, Any], ...]:
    """Return the fields that are arrays, with their dtype, or that contain messages with arrays."""
    array_fields: list[tuple[str, str, Any]] = []
    for field, description in ros2_store().fielddefs[name][1]:
        kind, content = inner_type(description)
        if kind == "array":
            array_fields.append((field, kind, np.dtype(getattr(np, DTYPES.get(content, content)))))
        elif kind in ("one", "list") and _array_fields(content):
            array_fields.append((field, kind, content))
    return tuple(array_fields)


def _cast(message: Any, name: str) -> Any:
    """Return the message or, if arrays have other dtypes than in the definition, a view of it."""
    converted_fields: dict[str, object] = {}
    for field, kind, content in _array_fields(name):
        value = getattr(message, field)
        if kind == "array":
            is_exact = (
                isinstance(value, np.ndarray)
                and value.dtype == content
                and value.ndim == 1
                and value.flags.c_contiguous
            )
            array = value if is_exact else np.ascontiguousarray(value, dtype=content).reshape(-1)
        elif kind == "one":
            array = _cast(value, content)
        else:
            converted_list = [_cast(element, content) for element in value]
            is_same = all(a is b for a, b in zip(converted_list, value, strict=True))
            array = value if is_same else converted_list
        if array is not value:
            converted_fields[field] = array
    if not converted_fields:
        return message
    return FieldView({**vars(message), **converted_fields})


@functools.cache
def _field_pairs(name: str) -> tuple[tuple[str, str, str, str], ...] | None:
    """Return name, name on the bus, form, inner type of a ROS 1 type's fields; None if equal."""
    bus_fields = {field.lower(): field for field, _ in ros2_store().fielddefs[name][1]}
    pairs: list[tuple[str, str, str, str]] = []
    is_equal = True
    for field, description in ros1_store().fielddefs[name][1]:
        kind, type_name = inner_type(description)
        bus_field = bus_fields.get(field.lower(), "")
        pairs.append((field, bus_field, kind, type_name))
        has_inner = kind in ("one", "list") and _field_pairs(type_name) is not None
        is_equal = is_equal and bus_field == field and not has_inner
    is_equal = is_equal and len(pairs) == len(bus_fields)
    return None if is_equal else tuple(pairs)


def _to_ros1_view(message: Any, seq: int, name: str) -> Any:
    """Return a message as the serializer of ROS 1 reads it."""
    pairs = _field_pairs(name)
    if pairs is None:
        return message
    values: dict[str, object] = {}
    for field, bus_field, kind, type_name in pairs:
        value: Any = getattr(message, bus_field) if bus_field else seq
        if kind == "one":
            value = _to_ros1_view(value, seq, type_name)
        elif kind == "list":
            value = [_to_ros1_view(element, seq, type_name) for element in value]
        values[field] = value
    return FieldView(values)


@functools.cache
def _make_reader(name: str) -> Callable[[Any], Any]:
    """Return a function that converts a message of rosbags' ROS 1 class to the class of the bus."""
    cls = ros2_store().types[name]
    fields = []
    ros1_fields = {field.lower(): field for field, _ in ros1_store().fielddefs[name][1]}
    for field, description in ros2_store().fielddefs[name][1]:
        kind, type_name = inner_type(description)
        if field.lower() in ros1_fields:
            read = _make_reader(type_name) if kind in ("one", "list") else None
            fields.append((field, ros1_fields[field.lower()], kind, read))

    def read_message(ros1_message: Any) -> Any:
        values: dict[str, Any] = {}
        for field, ros1_field, kind, read in fields:
            value = getattr(ros1_message, ros1_field)
            if kind == "one" and read is not None:
                value = read(value)
            elif kind == "list" and read is not None:
                value = [read(element) for element in value]
            values[field] = value
        return cls(**values)

    return read_message


def convert_to_class(kind: type[M], message: Any) -> M:
    """Convert a message of another type store, such as a bag's, to a class of the bus.

    Fields are matched by name, without regard to case; a missing field has its default.

    Raises:
        BadMessage: a field without a default is missing.
    """
    values: dict[str, Any] = {}
    # sorted, so that a field (points) replaces a constant of the same name in capitals (POINTS)
    source_fields = {name.lower(): name for name in sorted(vars(message))}
    for field, description in ros2_store().fielddefs[_name_of(kind)][1]:
        if field.lower() not in source_fields:
            continue
        value = getattr(message, source_fields[field.lower()])
        form, type_name = inner_type(description)
        if form == "one":
            value = convert_to_class(ros2_store().types[type_name], value)
        elif form == "list":
            value = [convert_to_class(ros2_store().types[type_name], element) for element in value]
        values[field] = value
    try:
        return kind(**values)
    except TypeError as error:
        raise BadMessage(f"A message is no {_name_of(kind)}: {error}.") from error
