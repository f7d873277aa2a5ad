"""Validation of values read from JSON against expected shapes.

A shape is a function of a value and of where it stands; it raises `ResultError` that says what was
found there, and what was expected.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import NoneType
from typing import Any

from ...errors import ResultError

Shape = Callable[[Any, str], None]
MAX_DEPTH = 12
"""Lists and objects are nested no deeper than this."""
MAX_SHOWN = 60
"""So many letters of a wrong value are shown."""
_CELLS = {int, float, NoneType}


def expect(truth: bool, value: object, at: str, what: str) -> None:
    """Raise ResultError unless it is true: ``value`` was found ``at`` a place, not ``what``."""
    if not truth:
        shown = repr(value)
        shown = shown if len(shown) <= MAX_SHOWN else f"{shown[: MAX_SHOWN - 3]}..."
        raise ResultError(f"{at} is {shown}; expected {what}.")


def text(value: Any, at: str) -> None:
    """A string that can be written: without half of a surrogate pair."""
    expect(isinstance(value, str) and _is_unicode(value), value, at, "text")


def _is_unicode(value: str) -> bool:
    try:
        value.encode()
    except UnicodeEncodeError:
        return False
    return True


def whole(value: Any, at: str) -> None:
    """A whole number from 0."""
    fits = isinstance(value, int) and not isinstance(value, bool) and value >= 0
    expect(fits, value, at, "a whole number from 0")


def number(value: Any, at: str) -> None:
    """A finite number."""
    fits = isinstance(value, int | float) and not isinstance(value, bool)
    expect(fits and math.isfinite(value), value, at, "a finite number")


def anything(value: Any, at: str) -> None:
    """Any value of JSON that is not nested too deep."""
    layer = [value]
    for _ in range(MAX_DEPTH):
        inner = [each.values() if isinstance(each, Mapping) else each for each in layer]
        layer = [v for each in inner if not isinstance(each, _SCALARS) for v in each]
    expect(not layer, "...", at, f"lists and objects in each other up to {MAX_DEPTH} deep")


_SCALARS = (str, int, float, NoneType)


def cells(value: Any, at: str) -> None:
    """A list of numbers and nulls; quick, for there are many."""
    expect(isinstance(value, list), value, at, "a list")
    expect(set(map(type, value)) <= _CELLS, value, at, "numbers and nulls")


def maybe(shape: Shape) -> Shape:
    """Null, or of the shape."""

    def check(value: Any, at: str) -> None:
        if value is not None:
            shape(value, at)

    return check


def each(shape: Shape, *, n: int | None = None) -> Shape:
    """A list, every item of the shape; of ``n`` items."""

    def check(value: Any, at: str) -> None:
        expect(isinstance(value, list), value, at, "a list")
        expect(n is None or len(value) == n, value, at, f"{n} values")
        for i, item in enumerate(value):
            shape(item, f"{at}[{i}]")

    return check


def items(*shapes: Shape) -> Shape:
    """A list of one item for each shape."""

    def check(value: Any, at: str) -> None:
        fits = isinstance(value, list) and len(value) == len(shapes)
        expect(fits, value, at, f"a list of {len(shapes)}")
        for i, (item, shape) in enumerate(zip(value, shapes, strict=True)):
            shape(item, f"{at}[{i}]")

    return check


def table(shape: Shape) -> Shape:
    """An object with any keys, every value of the shape."""

    def check(value: Any, at: str) -> None:
        expect(isinstance(value, dict), value, at, "an object")
        for key, item in value.items():
            text(key, at)
            shape(item, f"{at}.{key[:MAX_SHOWN]}")

    return check


def fields(required: Mapping[str, Shape], optional: Mapping[str, Shape] | None = None) -> Shape:
    """An object with these keys; what has others is not looked into, but for its depth."""
    known = {**required, **(optional or {})}

    def check(value: Any, at: str) -> None:
        expect(isinstance(value, dict), value, at, "an object")
        for name in required:
            expect(name in value, sorted(value), at, f"{name!r} among its keys")
        for key, item in value.items():
            known.get(key, anything)(item, f"{at}.{key[:MAX_SHOWN]}" if at else key[:MAX_SHOWN])

    return check
