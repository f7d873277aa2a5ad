"""Checks of messages against their definitions, and copies and sizes of messages.

The definition is the dataclass of the message. Its annotations correspond to ROS types:
``float``, ``str``, ``np.ndarray[..., np.dtype[np.float64]]``, ``list[...]`` and other messages.
"""

from __future__ import annotations

import copy
import dataclasses
import functools
import math
import operator
import re
import sys
from collections.abc import Callable, Hashable, Sequence
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np

M = TypeVar("M")
_FIELD_TYPES: dict[str, tuple[type, ...]] = {
    "float": (float, int, np.number, np.bool_),
    "int": (int, np.integer, np.bool_),
    "bool": (bool, int, np.bool_),
    "str": (str,),
}
_NUMBER_TYPES = frozenset((bool, int, float))
_SCALAR_TYPES = _NUMBER_TYPES | {str}
_EXPECTED_TEXTS = {
    "float": "a number",
    "int": "a whole number",
    "bool": "True or False",
    "str": "text",
    "array": "an array of numbers",
    "list": "a list of the defined type",
    "message": "a message",
}
MAX_LOOP_LENGTH = 32
"""The greatest size of an array that is checked by a Python loop; numpy checks larger arrays."""
_ARRAY = re.compile(r"np\.ndarray\[.*np\.dtype\[np\.(\w+)\]\]")
_LIST = re.compile(r"list\[(.*)\]")


def find_invalid_field(message: object, prefix: str = "", *, converts: bool = True) -> str | None:
    """Describe the first field of a message that violates its definition; None if there is none.

    Args:
        message: the message.
        prefix: the path of the message in an outer message, with a dot at its end.
        converts: True if lists and tuples in fields of arrays are converted to arrays; False if
            they are invalid.
    """
    return None if _is_valid_quickly(message) else _check_fields(message, prefix, converts)


def _check_fields(message: object, prefix: str, converts: bool) -> str | None:
    for name, kind, element_type in _definition(cast(Hashable, message.__class__)):
        value = getattr(message, name)
        error: str | None = None
        if kind == "array" and not isinstance(value, np.ndarray):
            value = _array(value, element_type) if converts else None
            if value is not None:
                object.__setattr__(message, name, value)  # also in a frozen dataclass
        if kind == "array":
            is_valid = value is not None and value.dtype.kind in "biuf"
        elif kind == "list":
            is_valid = isinstance(value, list | tuple)
            for i, item in enumerate(value if is_valid else ()):
                if element_type == "str":
                    is_valid = is_valid and isinstance(item, str)
                elif error is None and (is_valid := is_valid and _is_message(item, element_type)):
                    error = find_invalid_field(item, f"{prefix}{name}[{i}].", converts=converts)
        elif kind == "message":
            is_valid = _is_message(value, element_type)
            if is_valid:
                error = find_invalid_field(value, f"{prefix}{name}.", converts=converts)
        else:
            is_valid = isinstance(value, _FIELD_TYPES[kind])
        if not is_valid:
            text = " ".join(repr(getattr(message, name)).split())
            text = text if len(text) <= 60 else text[:57] + "..."
            return f"{prefix}{name} is {text}, expected {_EXPECTED_TEXTS[kind]}"
        if error is not None:
            return error
    return None


def check_and_freeze(message: object) -> str | None:
    """Check a message as `find_invalid_field` does; make arrays of a valid message read-only."""
    if _is_valid_quickly(message, freezes=True):
        return None
    error = _check_fields(message, "", converts=True)
    if error is None:
        freeze(message)
    return error


def _is_valid_quickly(message: object, *, freezes: bool = False) -> bool:
    """Return True only if each field has exactly its type; False if lists contain messages.

    With ``freezes`` the arrays of a valid message become read-only.
    """
    parts = _make_getters(cast(Hashable, message.__class__))
    if parts is None:
        return False
    try:
        if tuple(map(type, parts.values(message))) != parts.types or any(parts.lists(message)):
            return False
        arrays, texts = parts.arrays(message), parts.texts(message)
    except AttributeError:
        return False
    for array in arrays:
        if array.__class__ is not np.ndarray or array.dtype.kind not in "biuf":
            return False
    for items in texts:
        if items.__class__ is not list or any(item.__class__ is not str for item in items):
            return False
    if freezes:
        for array in arrays:
            array.setflags(write=False)
    return True


