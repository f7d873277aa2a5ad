"""Messages as JSON objects, in the form of the rosbridge protocol.

Arrays of bytes are base64 text, numbers that are not finite are null, numbers keep all their
digits. In a message from a client, a missing field has the default of ROS, an array of bytes may be
a list, a time may have the field names of ROS 1 (``secs``, ``nsecs``), and a header may have the
field ``seq`` of ROS 1.
"""

from __future__ import annotations

import base64
import binascii
import functools
import math
from collections.abc import Mapping
from dataclasses import MISSING, fields
from typing import Any, TypeVar, cast

import numpy as np
from rosbags.interfaces import Nodetype

from ..errors import BadMessage
from .types import PLACEHOLDER, message_class, ros2_store

M = TypeVar("M")
BYTE_TYPES = ("uint8", "byte", "char")
"""The types of fields whose arrays are base64 text."""
DTYPES = {"bool": "bool_", "byte": "uint8", "char": "uint8"}
"""The names in NumPy of the types of fields, where they differ."""
INTEGER_TYPES = ("byte", "char", *(f"{sign}int{n}" for sign in ("", "u") for n in (8, 16, 32, 64)))
LARGEST_FLOATS = {name: float(np.finfo(name).max) for name in ("float32", "float64")}
"""The largest finite number of each float type; JSON can represent larger numbers."""
ROS1_NAMES = {"secs": "sec", "nsecs": "nanosec"}
"""The fields of times: their names in ROS 2 by their names in ROS 1."""
IGNORED_FIELDS = frozenset({"seq"})
"""The fields of ROS 1 headers that are ignored."""


def to_json(message: object) -> dict[str, Any]:
    """Return a message as a JSON object; raise BadMessage if its type has no definition."""
    fields = _fields(_name(type(message)))
    return {name: _json_value(getattr(message, name), kind) for name, kind, _, _ in fields}


def to_plain(message: object) -> dict[str, Any]:
    """Return a message as nested dicts and lists that keep NumPy arrays, for CBOR."""
    fields = _fields(_name(type(message)))
    return {name: _plain_value(getattr(message, name), kind) for name, kind, _, _ in fields}


def _plain_value(value: Any, kind: str) -> Any:
    if kind == "message":
        return to_plain(value)
    if kind == "messages":
        return [to_plain(element) for element in value]
    if kind in ("bytes", "numbers"):
        return np.asarray(value)
    if kind == "number":
        return value.item() if isinstance(value, np.generic) else value
    return _json_value(value, kind)


def from_json(cls: type[M], values: object) -> M:
    """Return the message of a class from a JSON object.

    Raises:
        BadMessage: the object has a field that the message does not have, or of another type.
    """
    return _message(cls, values, "")


def _message(cls: type[M], values: object, path: str) -> M:
    name = _name(cls)
    if not isinstance(values, Mapping):
        raise BadMessage(f"{path.rstrip('.') or name} is {_excerpt(values)}; expected an object.")
    specs = {field[0]: field for field in _fields(name)}
    if len(values) > len(specs) + len(ROS1_NAMES) + len(IGNORED_FIELDS):
        raise BadMessage(
            f"{path.rstrip('.') or name} has {len(values)} fields; {name} has {', '.join(specs)}."
        )
    field_values: dict[str, object] = {}
    for key, value in values.items():
        field = ROS1_NAMES.get(key, key) if key not in specs else key
        if field in specs:
            _, kind, type_name, length = specs[field]
            field_values[field] = _read(value, kind, type_name, length, f"{path}{field}")
        elif key not in IGNORED_FIELDS:
            raise BadMessage(f"{name} has no field {path}{key!s:.100}; it has {', '.join(specs)}.")
    for field, default in _required_fields(cast(Any, cls)):
        field_values.setdefault(field, default() if callable(default) else default)
    return cls(**field_values)


def _json_value(value: Any, kind: str) -> Any:
    if kind == "number":
        number = value.item() if isinstance(value, np.generic) else value
        return None if isinstance(number, float) and not math.isfinite(number) else number
    if kind == "message":
        return to_json(value)
    if kind == "bytes":
        return base64.b64encode(np.asarray(value, np.uint8).tobytes()).decode()
    if kind == "numbers":
        array = np.asarray(value)
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            return [element if math.isfinite(element) else None for element in array.tolist()]
        return array.tolist()
    if kind == "messages":
        return [to_json(element) for element in value]
    return list(value) if kind == "texts" else str(value)


