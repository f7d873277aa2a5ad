"""Records: dataclasses that hold the state of a simulation and of its parts.

A *part* is an object of a running scene, such as a sensor. It has its whole state in one record,
``state``, and sets no other attribute after its creation. Records are nested as the parts are; the
outermost record is the state of a simulation. The records of a running simulation refer to live
objects: arrays that compiled code writes, random generators, the engine's memory. `copy_record`
returns a copy that contains only values, and `assign` writes such values back to the live objects.

A record is a dataclass with slots. Its fields contain numbers, texts, tuples and frozen
dataclasses, which are replaced, never changed; arrays, lists, dictionaries and queues of these;
generators; `ExternalValue` objects; and records, alone or in lists and dictionaries.
"""

from __future__ import annotations

import abc
import dataclasses
from collections import deque
from collections.abc import Callable, Collection, Mapping
from operator import attrgetter
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from ..errors import UwsimError

R = TypeVar("R", bound="Record")


class Record:
    """The base of all records: ``@dataclass(slots=True) class GpsState(Record)``."""

    __slots__: tuple[str, ...] = ()


@dataclasses.dataclass(slots=True)
class NoState(Record):
    """The record of a part without a state."""


@dataclasses.dataclass(slots=True)
class RandomState(Record):
    """The record of a part whose only state is its random generator."""

    rng: np.random.Generator
    """The generator from which the part draws."""


class Item(Record):
    """The base of records that are elements of queues and tables, and not the state of a part.

    `assign` does not write into items: it replaces the whole queue or table.
    """

    __slots__ = ()


class ExternalValue(abc.ABC):
    """A value that is not stored in a Python object, such as a value in the engine's memory."""

    @abc.abstractmethod
    def value(self) -> object:
        """Return a copy of the present value."""

    @abc.abstractmethod
    def set(self, value: object) -> None:
        """Set the value; raise UwsimError if it was copied from another part."""


class Part(Protocol):
    """A part of a running scene."""

    @property
    def state(self) -> Record:
        """The state of the part."""


P = TypeVar("P", bound=Part)


class LazyPart(ExternalValue, Generic[P]):
    """A part that is created, with its record, when it is used for the first time.

    Args:
        make: a function that creates the part.
    """

    def __init__(self, make: Callable[[], P]) -> None:
        self._make = make
        self.part: P | None = None
        """The part; None before its creation."""

    def get_or_make(self) -> P:
        """Return the part; create it if it does not exist."""
        if self.part is None:
            self.part = self._make()
        return self.part

    def value(self) -> Record | None:
        """Return the record of the part; None before its creation."""
        return None if self.part is None else copy_record(self.part.state)

    def set(self, value: object) -> None:
        """Set the record of the part; create or remove the part as the record requires."""
        if value is None:
            self.part = None
            return
        assign(self.get_or_make().state, _require_type(value, Record))


@dataclasses.dataclass(slots=True)
class GeneratorState(Item):
    """The state of a random generator."""

    words: bytes
    """The counter, key and buffer: little-endian words of 64 bits."""
    position: int
    """The number of words drawn from the buffer."""
    half_word: int | None
    """The unused half of a word, if any."""

    @staticmethod
    def from_generator(generator: np.random.Generator) -> GeneratorState:
        """Read the state of a generator of `uwsim.base.rng.stream`."""
        state: Any = generator.bit_generator.state
        counter, key = state["state"].values()
        words = counter.tobytes() + key.tobytes() + state["buffer"].tobytes()
        half = state["uinteger"] if state["has_uint32"] else None
        return GeneratorState(words, state["buffer_pos"], half)

    def set(self, generator: np.random.Generator) -> None:
        """Set the state of a generator."""
        words = np.frombuffer(self.words, np.uint64)
        generator.bit_generator.state = {
            "bit_generator": "Philox",
            "state": {"counter": words[:4], "key": words[4:6]},
            "buffer": words[6:],
            "buffer_pos": self.position,
            "has_uint32": int(self.half_word is not None),
            "uinteger": self.half_word or 0,
        }


def copy_value(value: Any) -> Any:
    """Return a copy that shares no mutable object with the value."""
    return _COPIERS[type(value)](value)


def copy_record(record: R) -> R:
    """Return a copy of a record that contains only values, no live objects."""
    copy: R = _COPIERS[type(record)](record)
    return copy


def changing_fields(kind: type) -> tuple[int, ...]:
    """Return the indices of the fields of a dataclass whose type is not only a number or text."""
    return tuple(
        index
        for index, field in enumerate(dataclasses.fields(kind))
        if not _SCALAR_TYPES.issuperset(str(field.type).split(" | "))
    )


def field_values(record: object) -> tuple[Any, ...]:
    """Return the values of the fields of a dataclass with slots, not copied."""
    values: tuple[Any, ...] = _FIELD_GETTERS[type(record)](record)
    return values


class _FieldGetters(dict[type, Callable[[Any], Any]]):
    """The functions that return the values of the fields, by the type of dataclass."""

    def __missing__(self, record_type: type) -> Callable[[Any], Any]:
        names = [field.name for field in dataclasses.fields(record_type)]
        self[record_type] = read = attrgetter(*names) if names else lambda record: ()
        if len(names) == 1:
            self[record_type] = lambda record: (read(record),)
        return self[record_type]


