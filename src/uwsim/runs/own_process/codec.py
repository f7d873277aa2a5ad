"""The encoding of values as frames (bytes) between the simulation and an algorithm's process.

A frame begins with the length of its JSON (4 bytes, little-endian). Then follow the JSON, which
preserves every float64, and the bytes of all arrays and byte strings, in the order in which the
JSON refers to them. A frame decodes to numbers, texts, bytes, lists, tuples, dicts, arrays, and
classes and objects of message types that this process has already loaded. Decoding executes no code
of the sender and imports nothing. A value that JSON cannot represent is an object with one key:
``t`` tuple, ``d`` dict, ``m`` message, ``a`` array, ``s`` array scalar, ``b`` bytes, ``c`` message
class, ``o`` any other object, as its ``repr``.
"""

from __future__ import annotations

import dataclasses
import functools
import json
import math
import struct
import sys
from collections.abc import Hashable
from typing import Any, cast

import numpy as np

MAX_FRAME = 2**30
"""The greatest length of a frame [bytes]."""
_encode_json = json.JSONEncoder(separators=(",", ":"), check_circular=False).encode
_decode_json = json.JSONDecoder().decode
_LENGTH = struct.Struct("<I")
_ARRAYS = (np.ndarray, np.generic)
_BASES: tuple[Any, ...] = (bool, int, float, str, list, tuple, dict)
_SCALARS = frozenset((type(None), bool, int, float, str))
_CACHE_SIZE = 10_000
_SYNTAX_ERRORS = (SyntaxError, RecursionError)  # of a dtype such as "f8,,", and of nested JSON
_CONTENT_ERRORS = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
MAX_DEPTH = 100
"""The greatest depth of nested values in a frame, which also ends values that contain
themselves."""


class FrameError(Exception):
    """An error in bytes that should be a frame."""


class UnknownValue:
    """A substitute for a value that cannot be sent, with the ``repr`` of that value."""

    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


def encode(value: object) -> bytes:
    """Return a value as a frame.

    Numbers, texts, bytes, lists, tuples, dicts, arrays, messages and message classes are decoded as
    such. A class that is not a message class makes the frame undecodable. Any other value becomes
    an `UnknownValue` in the other process.
    """
    arrays: list[bytes] = []
    head = _encode_json(_to_json(value, arrays)).encode()
    return b"".join((_LENGTH.pack(len(head)), head, *arrays))


def decode(frame: bytes) -> Any:
    """Return the value of a frame; its arrays are read-only.

    Raises:
        FrameError: the bytes are not a frame.
    """
    try:
        (n,) = _LENGTH.unpack_from(frame)
        start = _LENGTH.size + n
        value, end = _Reader(frame, start).value(_decode_json(frame[_LENGTH.size : start].decode()))
    except struct.error:
        raise FrameError(f"{len(frame)} bytes, which end too early") from None
    except (*_CONTENT_ERRORS, *_SYNTAX_ERRORS) as error:
        raise FrameError(f"{type(error).__name__}: {error}") from error
    if end != len(frame):
        raise FrameError(f"{len(frame) - end} bytes too many")
    return value


def _to_json(value: Any, arrays: list[bytes], depth: int = 0) -> object:
    """Return a value as JSON types, and append the bytes of its arrays to ``arrays``."""
    cls: Any = value.__class__
    if cls in _SCALARS:
        return value
    if depth > MAX_DEPTH:
        return {"o": [cls.__name__, _safe_repr(value)]}
    depth += 1  # the depth of the parts of the value
    if cls is list:
        return [_to_json(item, arrays, depth) for item in value]
    if cls is tuple:
        return {"t": [_to_json(item, arrays, depth) for item in value]}
    if cls is dict:
        pairs = [(_to_json(k, arrays, depth), _to_json(v, arrays, depth)) for k, v in value.items()]
        return {"d": [list(pair) for pair in pairs]}
    if hasattr(cls, "__dataclass_fields__") and message_class(name := _qualified_name(cls)) is cls:
        fields = [getattr(value, field) for field in _field_names(cls)]
        values = (v if v.__class__ in _SCALARS else _to_json(v, arrays, depth) for v in fields)
        return {"m": [name, *values]}
    if isinstance(value, _ARRAYS) and value.dtype.kind in "biufSU":
        arrays.append(value.tobytes())
        key = "a" if isinstance(value, np.ndarray) else "s"
        return {key: [value.dtype.str, *value.shape]}
    if isinstance(value, bytes):
        arrays.append(value)
        return {"b": len(value)}
    if isinstance(value, type):
        return {"c": _qualified_name(value)}
    base_type = next((cls_ for cls_ in _BASES if isinstance(value, cls_)), None)
    if base_type is not None:
        return _to_json(base_type(value), arrays, depth)
    return {"o": [cls.__name__, _safe_repr(value)]}