def _read(value: Any, kind: str, type_name: str, length: int, path: str) -> Any:
    if kind == "message":
        return _message(message_class(type_name), value, f"{path}.")
    if kind == "text":
        if not isinstance(value, str):
            raise BadMessage(f"{path} is {_excerpt(value)}; expected text.")
        return value
    if kind == "number":
        return _read_number(value, type_name, path)
    if kind == "bytes" and isinstance(value, str):
        try:
            array = np.frombuffer(base64.b64decode(value, validate=True), np.uint8).copy()
        except (binascii.Error, ValueError):
            raise BadMessage(f"{path} is {_excerpt(value)}; expected base64.") from None
        return _check_length(array, length, path)
    if not isinstance(value, list):
        raise BadMessage(f"{path} is {_excerpt(value)}; expected a list.")
    if kind == "messages":
        cls = message_class(type_name)
        messages: list[Any] = [_message(cls, item, f"{path}[{i}].") for i, item in enumerate(value)]
        return _check_length(messages, length, path)
    if kind == "texts":
        return _check_length([_read(item, "text", "", 0, path) for item in value], length, path)
    try:
        numbers = [math.nan if item is None else item for item in value]
        with np.errstate(over="raise", invalid="raise"):
            array = np.array(numbers, dtype=DTYPES.get(type_name, type_name))
        if array.ndim != 1 or (type_name.startswith("float") and np.isinf(array).any()):
            raise ValueError("the list is nested, or a number is too large")
        return _check_length(array, length, path)
    except (TypeError, ValueError, OverflowError, FloatingPointError):
        raise BadMessage(f"{path} is {_excerpt(value)}; expected numbers ({type_name}).") from None


def _read_number(value: Any, dtype: str, path: str) -> Any:
    if dtype == "bool" and isinstance(value, bool):
        return value
    if dtype.startswith("float") and value is None:
        return math.nan
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and dtype.startswith("float") and not abs(value) > LARGEST_FLOATS.get(dtype, 0):
        return float(value)
    if is_number and dtype in INTEGER_TYPES:
        limits = np.iinfo(DTYPES.get(dtype, dtype))
        if limits.min <= value <= limits.max and value == int(value):
            return int(value)
    raise BadMessage(f"{path} is {_excerpt(value)}; expected a value of type {dtype}.")


def _check_length(values: Any, length: int, path: str) -> Any:
    if length and len(values) != length:
        raise BadMessage(f"{path} has {len(values)} values; expected {length}.")
    return values


@functools.cache
def _fields(name: str) -> tuple[tuple[str, str, str, int], ...]:
    """Return name, kind, inner type, and length (0: variable) of each field of a message type."""
    type_fields = []
    for field, (node, content) in ros2_store().fielddefs[name][1]:
        if field == PLACEHOLDER:
            continue
        length = 0
        is_many = node in (Nodetype.ARRAY, Nodetype.SEQUENCE)
        if is_many:
            length = content[1] if node == Nodetype.ARRAY else 0
            node, content = content[0]
        if node == Nodetype.NAME:
            kind, type_name = ("messages" if is_many else "message"), str(content)
        else:
            type_name = str(content[0])
            kind = "text" if type_name in ("string", "wstring") else "number"
            if is_many:
                kind = (
                    "texts" if kind == "text" else "bytes" if type_name in BYTE_TYPES else "numbers"
                )
        type_fields.append((field, kind, type_name, length))
    return tuple(type_fields)


@functools.cache
def _required_fields(cls: type) -> tuple[tuple[str, Any], ...]:
    """Return the fields for which the class has no default, with their default in ROS."""
    names = {
        field.name
        for field in fields(cls)
        if field.default is MISSING and field.default_factory is MISSING
    }
    return tuple(
        (field, functools.partial(_default, kind, content_type, length))
        for field, kind, content_type, length in _fields(_name(cls))
        if field in names
    )


def _default(kind: str, type_name: str, length: int) -> Any:
    if kind == "message":
        return _message(message_class(type_name), {}, "")
    if kind in ("bytes", "numbers"):
        return np.zeros(length, dtype=DTYPES.get(type_name, type_name))
    if kind == "number":
        return False if type_name == "bool" else 0.0 if type_name.startswith("float") else 0
    if kind == "text":
        return ""
    return [
        _default("message" if kind == "messages" else "text", type_name, 0) for _ in range(length)
    ]


def _name(cls: type) -> str:
    name = str(getattr(cls, "__msgtype__", ""))
    if name not in ros2_store().fielddefs:
        raise BadMessage(f"{cls.__name__} has no message definition.")
    return name


def _excerpt(value: object) -> str:
    text = " ".join(repr(value)[:200].split())
    return text if len(text) <= 60 else text[:57] + "..."