class _Copiers(dict[type, Callable[[Any], Any]]):
    """The functions that copy a value, by its type."""

    def __missing__(self, value_type: type) -> Callable[[Any], Any]:
        self[value_type] = _return_unchanged
        if issubclass(value_type, Record):
            self[value_type] = _record_copier(value_type)
        elif issubclass(value_type, ExternalValue):
            self[value_type] = value_type.value
        return self[value_type]


def _record_copier(kind: type[Any]) -> Callable[[Any], Any]:
    """Return the function that copies records of a class; it copies only `changing_fields`."""
    fields, indices, copiers = _FIELD_GETTERS[kind], changing_fields(kind), _COPIERS
    if not indices:
        return lambda record: kind(*fields(record))

    def copy(record: Any) -> Any:
        values = [*fields(record)]
        for index in indices:
            value = values[index]
            values[index] = copiers[type(value)](value)
        return kind(*values)

    return copy


def _return_unchanged(value: Any) -> Any:
    return value


def _copy_array(value: Any) -> Any:
    return value.copy() if value.flags.writeable else value


_SCALAR_TYPES = {"int", "float", "bool", "str", "bytes", "None"}
_FIELD_GETTERS = _FieldGetters()
_COPIERS: _Copiers = _Copiers(
    {
        NoState: _return_unchanged,
        np.ndarray: _copy_array,
        np.random.Generator: GeneratorState.from_generator,
        list: lambda values: [_COPIERS[type(value)](value) for value in values],
        dict: lambda values: {key: _COPIERS[type(value)](value) for key, value in values.items()},
        deque: lambda values: deque(map(copy_value, values), values.maxlen),
    }
)


def assign(record: Record, values: Record) -> None:
    """Write the values of a copied record into the record of a running part.

    Raises:
        UwsimError: the values were copied from another part.
    """
    if type(record) is not type(values):
        raise wrong_scene_error()
    assign_fields(record, dict(zip(values.__slots__, field_values(values), strict=True)))


def copy_fields(record: Record, names: Collection[str]) -> dict[str, Any]:
    """Return the values of some fields of a record, by name."""
    return {name: copy_value(getattr(record, name)) for name in names}


def assign_fields(record: Record, values: Mapping[str, Any]) -> None:
    """Write the copied values of some fields into the record of a running part.

    Raises:
        UwsimError: the values were copied from another part.
    """
    for name, new_value in values.items():
        if not _assign_in_place(getattr(record, name), new_value):
            setattr(record, name, copy_value(new_value))


def _assign_in_place(old_value: Any, new_value: Any) -> bool:
    """Write a value into a live object; return False if the field must be set instead."""
    if _is_part_record(old_value):
        assign(old_value, new_value)
    elif isinstance(old_value, np.random.Generator):
        _require_type(new_value, GeneratorState).set(old_value)
    elif isinstance(old_value, ExternalValue):
        old_value.set(new_value)
    elif isinstance(old_value, np.ndarray) and old_value.flags.writeable:
        if not isinstance(new_value, np.ndarray) or (new_value.shape, new_value.dtype) != (
            old_value.shape,
            old_value.dtype,
        ):
            return False
        old_value[...] = new_value
    elif isinstance(old_value, dict) and any(map(_is_part_record, old_value.values())):
        if list(_require_type(new_value, dict)) != list(old_value):
            raise wrong_scene_error()
        for key, part in old_value.items():
            assign(part, new_value[key])
    elif isinstance(old_value, list) and any(map(_is_part_record, old_value)):
        if len(_require_type(new_value, list)) != len(old_value):
            raise wrong_scene_error()
        for part, values in zip(old_value, new_value, strict=True):
            assign(part, values)
    else:
        return False
    return True


def _is_part_record(value: object) -> bool:
    """Return whether a value is the record of a part."""
    return isinstance(value, Record) and not isinstance(value, Item)


def are_equal(value: Any, other: Any) -> bool:
    """Return whether two copied values are equal to the bit; NaN equals NaN."""
    if type(value) is not type(other):
        return False
    if isinstance(value, np.ndarray):
        has_same_type = (value.shape, value.dtype) == (other.shape, other.dtype)
        return has_same_type and value.tobytes() == other.tobytes()
    if isinstance(value, Record):
        return all(are_equal(getattr(value, n), getattr(other, n)) for n in value.__slots__)
    if dataclasses.is_dataclass(value):
        fields = [field.name for field in dataclasses.fields(value) if field.compare]
        return all(are_equal(getattr(value, name), getattr(other, name)) for name in fields)
    if isinstance(value, dict):
        return list(value) == list(other) and all(are_equal(value[k], other[k]) for k in value)
    if isinstance(value, list | tuple | deque):
        return len(value) == len(other) and all(map(are_equal, value, other))
    return bool(value == other) or (value != value and other != other)


def wrong_scene_error() -> UwsimError:
    """Return the error of a state that belongs to another scene."""
    return UwsimError("The saved simulation is not of this scene.")


def _require_type(value: Any, kind: type) -> Any:
    if not isinstance(value, kind):
        raise wrong_scene_error()
    return value