class _Reader:
    """A reader of the value of a frame, with the bytes of its arrays.

    Args:
        frame: the frame.
        start: the index of the first byte after the JSON.
    """

    def __init__(self, frame: bytes, start: int) -> None:
        self._frame, self._offset = frame, start

    def value(self, node: object) -> tuple[Any, int]:
        return self._read(node), self._offset

    def _read(self, node: Any) -> Any:
        if node.__class__ in _SCALARS:
            return node
        if node.__class__ is list:
            return [self._read(item) for item in node]
        ((tag, rest),) = node.items()
        if tag == "m":
            return self._message(*rest)
        if tag in ("a", "s"):
            return self._array(tag, *rest)
        if tag == "t":
            return tuple(self._read(item) for item in rest)
        if tag == "d":
            return {self._read(key): self._read(value) for key, value in rest}
        if tag == "b":
            return self._bytes(int(rest))
        if tag == "c":
            return _class_of(rest)
        if tag == "o":
            return type(str(rest[0]), (UnknownValue,), {})(str(rest[1]))
        raise ValueError(f"unknown tag {tag!r}")

    def _message(self, name: str, *values: object) -> object:
        cls = _class_of(name)
        message: object = object.__new__(cls)
        for field, value in zip(_field_names(cls), values, strict=True):
            field_value = value if value.__class__ in _SCALARS else self._read(value)
            object.__setattr__(message, field, field_value)  # also if the message is frozen
        return message

    def _array(self, tag: str, dtype: str, *shape: int) -> Any:
        kind = np.dtype(dtype)
        if kind.kind not in "biufSU":
            raise ValueError(f"an array of the type {dtype!r} is not allowed")
        n = math.prod(shape)
        array = np.frombuffer(self._bytes(n * kind.itemsize), dtype=kind).reshape(shape)
        return array[()] if tag == "s" else array

    def _bytes(self, n: int) -> bytes:
        if not 0 <= n <= len(self._frame) - self._offset:
            raise ValueError("the bytes of an array are missing")
        self._offset += n
        return self._frame[self._offset - n : self._offset]


@functools.lru_cache(_CACHE_SIZE)
def _qualified_name(cls: Hashable) -> str:
    assert isinstance(cls, type)
    return f"{cls.__module__}:{cls.__qualname__}"


def _class_of(name: str) -> type:
    cls = message_class(name)
    if cls is None:
        raise ValueError(f"unknown message class {name!r}")
    return cls


def message_class(name: str) -> type | None:
    """Return the message class ``module:Class``; None if this process has not loaded it.

    A message class is a dataclass; in uwsim, a dataclass with a ROS name. The name of ``object``
    gives ``object``. Nothing is imported.
    """
    if name == "builtins:object":
        return object
    module, path = _split_name(name)
    cls: Any = sys.modules.get(module)
    for part in path:
        cls = getattr(cls, part, None)
    return cls if isinstance(cls, type) and _is_message(cast(Hashable, cls), module) else None


@functools.lru_cache(_CACHE_SIZE)
def _split_name(name: str) -> tuple[str, tuple[str, ...]]:
    """Return the module of ``module:Class``, and the names that lead from it to the class."""
    module, _, path = name.partition(":")
    return module, tuple(path.split("."))


@functools.lru_cache(_CACHE_SIZE)
def _is_message(cls: Hashable, module: str) -> bool:
    is_own = module.partition(".")[0] == "uwsim"
    return dataclasses.is_dataclass(cls) and (hasattr(cls, "__msgtype__") or not is_own)


@functools.lru_cache(_CACHE_SIZE)
def _field_names(cls: Any) -> tuple[str, ...]:
    names = [field.name for field in dataclasses.fields(cls)]
    return tuple(name for name in names if name != "__msgtype__")  # rosbags has it as a field


def _safe_repr(value: object) -> str:
    """Return at most 1000 characters of the ``repr`` of a value, which may raise an exception."""
    try:
        return repr(value)[:1000]
    except Exception:
        return f"a {type(value).__name__}"
