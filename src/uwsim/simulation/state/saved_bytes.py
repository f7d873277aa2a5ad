"""Records as bytes: of numbers, texts, arrays, messages and records of uwsim, and nothing else."""

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
ALLOWED = {
    ("numpy", "dtype"),
    ("numpy", "ndarray"),
    ("numpy._core.multiarray", "_reconstruct"),
    ("numpy._core.multiarray", "scalar"),
    ("numpy._core.numeric", "_frombuffer"),
    ("collections", "deque"),
}
"""Types allowed in bytes, besides numbers, texts and dataclasses of uwsim and rosbags."""

PLAIN = (bool, int, float, str, bytes, tuple, type(None), np.generic, np.dtype)
"""Types of which bytes are made as they are."""
OWN_PACKAGES = ("uwsim.", "rosbags.")
CHECKSUM = 4
"""Bytes of a checksum."""


def pack(value: object) -> bytes:
    """Return the present value of a record as bytes, with the version of uwsim.

    Raises:
        UwsimError: something in it has no bytes.
    """
    try:
        pickler = pickle.Pickler(stream := io.BytesIO(), protocol=5)
        pickler.fast = True  # the same bytes whichever values are one object
        pickler.dump((__version__, _FLAT[type(value)](value)))
        stream.write(_checksum(stream.getbuffer()))
        return stream.getvalue()
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise UwsimError(f"The state cannot be saved: {error}.") from None


def with_checksum(payload: bytes) -> bytes:
    """Return bytes with their checksum behind them."""
    return payload + _checksum(payload)


def _checksum(payload: bytes | memoryview) -> bytes:
    return zlib.crc32(payload).to_bytes(CHECKSUM, "little")


def unpack(data: bytes, kind: type[T]) -> T:
    """Read a value of a type from bytes.

    Raises:
        UwsimError: these are no such bytes, or another version of uwsim wrote them.
    """
    if not isinstance(data, bytes):
        raise UwsimError(f"A {type(data).__name__} is no saved simulation; expected bytes.")
    payload = data[:-CHECKSUM]
    if len(data) <= CHECKSUM or with_checksum(payload) != data:
        raise UwsimError("These bytes are no saved simulation, or they were changed.")
    try:
        version, flat = _Unpickler(io.BytesIO(payload)).load()
        value = _raised(flat) if version == __version__ else None  # records differ by version
    except Exception as error:  # whatever damaged bytes make of themselves
        raise UwsimError(f"These bytes are no saved simulation: {error}.") from None
    if version != __version__:
        raise UwsimError(f"The simulation was not saved by uwsim {__version__}.")
    if not isinstance(value, kind):
        raise UwsimError("These bytes are no saved simulation.")
    return value


class _Flat(dict[type, Callable[[Any], Any]]):
    """What makes lists of a value, by its type: pickle takes longer for records and arrays.

    A list in what it makes begins with a tag. Numbers, texts, tuples and messages stay.
    """

    def __missing__(self, kind: type) -> Callable[[Any], Any]:
        if issubclass(kind, ExternalValue):
            self[kind] = lambda part: _flat(part.value())
        elif _is_allowed(kind) and "__slots__" in vars(kind):
            self[kind] = _record_flattener(kind)
        elif _is_allowed(kind) or issubclass(kind, PLAIN):
            self[kind] = _itself
        else:
            raise TypeError(f"{kind.__module__}.{kind.__qualname__} has no place in bytes")
        return self[kind]


RECORD, ARRAY, LIST, DICT, QUEUE = range(5)


def _record_flattener(kind: type) -> Callable[[Any], list[Any]]:
    """Return what makes lists of the records of a class: most fields stay as they are."""
    name = f"{kind.__module__}:{kind.__qualname__}"
    places, flat = [2 + place for place in changing_fields(kind)], _FLAT

    def flatten(record: Any) -> list[Any]:
        values = [RECORD, name, *field_values(record)]
        for place in places:
            value = values[place]
            values[place] = flat[type(value)](value)
        return values

    return flatten


def _flat(value: Any) -> Any:
    return _FLAT[type(value)](value)


def _itself(value: Any) -> Any:
    return value


def _flat_array(array: Any) -> list[Any]:
    kind = array.dtype
    return [ARRAY, kind if kind.names else kind.str, array.shape, array.tobytes()]


_FLAT: _Flat = _Flat(
    {
        np.ndarray: _flat_array,
        np.random.Generator: lambda value: _flat(GeneratorState.from_generator(value)),
        list: lambda value: [LIST, *[_FLAT[type(each)](each) for each in value]],
        dict: lambda value: [DICT, *value, *[_FLAT[type(each)](each) for each in value.values()]],
        deque: lambda value: [QUEUE, value.maxlen, *[_FLAT[type(each)](each) for each in value]],
    }
)


def _raised(flat: Any) -> Any:
    """Return the value that lists were made of."""
    if type(flat) is not list:
        return flat
    tag, *rest = flat
    if tag == RECORD:
        return _allowed_dataclass(*rest[0].split(":"))(*map(_raised, rest[1:]))
    if tag == ARRAY:
        kind, shape, data = rest
        return np.frombuffer(data, kind).reshape(shape).copy()
    if tag == LIST:
        return [_raised(each) for each in rest]
    if tag == QUEUE:
        return deque(map(_raised, rest[1:]), rest[0])
    n = len(rest) // 2
    return dict(zip(rest[:n], map(_raised, rest[n:]), strict=True))


def _allowed_dataclass(module: str, name: str) -> Any:
    """Return a dataclass of uwsim or rosbags; raises UnpicklingError for all else."""
    found = None
    if module.startswith(OWN_PACKAGES):
        found = getattr(importlib.import_module(module), name, None)
    if not _is_allowed(found):
        raise pickle.UnpicklingError(f"{module}.{name} has no place in them")
    return found


def _is_allowed(kind: object) -> bool:
    """Whether this is a dataclass of uwsim or rosbags."""
    return (
        isinstance(kind, type)
        and dataclasses.is_dataclass(kind)
        and kind.__module__.startswith(OWN_PACKAGES)
    )


class _Unpickler(pickle.Unpickler):
    """Makes numbers, arrays, messages and records, and calls nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        if (module, name) in ALLOWED:
            return super().find_class(module, name)
        return _allowed_dataclass(module, name)
