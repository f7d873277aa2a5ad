"""Checks and copies of messages before they are published: each field has its defined type.

The definition is the message's dataclass, whose annotations are ROS's own: ``float``, ``str``,
``np.ndarray[..., np.dtype[np.float64]]``, ``list[...]`` and other messages.
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
_FITTING: dict[str, tuple[type, ...]] = {
    "float": (float, int, np.number, np.bool_),
    "int": (int, np.integer, np.bool_),
    "bool": (bool, int, np.bool_),
    "str": (str,),
}
_NUMBERS = frozenset((bool, int, float))
_PLAIN = _NUMBERS | {str}
_WORDS = {
    "float": "a number",
    "int": "a whole number",
    "bool": "True or False",
    "str": "text",
    "array": "an array of numbers",
    "list": "a list of what is defined there",
    "message": "a message",
}
MAX_LOOP_LENGTH = 32
"""Numbers that are looked at one by one."""
_ARRAY = re.compile(r"np\.ndarray\[.*np\.dtype\[np\.(\w+)\]\]")
_LIST = re.compile(r"list\[(.*)\]")


def find_invalid_field(message: object, of: str = "", *, converts: bool = True) -> str | None:
    """Report the first field of a message that does not fit its definition, or None.

    Lists and tuples given for arrays become arrays, or do not fit (``converts``). ``of`` is the
    path to a message in another, with a dot behind it.
    """
    return None if _is_plainly_fit(message) else _check_fields(message, of, converts)


def _check_fields(message: object, of: str, converts: bool) -> str | None:
    """Report as `find_invalid_field` does, field by field."""
    for name, kind, inner in _definition(cast(Hashable, message.__class__)):
        value = getattr(message, name)
        wrong: str | None = None
        if kind == "array" and not isinstance(value, np.ndarray):
            value = _array(value, inner) if converts else None
            if value is not None:
                object.__setattr__(message, name, value)  # of a frozen one, too
        if kind == "array":
            is_fit = value is not None and value.dtype.kind in "biuf"
        elif kind == "list":
            is_fit = isinstance(value, list | tuple)
            for i, item in enumerate(value if is_fit else ()):
                if inner == "str":
                    is_fit = is_fit and isinstance(item, str)
                elif wrong is None and (is_fit := is_fit and _is_message(item, inner)):
                    wrong = find_invalid_field(item, f"{of}{name}[{i}].", converts=converts)
        elif kind == "message":
            is_fit = _is_message(value, inner)
            wrong = find_invalid_field(value, f"{of}{name}.", converts=converts) if is_fit else None
        else:
            is_fit = isinstance(value, _FITTING[kind])
        if not is_fit:
            text = " ".join(repr(getattr(message, name)).split())
            text = text if len(text) <= 60 else text[:57] + "..."
            return f"{of}{name} is {text}, expected {_WORDS[kind]}"
        if wrong is not None:
            return wrong
    return None


def check_and_freeze(message: object) -> str | None:
    """Report as `find_invalid_field` does; make the arrays of a valid message read-only."""
    if _is_plainly_fit(message, freezes=True):
        return None
    wrong = _check_fields(message, "", converts=True)
    if wrong is None:
        freeze(message)
    return wrong


def _is_plainly_fit(message: object, *, freezes: bool = False) -> bool:
    """Whether each field has exactly its type, in one look; False for messages in lists and doubts.

    With ``freezes`` the arrays of one that has are read-only from now on.
    """
    parts = _parts(cast(Hashable, message.__class__))
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
    """Report the first number of a command that is not finite, or else beyond a limit.

    Args:
        message: the command.
        paths: of its fields, as ``twist.linear.x``; numbers, or arrays of them.
        limit: greatest size of one that is followed.

    Returns:
        What was found, and what was expected, with what becomes of it; None: all is well.
    """
    values = _values_at(tuple(paths))(message)
    for value in values if len(paths) > 1 else (values,):
        if isinstance(value, np.ndarray):
            is_usual = are_within(value, limit)
        else:
            is_usual = -limit <= value <= limit
        if not is_usual:
            return _odd_number(message, paths, limit)
    return None


def are_within(values: np.ndarray[Any, Any], limit: float) -> bool:
    """Whether no number of an array is NaN, or greater than a limit."""
    if values.size <= MAX_LOOP_LENGTH:  # numpy's functions take longer than those numbers
        return all(-limit <= value <= limit for value in values.ravel().tolist())
    return bool(np.abs(values).max() <= limit)


def _odd_number(message: object, paths: Sequence[str], limit: float) -> tuple[str, str] | None:
    """The same, where there is one."""
    beyond: tuple[str, str] | None = None
    for path in paths:
        value = operator.attrgetter(path)(message)
        numbers = value.ravel().tolist() if isinstance(value, np.ndarray) else [value]
        for index, number in enumerate(numbers):
            if -limit <= number <= limit:
                continue
            at = f"{path}[{index}]" if isinstance(value, np.ndarray) else path
            if not math.isfinite(number):
                return f"{at} is {number}", "a finite number; it is not followed"
            if beyond is None:
                most = f"{limit:g}"
                beyond = f"{at} is {number:g}", f"-{most} to {most}; the nearest is taken"
    return beyond


@functools.cache
def _values_at(paths: tuple[str, ...]) -> Callable[[object], Any]:
    """What reads the values at some paths; of one path, the value itself."""
    return operator.attrgetter(*paths)


def freeze(message: M) -> M:
    """Make every array inside a message read-only, and return it."""
    for name in _with_arrays(cast(Hashable, message.__class__)):
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
    """Return the same message with arrays, lists and messages of its own."""
    if hasattr(message, "__dict__"):
        own: M = object.__new__(message.__class__)
        vars(own).update(vars(message))
    else:
        own = copy.copy(message)
    for name in _names(cast(Hashable, message.__class__)):
        value = getattr(message, name)
        if value.__class__ not in _PLAIN:
            object.__setattr__(own, name, _copied_value(value))  # of a frozen one, too
    return own


def _copied_value(value: object) -> object:
    if isinstance(value, np.ndarray):
        return np.array(value)
    if isinstance(value, list | tuple):
        items = [_copied_value(item) for item in value]
        return items if isinstance(value, list) else tuple(items)
    return copy_message(value) if dataclasses.is_dataclass(value) else value


def size_of(value: object) -> int:
    """Return about how much memory a message takes [bytes]."""
    if isinstance(value, np.ndarray):
        return value.nbytes
    if isinstance(value, str):
        return len(value)
    if value.__class__ in _PLAIN:
        return sys.getsizeof(value)
    if isinstance(value, list | tuple):
        return sum(map(size_of, value))
    if dataclasses.is_dataclass(value):
        size = 0
        for name in _names(cast(Hashable, value.__class__)):
            part = getattr(value, name)
            size += sys.getsizeof(part) if part.__class__ in _NUMBERS else size_of(part)
        return size
    return sys.getsizeof(value)


@functools.cache
def _names(cls: Hashable) -> tuple[str, ...]:
    return tuple(field.name for field in dataclasses.fields(cast("Any", cls)))


@functools.cache
def _with_arrays(cls: Hashable) -> tuple[str, ...]:
    """Fields that are, or may hold, arrays; those of a message that none of its fields has not."""
    assert isinstance(cls, type)
    kinds = {name: kind for name, kind, _ in _definition(cls)}
    found = []
    for field in dataclasses.fields(cls):
        inner = _class_in(cls, str(field.type)) if kinds.get(field.name) == "message" else None
        is_plain = kinds.get(field.name) in _FITTING or str(field.type).startswith("ClassVar")
        if not is_plain and (inner is None or _with_arrays(cast(Hashable, inner))):
            found.append(field.name)
    return tuple(found)


class _Parts(NamedTuple):
    """What reads the fields of a message, and those of messages in it, by their kinds."""

    values: Callable[[object], tuple[Any, ...]]
    """Numbers, texts and messages."""
    types: tuple[type, ...]
    """The type of each of these, and of every list."""
    arrays: Callable[[object], tuple[Any, ...]]
    """Arrays of numbers."""
    texts: Callable[[object], tuple[Any, ...]]
    """Lists of texts."""
    lists: Callable[[object], tuple[Any, ...]]
    """Lists of messages."""


@functools.cache
def _parts(cls: Hashable) -> _Parts | None:
    """Return what reads the fields of a message class; None if the class of a part is unknown."""
    paths = _paths(cls)
    if paths is None:
        return None
    values = [path for path, kind, _ in paths if kind not in ("array", "texts")]
    types = tuple(type_ for _, kind, type_ in paths if kind not in ("array", "texts"))
    arrays, texts, lists = (
        [path for path, kind, _ in paths if kind == wanted] for wanted in ("array", "texts", "list")
    )
    return _Parts(_reader(values), types, _reader(arrays), _reader(texts), _reader(lists))


def _reader(paths: Sequence[str]) -> Callable[[object], tuple[Any, ...]]:
    """Return what reads the values at some paths."""
    if len(paths) > 1:
        return operator.attrgetter(*paths)
    if not paths:
        return lambda _: ()
    get = operator.attrgetter(*paths)
    return lambda message: (get(message),)


def _paths(cls: Hashable) -> list[tuple[str, str, type]] | None:
    """Path, kind and type of each field, and of those of messages in it; None of a part unknown.

    The kind is ``array``, ``texts`` or ``list`` (of messages), else empty.
    """
    assert isinstance(cls, type)
    found: list[tuple[str, str, type]] = []
    for name, kind, inner in _definition(cls):
        if kind in _FITTING:
            found.append((name, "", _FITTING[kind][0]))
        elif kind == "array":
            found.append((name, "array", np.ndarray))
        elif kind == "list":
            found.append((name, "texts" if inner == "str" else "list", list))
        else:
            declared = next(field.type for field in dataclasses.fields(cls) if field.name == name)
            part = _class_in(cls, str(declared))
            within = None if part is None else _paths(cast(Hashable, part))
            if part is None or within is None:
                return None
            found.append((name, "", part))
            found += [(f"{name}.{path}", of, type_) for path, of, type_ in within]
    return found


@functools.cache
def _definition(cls: Hashable) -> tuple[tuple[str, str, str], ...]:
    """Field, kind (a key of `_WORDS`), and what is in it.

    That is the dtype of an array, ``str`` or the message type of a list, the type of a message.
    """
    assert isinstance(cls, type)
    found = []
    for field in dataclasses.fields(cls):
        message = str(field.type)
        if array := _ARRAY.fullmatch(message):
            found.append((field.name, "array", array[1]))
        elif inner := _LIST.fullmatch(message):
            found.append((field.name, "list", _message_type(cls, inner[1])))
        elif message in _FITTING:
            found.append((field.name, message, ""))
        elif message.isidentifier():  # the name of another message
            found.append((field.name, "message", _message_type(cls, message)))
    return tuple(found)


def _message_type(cls: type, message: str) -> str:
    """ROS's name of a message that a definition mentions; ``str`` stays."""
    name = message.rpartition(".")[2]
    found = _class_in(cls, message)
    return str(getattr(found, "__msgtype__", name.replace("__", "/")))


def _class_in(cls: type, message: str) -> type | None:
    """The class of a message that a definition mentions; None if its module does not have it."""
    found = getattr(sys.modules[cls.__module__], message.rpartition(".")[2], None)
    return found if dataclasses.is_dataclass(found) and isinstance(found, type) else None


def _array(value: object, dtype: str) -> np.ndarray[Any, Any] | None:
    if not isinstance(value, list | tuple):
        return None
    try:
        return np.array(value, dtype=dtype)
    except (TypeError, ValueError, OverflowError):
        return None


def _is_message(value: object, type: str) -> bool:
    return getattr(value, "__msgtype__", None) == type and dataclasses.is_dataclass(value)
