"""Messages as JSON objects, in the form of the rosbridge protocol.

Arrays of bytes are base64 text; what is not finite is null; numbers keep all their digits. On the
way in a field may be left out, which then has ROS's default, arrays of bytes may be lists, times
may have the names of ROS 1 (``secs``, ``nsecs``), and a header may have its ``seq``.
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
BYTES = ("uint8", "byte", "char")
DTYPES = {"bool": "bool_", "byte": "uint8", "char": "uint8"}
INTEGERS = ("byte", "char", *(f"{sign}int{n}" for sign in ("", "u") for n in (8, 16, 32, 64)))
LARGEST = {name: float(np.finfo(name).max) for name in ("float32", "float64")}
"""Type -> its largest number; JSON can have larger ones."""
ROS1_NAMES = {"secs": "sec", "nsecs": "nanosec"}
"""Names of ROS 1 in times."""
IGNORED = frozenset({"seq"})
"""Of the header of ROS 1."""


def to_json(message: object) -> dict[str, Any]:
    """Return a message as a JSON object; BadMessage if its type has no definition."""
    found = _fields(_name(type(message)))
    return {name: _out(getattr(message, name), kind) for name, kind, _, _ in found}


def to_plain(message: object) -> dict[str, Any]:
    """Return a message as nested dicts and lists with its arrays, for encodings that have them."""
    found = _fields(_name(type(message)))
    return {name: _plain(getattr(message, name), kind) for name, kind, _, _ in found}


def _plain(value: Any, kind: str) -> Any:
    if kind == "message":
        return to_plain(value)
    if kind == "messages":
        return [to_plain(each) for each in value]
    if kind in ("bytes", "numbers"):
        return np.asarray(value)
    if kind == "number":
        return value.item() if isinstance(value, np.generic) else value
    return _out(value, kind)


def from_json(cls: type[M], values: object) -> M:
    """Return the message of a class that a JSON object holds.

    Raises:
        BadMessage: it has a field that the type does not have, or one of another kind.
    """
    return _message(cls, values, "")


def _message(cls: type[M], values: object, at: str) -> M:
    name = _name(cls)
    if not isinstance(values, Mapping):
        raise BadMessage(f"{at.rstrip('.') or name} is {_shown(values)}; expected an object.")
    known = {field[0]: field for field in _fields(name)}
    if len(values) > len(known) + len(ROS1_NAMES) + len(IGNORED):
        raise BadMessage(
            f"{at.rstrip('.') or name} has {len(values)} fields; {name} has {', '.join(known)}."
        )
    found: dict[str, object] = {}
    for key, value in values.items():
        field = ROS1_NAMES.get(key, key) if key not in known else key
        if field in known:
            _, kind, inner, length = known[field]
            found[field] = _in(value, kind, inner, length, f"{at}{field}")
        elif key not in IGNORED:
            raise BadMessage(f"{name} has no field {at}{key!s:.100}; it has {', '.join(known)}.")
    for field, default in _needed(cast(Any, cls)):
        found.setdefault(field, default() if callable(default) else default)
    return cls(**found)


def _out(value: Any, kind: str) -> Any:
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
            return [each if math.isfinite(each) else None for each in array.tolist()]
        return array.tolist()
    if kind == "messages":
        return [to_json(each) for each in value]
    return list(value) if kind == "texts" else str(value)


def _in(value: Any, kind: str, inner: str, length: int, at: str) -> Any:
    if kind == "message":
        return _message(message_class(inner), value, f"{at}.")
    if kind == "text":
        if not isinstance(value, str):
            raise BadMessage(f"{at} is {_shown(value)}; expected text.")
        return value
    if kind == "number":
        return _number(value, inner, at)
    if kind == "bytes" and isinstance(value, str):
        try:
            array = np.frombuffer(base64.b64decode(value, validate=True), np.uint8).copy()
        except (binascii.Error, ValueError):
            raise BadMessage(f"{at} is {_shown(value)}; expected base64.") from None
        return _sized(array, length, at)
    if not isinstance(value, list):
        raise BadMessage(f"{at} is {_shown(value)}; expected a list.")
    if kind == "messages":
        cls = message_class(inner)
        items: list[Any] = [_message(cls, each, f"{at}[{i}].") for i, each in enumerate(value)]
        return _sized(items, length, at)
    if kind == "texts":
        return _sized([_in(each, "text", "", 0, at) for each in value], length, at)
    try:
        numbers = [math.nan if each is None else each for each in value]
        with np.errstate(over="raise", invalid="raise"):
            array = np.array(numbers, dtype=DTYPES.get(inner, inner))
        if array.ndim != 1 or (inner.startswith("float") and np.isinf(array).any()):
            raise ValueError("it is nested, or a number is too large")
        return _sized(array, length, at)
    except (TypeError, ValueError, OverflowError, FloatingPointError):
        raise BadMessage(f"{at} is {_shown(value)}; expected numbers ({inner}).") from None


def _number(value: Any, inner: str, at: str) -> Any:
    if inner == "bool" and isinstance(value, bool):
        return value
    if inner.startswith("float") and value is None:
        return math.nan
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and inner.startswith("float") and not abs(value) > LARGEST.get(inner, 0):
        return float(value)
    if is_number and inner in INTEGERS:
        limits = np.iinfo(DTYPES.get(inner, inner))
        if limits.min <= value <= limits.max and value == int(value):
            return int(value)
    raise BadMessage(f"{at} is {_shown(value)}; expected a value of type {inner}.")


def _sized(values: Any, length: int, at: str) -> Any:
    if length and len(values) != length:
        raise BadMessage(f"{at} has {len(values)} values; expected {length}.")
    return values


@functools.cache
def _fields(name: str) -> tuple[tuple[str, str, str, int], ...]:
    """Field, kind, type inside, and length of an array of fixed length (else 0)."""
    found = []
    for field, (node, inner) in ros2_store().fielddefs[name][1]:
        if field == PLACEHOLDER:
            continue
        length = 0
        is_many = node in (Nodetype.ARRAY, Nodetype.SEQUENCE)
        if is_many:
            length = inner[1] if node == Nodetype.ARRAY else 0
            node, inner = inner[0]
        if node == Nodetype.NAME:
            kind, inside = ("messages" if is_many else "message"), str(inner)
        else:
            inside = str(inner[0])
            kind = "text" if inside in ("string", "wstring") else "number"
            if is_many:
                kind = "texts" if kind == "text" else "bytes" if inside in BYTES else "numbers"
        found.append((field, kind, inside, length))
    return tuple(found)


@functools.cache
def _needed(cls: type) -> tuple[tuple[str, Any], ...]:
    """Fields whose class has no default for them, with ROS's."""
    without = {
        field.name
        for field in fields(cls)
        if field.default is MISSING and field.default_factory is MISSING
    }
    return tuple(
        (field, functools.partial(_default, kind, inner, length))
        for field, kind, inner, length in _fields(_name(cls))
        if field in without
    )


def _default(kind: str, inner: str, length: int) -> Any:
    if kind == "message":
        return _message(message_class(inner), {}, "")
    if kind in ("bytes", "numbers"):
        return np.zeros(length, dtype=DTYPES.get(inner, inner))
    if kind == "number":
        return False if inner == "bool" else 0.0 if inner.startswith("float") else 0
    if kind == "text":
        return ""
    return [_default("message" if kind == "messages" else "text", inner, 0) for _ in range(length)]


def _name(cls: type) -> str:
    name = str(getattr(cls, "__msgtype__", ""))
    if name not in ros2_store().fielddefs:
        raise BadMessage(f"{cls.__name__} has no message definition.")
    return name


def _shown(value: object) -> str:
    text = " ".join(repr(value)[:200].split())
    return text if len(text) <= 60 else text[:57] + "..."