def find_invalid_number(
    message: object, paths: Sequence[str], limit: float
) -> tuple[str, str] | None:
    """Describe the first number of a command that is not finite, or else exceeds a limit.

    Args:
        message: the command.
        paths: the paths of the fields to check, such as ``twist.linear.x``; numbers or arrays.
        limit: the greatest valid absolute value.

    Returns:
        The text of the invalid number, and of the expected number with the consequence; None if all
        numbers are valid.
    """
    values = _value_getter(tuple(paths))(message)
    for value in values if len(paths) > 1 else (values,):
        if isinstance(value, np.ndarray):
            is_within = are_within(value, limit)
        else:
            is_within = -limit <= value <= limit
        if not is_within:
            return _invalid_number(message, paths, limit)
    return None


def are_within(values: np.ndarray[Any, Any], limit: float) -> bool:
    """Return whether no number of an array is NaN or beyond a limit."""
    if values.size <= MAX_LOOP_LENGTH:  # for few numbers, a loop is faster than numpy
        return all(-limit <= value <= limit for value in values.ravel().tolist())
    return bool(np.abs(values).max() <= limit)


def _invalid_number(message: object, paths: Sequence[str], limit: float) -> tuple[str, str] | None:
    excess: tuple[str, str] | None = None
    for path in paths:
        value = operator.attrgetter(path)(message)
        numbers = value.ravel().tolist() if isinstance(value, np.ndarray) else [value]
        for index, number in enumerate(numbers):
            if -limit <= number <= limit:
                continue
            place = f"{path}[{index}]" if isinstance(value, np.ndarray) else path
            if not math.isfinite(number):
                return f"{place} is {number}", "a finite number; it is not followed"
            if excess is None:
                bound = f"{limit:g}"
                excess = f"{place} is {number:g}", f"-{bound} to {bound}; the nearest is taken"
    return excess


@functools.cache
def _value_getter(paths: tuple[str, ...]) -> Callable[[object], Any]:
    return operator.attrgetter(*paths)


def freeze(message: M) -> M:
    """Make every array inside a message read-only, and return it."""
    for name in _array_fields(cast(Hashable, message.__class__)):
        _freeze_value(getattr(message, name))
    return message


def _freeze_value(value: object) -> None:
    if isinstance(value, np.ndarray):
        value.flags.writeable = False
    elif dataclasses.is_dataclass(value):
        freeze(value)
    elif isinstance(value, list):
        for item in value:
            _freeze_value(item)


def copy_message(message: M) -> M:
    """Return a copy of a message that shares no array, list or message with it."""
    if hasattr(message, "__dict__"):
        duplicate: M = object.__new__(message.__class__)
        vars(duplicate).update(vars(message))
    else:
        duplicate = copy.copy(message)
    for name in _field_names(cast(Hashable, message.__class__)):
        value = getattr(message, name)
        if value.__class__ not in _SCALAR_TYPES:
            object.__setattr__(duplicate, name, _copy_value(value))  # also in a frozen dataclass
    return duplicate


def _copy_value(value: object) -> object:
    if isinstance(value, np.ndarray):
        return np.array(value)
    if isinstance(value, list | tuple):
        items = [_copy_value(item) for item in value]
        return items if isinstance(value, list) else tuple(items)
    return copy_message(value) if dataclasses.is_dataclass(value) else value


def size_of(value: object) -> int:
    """Return an estimate of the memory of a message [bytes]."""
    if isinstance(value, np.ndarray):
        return value.nbytes
    if isinstance(value, str):
        return len(value)
    if value.__class__ in _SCALAR_TYPES:
        return sys.getsizeof(value)
    if isinstance(value, list | tuple):
        return sum(map(size_of, value))
    if dataclasses.is_dataclass(value):
        size = 0
        for name in _field_names(cast(Hashable, value.__class__)):
            part = getattr(value, name)
            size += sys.getsizeof(part) if part.__class__ in _NUMBER_TYPES else size_of(part)
        return size
    return sys.getsizeof(value)


@functools.cache
def _field_names(cls: Hashable) -> tuple[str, ...]:
    return tuple(field.name for field in dataclasses.fields(cast("Any", cls)))


@functools.cache
def _array_fields(cls: Hashable) -> tuple[str, ...]:
    """Return the names of the fields that are, or may contain, arrays."""
    assert isinstance(cls, type)
    kinds = {name: kind for name, kind, _ in _definition(cls)}
    names = []
    for field in dataclasses.fields(cls):
        part_class = _class_in(cls, str(field.type)) if kinds.get(field.name) == "message" else None
        is_plain = kinds.get(field.name) in _FIELD_TYPES or str(field.type).startswith("ClassVar")
        if not is_plain and (part_class is None or _array_fields(cast(Hashable, part_class))):
            names.append(field.name)
    return tuple(names)


