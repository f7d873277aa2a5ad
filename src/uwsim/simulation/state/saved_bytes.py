"""Conversion of states to bytes and back.

Only numbers, texts, arrays, messages and records of uwsim are written and read, so that bytes from
unknown sources run no code.
"""

from __future__ import annotations

import dataclasses
import importlib
import io
import pickle
import zlib
from collections import deque
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from ...base.record import ExternalValue, GeneratorState, changing_fields, field_values
from ...errors import UwsimError
from ...version import __version__

T = TypeVar("T")
ALLOWED_CLASSES = {
    ("numpy", "dtype"),
    ("numpy", "ndarray"),
    ("numpy._core.multiarray", "_reconstruct"),
    ("numpy._core.multiarray", "scalar"),
    ("numpy._core.numeric", "_frombuffer"),
    ("collections", "deque"),
}
"""The classes that are read, besides numbers, texts and dataclasses of uwsim and rosbags."""

PLAIN_TYPES = (bool, int, float, str, bytes, tuple, type(None), np.generic, np.dtype)
"""The types that are pickled as they are."""
OWN_PACKAGES = ("uwsim.", "rosbags.")
"""The prefixes of the modules whose dataclasses are allowed."""
CHECKSUM_SIZE = 4
"""The number of bytes of a checksum."""


def pack(value: object) -> bytes:
    """Return the present value of a record as bytes, with the version of uwsim.

    Raises:
        UwsimError: a value in it cannot be saved.
    """
    try:
        pickler = pickle.Pickler(stream := io.BytesIO(), protocol=5)
        pickler.fast = True  # the same bytes whichever values are one object
        pickler.dump((__version__, _FLATTENERS[type(value)](value)))
        stream.write(_checksum(stream.getbuffer()))
        return stream.getvalue()
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise UwsimError(f"The state cannot be saved: {error}.") from None


def append_checksum(payload: bytes) -> bytes:
    """Return bytes followed by their checksum."""
    return payload + _checksum(payload)


def _checksum(payload: bytes | memoryview) -> bytes:
    return zlib.crc32(payload).to_bytes(CHECKSUM_SIZE, "little")


def unpack(data: bytes, kind: type[T]) -> T:
    """Return the value of the class ``kind`` that `pack` has written.

    Raises:
        UwsimError: the bytes are damaged, or another version of uwsim wrote them.
    """
    if not isinstance(data, bytes):
        raise UwsimError(f"A {type(data).__name__} is no saved simulation; expected bytes.")
    payload = data[:-CHECKSUM_SIZE]
    if len(data) <= CHECKSUM_SIZE or append_checksum(payload) != data:
        raise UwsimError("These bytes are no saved simulation, or they were changed.")
    try:
        version, lists = _Unpickler(io.BytesIO(payload)).load()
        value = _rebuild(lists) if version == __version__ else None  # records differ by version
    except Exception as error:  # damaged bytes can raise any exception
        raise UwsimError(f"These bytes are no saved simulation: {error}.") from None
    if version != __version__:
        raise UwsimError(f"The simulation was not saved by uwsim {__version__}.")
    if not isinstance(value, kind):
        raise UwsimError("These bytes are no saved simulation.")
    return value


class _Flatteners(dict[type, Callable[[Any], Any]]):
    """The functions that convert values to lists before pickling, by the type of the value.

    Pickling is slower for records and arrays than for lists. Each list begins with a tag that names
    the type. Numbers, texts, tuples and messages are not converted.
    """

    def __missing__(self, kind: type) -> Callable[[Any], Any]:
        if issubclass(kind, ExternalValue):
            self[kind] = lambda part: _flatten(part.value())
        elif _is_allowed(kind) and "__slots__" in vars(kind):
            self[kind] = _record_flattener(kind)
        elif _is_allowed(kind) or issubclass(kind, PLAIN_TYPES):
            self[kind] = _keep
        else:
            raise TypeError(f"{kind.__module__}.{kind.__qualname__} is no type of a state")
        return self[kind]


RECORD, ARRAY, LIST, DICT, QUEUE = range(5)
"""The tags of converted values."""


def _record_flattener(kind: type) -> Callable[[Any], list[Any]]:
    """Return the function that converts records of a class to lists.

    Only the fields that can contain other records or arrays are converted themselves.
    """
    name = f"{kind.__module__}:{kind.__qualname__}"
    indices, flatteners = [2 + index for index in changing_fields(kind)], _FLATTENERS

    def flatten(record: Any) -> list[Any]:
        values = [RECORD, name, *field_values(record)]
        for index in indices:
            value = values[index]
            values[index] = flatteners[type(value)](value)
        return values

    return flatten


def _flatten(value: Any) -> Any:
    return _FLATTENERS[type(value)](value)


def _keep(value: Any) -> Any:
    return value


def _flatten_array(array: Any) -> list[Any]:
    kind = array.dtype
    return [ARRAY, kind if kind.names else kind.str, array.shape, array.tobytes()]


_FLATTENERS: _Flatteners = _Flatteners(
    {
        np.ndarray: _flatten_array,
        np.random.Generator: lambda value: _flatten(GeneratorState.from_generator(value)),
        list: lambda value: [LIST, *map(_flatten, value)],
        dict: lambda value: [DICT, *value, *map(_flatten, value.values())],
        deque: lambda value: [QUEUE, value.maxlen, *map(_flatten, value)],
    }
)


def _rebuild(lists: Any) -> Any:
    """Return the value that was converted to lists."""
    if type(lists) is not list:
        return lists
    tag, *rest = lists
    if tag == RECORD:
        return _allowed_dataclass(*rest[0].split(":"))(*map(_rebuild, rest[1:]))
    if tag == ARRAY:
        kind, shape, data = rest
        return np.frombuffer(data, kind).reshape(shape).copy()
    if tag == LIST:
        return [_rebuild(part) for part in rest]
    if tag == QUEUE:
        return deque(map(_rebuild, rest[1:]), rest[0])
    n = len(rest) // 2
    return dict(zip(rest[:n], map(_rebuild, rest[n:]), strict=True))


def _allowed_dataclass(module: str, name: str) -> Any:
    """Return a dataclass of uwsim or rosbags; raise UnpicklingError for other classes."""
    record_class = None
    if module.startswith(OWN_PACKAGES):
        record_class = getattr(importlib.import_module(module), name, None)
    if not _is_allowed(record_class):
        raise pickle.UnpicklingError(f"{module}.{name} is no type of a state")
    return record_class


def _is_allowed(kind: object) -> bool:
    return (
        isinstance(kind, type)
        and dataclasses.is_dataclass(kind)
        and kind.__module__.startswith(OWN_PACKAGES)
    )


class _Unpickler(pickle.Unpickler):
    """An unpickler of numbers, arrays, messages and records that rejects all other classes."""

    def find_class(self, module: str, name: str) -> Any:
        if (module, name) in ALLOWED_CLASSES:
            return super().find_class(module, name)
        return _allowed_dataclass(module, name)
