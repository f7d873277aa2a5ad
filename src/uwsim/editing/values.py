"""Values that a program sets, read by the rules of a file: kind of value, limits, words."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable
from numbers import Integral
from typing import Any

from lxml import etree

from ..errors import BadSetting, short_repr
from ..schema import Diagnostics, Field, read, write_value

_NUMBER = re.compile(r" is '([-+0-9.e]+)';")
MAX_ITEMS = 10_000
"""The greatest number of values that are set together."""


def check_value(cls: type, field: Field, value: Any) -> Any:
    """Return a value as a file would give it to a field, such as a float for an integer.

    Args:
        cls: the class of the spec.
        field: the field, which has no specs in it.
        value: the value; sequences and arrays become tuples.

    Raises:
        BadSetting: the value is invalid; the error message states the expected one.
    """
    value = _plain_value(field, value)
    if value is None:
        if field.is_optional:
            return None
        raise BadSetting(f"{field.name} is None; expected {field.expected}.")
    if field.kind == "manual" or value == field.default:
        return _check_type(field, value)
    if field.is_repeated and field.xml.attribute:
        return _check_words(field, value)
    if not _has_kind(field, value):
        raise BadSetting(f"{field.name} is {short_repr(value)}; expected {_expected(field)}.")
    node = etree.Element("value")
    try:
        write_value(node, field, value)
    except (TypeError, ValueError, AttributeError) as error:
        raise BadSetting(
            f"{field.name} is {short_repr(value)}; expected {_expected(field)}."
        ) from error
    diagnostics = Diagnostics("")
    other_fields = {
        other.name: None
        for other in dataclasses.fields(cls)
        if other.init and other.name != field.name
    }
    new_spec = read(cls, node, diagnostics, known_fields=other_fields)
    messages = [diagnostic.message for diagnostic in diagnostics.to_list()]
    if new_spec is None or messages:
        message = "; ".join(messages) or f"expected {_expected(field)}"
        raise BadSetting(_name_in_message(field, _NUMBER.sub(r" is \1;", message)))
    return getattr(new_spec, field.name)


def _has_kind(field: Field, value: Any) -> bool:
    """Return whether a value may be of the kind of a field; its limits are not checked."""
    if isinstance(value, tuple):
        is_list = field.is_repeated or field.kind in ("triple", "numbers", "list")
        return is_list and all(isinstance(item, tuple) or _is_scalar(field, item) for item in value)
    is_word = field.kind == "triple" and value in field.words
    return is_word or (not field.is_repeated and _is_scalar(field, value))


def _is_scalar(field: Field, value: Any) -> bool:
    if field.kind in ("str", "word"):
        return isinstance(value, str)
    if field.kind == "bool":
        return isinstance(value, bool)
    kinds = (int,) if field.kind == "int" else (int, float)
    return isinstance(value, kinds) and not isinstance(value, bool)


def _name_in_message(field: Field, message: str) -> str:
    """Return the message of a reader with the name of the field instead of that of its element."""
    label, text = f"<{field.label}>", message.rstrip(".")
    if text.startswith(label):
        return f"{field.name}{text.removeprefix(label)}."
    return f"{field.name}: {text}."


def _expected(field: Field) -> str:
    """Return the expected value in words: of a triple or a list the count, too."""
    if field.kind == "triple":
        return f"three numbers, as (0, 0, 1), each {field.expected}"
    return f"values, each {field.expected}" if field.is_repeated else field.expected


def _check_type(field: Field, value: Any) -> Any:
    """Return the default for an equal value; check the class of a spec that a file selects."""
    if field.kind != "manual":
        return field.default
    if not isinstance(value, field.type):
        kind = getattr(field.type, "__name__", "value")
        raise BadSetting(f"{field.name} is {short_repr(value)}; expected a {kind}.")
    return value


def _check_words(field: Field, value: Any) -> tuple[str, ...]:
    words = tuple(value.split()) if isinstance(value, str) else value
    if not isinstance(words, tuple) or not all(isinstance(word, str) for word in words):
        raise BadSetting(f"{field.name} is {short_repr(value)}; expected texts, as ('a', 'b').")
    if invalid_words := [word for word in words if not word or word.split() != [word]]:
        raise BadSetting(
            f"{field.name} contains {invalid_words[0]!r}; expected texts without blanks."
        )
    return words


def _plain_value(field: Field, value: Any) -> Any:
    """Return arrays and sequences as tuples, and numbers of other libraries as Python's."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, Iterable) and not isinstance(value, str | tuple | dict | set):
        value = tuple(value)
    if isinstance(value, tuple):
        if len(value) > MAX_ITEMS:
            raise BadSetting(f"{field.name} has {len(value)} values; expected {MAX_ITEMS} at most.")
        return tuple(_plain_value(field, item) for item in value)
    is_number = isinstance(value, int | float | Integral) and not isinstance(value, bool)
    if is_number and field.kind in ("float", "triple", "numbers", "list"):
        try:
            return float(value)
        except OverflowError:
            raise BadSetting(
                f"{field.name} is {short_repr(value)}; expected {field.expected}."
            ) from None
    if field.kind == "int" and isinstance(value, float) and value.is_integer():
        return int(value)
    if field.kind == "bool" and isinstance(value, int) and value in (0, 1):
        return bool(value)
    return value