class _Getters(NamedTuple):
    """Functions that read the fields of a message and of the messages in it, by kind."""

    values: Callable[[object], tuple[Any, ...]]
    """The getter of numbers, texts, messages and lists of messages."""
    types: tuple[type, ...]
    """The types of these values."""
    arrays: Callable[[object], tuple[Any, ...]]
    """The getter of arrays of numbers."""
    texts: Callable[[object], tuple[Any, ...]]
    """The getter of lists of texts."""
    lists: Callable[[object], tuple[Any, ...]]
    """The getter of lists of messages."""


@functools.cache
def _make_getters(cls: Hashable) -> _Getters | None:
    """Return the getters of a message class; None if the class of a message in it is unknown."""
    paths = _paths(cls)
    if paths is None:
        return None
    values = [path for path, kind, _ in paths if kind not in ("array", "texts")]
    types = tuple(type_ for _, kind, type_ in paths if kind not in ("array", "texts"))
    arrays, texts, lists = (
        [path for path, kind, _ in paths if kind == group] for group in ("array", "texts", "list")
    )
    return _Getters(_getter(values), types, _getter(arrays), _getter(texts), _getter(lists))


def _getter(paths: Sequence[str]) -> Callable[[object], tuple[Any, ...]]:
    """Return a function that reads the values at some paths as a tuple."""
    if len(paths) > 1:
        return operator.attrgetter(*paths)
    if not paths:
        return lambda _: ()
    get = operator.attrgetter(*paths)
    return lambda message: (get(message),)


def _paths(cls: Hashable) -> list[tuple[str, str, type]] | None:
    """Return path, kind and type of each field, also of messages in it; None if one is unknown.

    The kind is ``array``, ``texts`` or ``list`` (of messages), else empty.
    """
    assert isinstance(cls, type)
    paths: list[tuple[str, str, type]] = []
    for name, kind, element_type in _definition(cls):
        if kind in _FIELD_TYPES:
            paths.append((name, "", _FIELD_TYPES[kind][0]))
        elif kind == "array":
            paths.append((name, "array", np.ndarray))
        elif kind == "list":
            paths.append((name, "texts" if element_type == "str" else "list", list))
        else:
            annotation = next(field.type for field in dataclasses.fields(cls) if field.name == name)
            part_class = _class_in(cls, str(annotation))
            part_paths = None if part_class is None else _paths(cast(Hashable, part_class))
            if part_class is None or part_paths is None:
                return None
            paths.append((name, "", part_class))
            paths += [(f"{name}.{path}", part_kind, type_) for path, part_kind, type_ in part_paths]
    return paths


@functools.cache
def _definition(cls: Hashable) -> tuple[tuple[str, str, str], ...]:
    """Return the name, kind (a key of `_EXPECTED_TEXTS`) and content of each field.

    The content is the dtype of an array, ``str`` or the message type of a list, or the type of a
    message.
    """
    assert isinstance(cls, type)
    definition = []
    for field in dataclasses.fields(cls):
        annotation = str(field.type)
        if array_match := _ARRAY.fullmatch(annotation):
            definition.append((field.name, "array", array_match[1]))
        elif element_match := _LIST.fullmatch(annotation):
            definition.append((field.name, "list", _message_type(cls, element_match[1])))
        elif annotation in _FIELD_TYPES:
            definition.append((field.name, annotation, ""))
        elif annotation.isidentifier():  # the name of another message
            definition.append((field.name, "message", _message_type(cls, annotation)))
    return tuple(definition)


def _message_type(cls: type, annotation: str) -> str:
    """Return the ROS type of the message class in an annotation; ``str`` for ``str``."""
    name = annotation.rpartition(".")[2]
    message_class = _class_in(cls, annotation)
    return str(getattr(message_class, "__msgtype__", name.replace("__", "/")))


def _class_in(cls: type, annotation: str) -> type | None:
    """Return the class of a message in an annotation; None if its module does not define it."""
    value = getattr(sys.modules[cls.__module__], annotation.rpartition(".")[2], None)
    return value if dataclasses.is_dataclass(value) and isinstance(value, type) else None


def _array(value: object, dtype: str) -> np.ndarray[Any, Any] | None:
    if not isinstance(value, list | tuple):
        return None
    try:
        return np.array(value, dtype=dtype)
    except (TypeError, ValueError, OverflowError):
        return None


def _is_message(value: object, type: str) -> bool:
    return getattr(value, "__msgtype__", None) == type and dataclasses.is_dataclass(value)
