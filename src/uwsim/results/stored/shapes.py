"""Validation of values read from JSON against expected shapes.

A shape is a function of a value and its path in the document. It raises a `ResultError` that
states the found value and the expected one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import NoneType
from typing import Any

from ...errors import ResultError

Shape = Callable[[Any, str], None]
MAX_DEPTH = 12
"""The greatest depth of nested lists and objects."""
MAX_SHOWN = 60
"""The greatest number of characters of an invalid value in a message."""
_CELLS = {int, float, NoneType}


def expect(condition: bool, value: object, path: str, expected: str) -> None:
    """Raise ResultError with the value found and expected at a path, unless a condition holds."""
    if not condition:
        excerpt = repr(value)
        excerpt = excerpt if len(excerpt) <= MAX_SHOWN else f"{excerpt[: MAX_SHOWN - 3]}..."
        raise ResultError(f"{path} is {excerpt}; expected {expected}.")


def text(value: Any, path: str) -> None:
    """Check a string that can be encoded as UTF-8: it has no unpaired surrogate."""
    expect(isinstance(value, str) and _is_unicode(value), value, path, "text")


def _is_unicode(value: str) -> bool:
    try:
        value.encode()
    except UnicodeEncodeError:
        return False
    return True


def integer(value: Any, path: str) -> None:
    """Check an integer that is not negative."""
    fits = isinstance(value, int) and not isinstance(value, bool) and value >= 0
    expect(fits, value, path, "a whole number from 0")


def number(value: Any, path: str) -> None:
    """Check a finite number."""
    fits = isinstance(value, int | float) and not isinstance(value, bool)
    expect(fits and math.isfinite(value), value, path, "a finite number")


def any_value(value: Any, path: str) -> None:
    """Check a JSON value that is nested at most `MAX_DEPTH` deep."""
    layer = [value]
    for _ in range(MAX_DEPTH):
        inner_values = [node.values() if isinstance(node, Mapping) else node for node in layer]
        layer = [v for node in inner_values if not isinstance(node, _SCALARS) for v in node]
    expect(not layer, "...", path, f"lists and objects in each other up to {MAX_DEPTH} deep")


_SCALARS = (str, int, float, NoneType)


def cells(value: Any, path: str) -> None:
    """Check a list of numbers and nulls; this is fast, as the lists are long."""
    expect(isinstance(value, list), value, path, "a list")
    expect(set(map(type, value)) <= _CELLS, value, path, "numbers and nulls")


def null_or(shape: Shape) -> Shape:
    """Return the shape of a value that is null or has the shape."""

    def check(value: Any, path: str) -> None:
        if value is not None:
            shape(value, path)

    return check


def array(shape: Shape, *, n: int | None = None) -> Shape:
    """Return the shape of a list whose values all have the shape; of ``n`` values if it is set."""

    def check(value: Any, path: str) -> None:
        expect(isinstance(value, list), value, path, "a list")
        expect(n is None or len(value) == n, value, path, f"{n} values")
        for i, item in enumerate(value):
            shape(item, f"{path}[{i}]")

    return check


def items(*shapes: Shape) -> Shape:
    """Return the shape of a list with one value for each of the shapes, in order."""

    def check(value: Any, path: str) -> None:
        fits = isinstance(value, list) and len(value) == len(shapes)
        expect(fits, value, path, f"a list of {len(shapes)}")
        for i, (item, shape) in enumerate(zip(value, shapes, strict=True)):
            shape(item, f"{path}[{i}]")

    return check


def table(shape: Shape) -> Shape:
    """Return the shape of an object with any keys, whose values all have the shape."""

    def check(value: Any, path: str) -> None:
        expect(isinstance(value, dict), value, path, "an object")
        for key, item in value.items():
            text(key, path)
            shape(item, f"{path}.{key[:MAX_SHOWN]}")

    return check


def fields(keys: Mapping[str, Shape], optional_keys: Mapping[str, Shape] | None = None) -> Shape:
    """Return the shape of an object that has these keys; unknown keys may have any value."""
    shapes = {**keys, **(optional_keys or {})}

    def check(value: Any, path: str) -> None:
        expect(isinstance(value, dict), value, path, "an object")
        for name in keys:
            expect(name in value, sorted(value), path, f"{name!r} among its keys")
        for key, item in value.items():
            name = key[:MAX_SHOWN]
            shapes.get(key, any_value)(item, f"{path}.{name}" if path else name)

    return check
