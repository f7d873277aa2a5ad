"""Messages as bytes: CDR of ROS 2, and the encoding of ROS 1.

Both are rosbags'. What differs between the class on the bus (ROS 2's) and the type of ROS 1 is
mapped here, field by field: ROS 1's header has ``seq``, its CameraInfo has ``D K R P``, its Range
no variance, its Marker no texture. Arrays of another dtype than the definition's are converted.
Bytes that do not fit the type raise BadMessage.
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
"""CDR of a type without fields: ROS 2 gives it one byte."""
DTYPES = {"bool": "bool_", "byte": "uint8", "char": "uint8"}
HEADER = "std_msgs/msg/Header"


class Ros1View:
    """The fields of a message under their names in ROS 1."""

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
    """Return the message that CDR bytes hold; raises BadMessage if they hold no such message."""
    name = _name_of(kind)
    if is_fieldless(name):
        return kind()
    try:
        return cast(M, ros2_store().deserialize_cdr(data, name))
    except (SerdeError, ValueError, IndexError, TypeError, MemoryError) as error:
        raise BadMessage(f"{len(data)} bytes are no {name}: {error}") from error


def to_ros1(message: object, *, seq: int = 0) -> memoryview:
    """Return a message in the encoding of ROS 1; ``seq`` goes into its header.

    Raises:
        BadMessage: ROS 1 has no such type.
    """
    name = _name_of(type(message))
    if name not in ros1_store().fielddefs:
        raise BadMessage(f"ROS 1 has no type {name}.")
    if is_fieldless(name):
        return memoryview(b"")
    try:
        view = _as_ros1(_cast(message, name), seq, name)
        return cast(memoryview, ros1_store().serialize_ros1(view, name))
    except Exception as error:
        raise BadMessage(f"{name} cannot be encoded: {error}") from error


def from_ros1(kind: type[M], data: bytes | memoryview) -> M:
    """Return the message that bytes of ROS 1 hold; BadMessage if they hold no such message."""
    name = _name_of(kind)
    if name not in ros1_store().fielddefs:
        raise BadMessage(f"ROS 1 has no type {name}.")
    if is_fieldless(name):
        return kind()
    try:
        return cast(M, _reader(name)(ros1_store().deserialize_ros1(data, name)))
    except (SerdeError, ValueError, IndexError, TypeError, MemoryError, KeyError) as error:
        raise BadMessage(f"{len(data)} bytes are no {name}: {error}") from error


def _name_of(kind: type) -> str:
    name = getattr(kind, "__msgtype__", None)
    if name not in ros2_store().fielddefs:
        raise BadMessage(f"{kind.__name__} has no message definition.")
    return str(name)


@functools.cache
def inner_type(description: Any) -> tuple[str, str]:
    """Return ``("list" | "one" | "base" | "array" | "texts", inner type)`` of a field."""
    kind, inner = description
    if kind == Nodetype.NAME:
        return "one", inner
    if kind == Nodetype.BASE:
        return "base", inner[0]
    (kind, inner), _ = inner
    if kind == Nodetype.NAME:
        return "list", inner
    return ("texts" if inner[0] == "string" else "array"), inner[0]


@functools.cache
def _arrays(name: str) -> tuple[tuple[str, str, Any], ...]:
    """Fields that are arrays, with their dtype, or that hold messages with arrays."""
    found: list[tuple[str, str, Any]] = []
    for field, description in ros2_store().fielddefs[name][1]:
        kind, inner = inner_type(description)
        if kind == "array":
            found.append((field, kind, np.dtype(getattr(np, DTYPES.get(inner, inner)))))
        elif kind in ("one", "list") and _arrays(inner):
            found.append((field, kind, inner))
    return tuple(found)


def _cast(message: Any, name: str) -> Any:
    """The message, or a view of it whose arrays have the dtypes of the definition."""
    changed: dict[str, object] = {}
    for field, kind, inner in _arrays(name):
        value = getattr(message, field)
        if kind == "array":
            is_exact = (
                isinstance(value, np.ndarray)
                and value.dtype == inner
                and value.ndim == 1
                and value.flags.c_contiguous
            )
            new = value if is_exact else np.ascontiguousarray(value, dtype=inner).reshape(-1)
        elif kind == "one":
            new = _cast(value, inner)
        else:
            cast_ones = [_cast(each, inner) for each in value]
            is_same = all(a is b for a, b in zip(cast_ones, value, strict=True))
            new = value if is_same else cast_ones
        if new is not value:
            changed[field] = new
    if not changed:
        return message
    return Ros1View({**vars(message), **changed})


@functools.cache
def _pairs(name: str) -> tuple[tuple[str, str, str, str], ...] | None:
    """Of a ROS 1 type: field there, field on the bus or "", kind, inner type; None if all equal."""
    ours = {field.lower(): field for field, _ in ros2_store().fielddefs[name][1]}
    pairs: list[tuple[str, str, str, str]] = []
    is_equal = True
    for field, description in ros1_store().fielddefs[name][1]:
        kind, inner = inner_type(description)
        mine = ours.get(field.lower(), "")
        pairs.append((field, mine, kind, inner))
        has_inner = kind in ("one", "list") and _pairs(inner) is not None
        is_equal = is_equal and mine == field and not has_inner
    is_equal = is_equal and len(pairs) == len(ours)
    return None if is_equal else tuple(pairs)


def _as_ros1(message: Any, seq: int, name: str) -> Any:
    """A message as the serialiser of ROS 1 reads it."""
    pairs = _pairs(name)
    if pairs is None:
        return message
    values: dict[str, object] = {}
    for field, mine, kind, inner in pairs:
        value: Any = getattr(message, mine) if mine else seq
        if kind == "one":
            value = _as_ros1(value, seq, inner)
        elif kind == "list":
            value = [_as_ros1(each, seq, inner) for each in value]
        values[field] = value
    return Ros1View(values)


@functools.cache
def _reader(name: str) -> Callable[[Any], Any]:
    """What makes the class of the bus from rosbags' class of ROS 1."""
    cls = ros2_store().types[name]
    fields = []
    theirs = {field.lower(): field for field, _ in ros1_store().fielddefs[name][1]}
    for field, description in ros2_store().fielddefs[name][1]:
        kind, inner = inner_type(description)
        if field.lower() in theirs:
            read = _reader(inner) if kind in ("one", "list") else None
            fields.append((field, theirs[field.lower()], kind, read))

    def read_message(found: Any) -> Any:
        values: dict[str, Any] = {}
        for field, other, kind, read in fields:
            value = getattr(found, other)
            if kind == "one" and read is not None:
                value = read(value)
            elif kind == "list" and read is not None:
                value = [read(each) for each in value]
            values[field] = value
        return cls(**values)

    return read_message


def of_class(kind: type[M], found: Any) -> M:
    """Return a message of another type store, as of a file, as one of a class of the bus.

    Fields are found by their names, whatever their case; one that it lacks has its default.

    Raises:
        BadMessage: it lacks a field that has no default.
    """
    values: dict[str, Any] = {}
    # of a constant POINTS and a field points the field, which is the later in this order
    theirs = {name.lower(): name for name in sorted(vars(found))}
    for field, description in ros2_store().fielddefs[_name_of(kind)][1]:
        if field.lower() not in theirs:
            continue
        value = getattr(found, theirs[field.lower()])
        form, inner = inner_type(description)
        if form == "one":
            value = of_class(ros2_store().types[inner], value)
        elif form == "list":
            value = [of_class(ros2_store().types[inner], each) for each in value]
        values[field] = value
    try:
        return kind(**values)
    except TypeError as error:
        raise BadMessage(f"A message is no {_name_of(kind)}: {error}.") from error
