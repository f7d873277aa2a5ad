"""The functions and methods that expressions may call: functions of Python without side effects."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

from .value import MAX_ITEMS, MAX_LENGTH, DistinctItems, ExpressionError, Value, to_text


def power(base: Value, exponent: Value) -> int | float:
    """Return ``base ** exponent``, as an integer for small integers."""
    for number in (base, exponent):
        if not isinstance(number, int | float):
            raise ExpressionError(f"{to_text(number)[:40]!r} is not a number")
    assert isinstance(base, int | float)
    assert isinstance(exponent, int | float)
    if isinstance(base, int) and isinstance(exponent, int) and abs(base) <= 64 >= exponent >= 0:
        return int(base**exponent)
    result: float | complex = float(base) ** float(exponent)
    if isinstance(result, complex):
        raise ExpressionError(f"{base}**{exponent} is no real number")
    return result


def integer_range(*bounds: Any) -> list[int]:
    """Return the integers of a range."""
    values = range(*bounds)
    if len(values) > MAX_ITEMS:
        raise ExpressionError(f"a range of more than {MAX_ITEMS} numbers")
    return list(values)


def zip_lists(*lists: Any) -> list[list[Any]]:
    """Return a list of the first items of all lists, a list of the second items, and so on."""
    return [list(items) for items in zip(*lists, strict=False)]


def enumerate_items(items: Any, start: int = 0) -> list[list[Any]]:
    """Return a list ``[number, item]`` for each item."""
    return [[number, item] for number, item in enumerate(items, start)]


def format_pattern(pattern: str, values: Any) -> str:
    """Return ``pattern % values``, with fields of at most 99 letters."""
    if any(int(width) > 99 for width in FIELD_WIDTH.findall(pattern)) or "*" in pattern:
        raise ExpressionError(f"{pattern[:40]!r}: a field of more than 99 letters")
    return pattern % (tuple(values) if isinstance(values, list) else values)


def repeat(sequence: Any, times: Any) -> Any:
    """Return a text or a list, repeated a number of times."""
    if isinstance(sequence, int):
        sequence, times = times, sequence
    if not isinstance(times, int) or isinstance(times, bool):
        raise ExpressionError(f"{to_text(times)[:40]} is no number of repetitions")
    limit = MAX_LENGTH if isinstance(sequence, str) else MAX_ITEMS
    if len(sequence) * times > limit:
        raise ExpressionError(f"a text or a list longer than {limit}")
    return sequence * times


def tokenize(text: Any, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    """Split a text at each character of ``sep``."""
    parts = re.split(f"[{re.escape(sep)}]", str(text)) if sep else [str(text)]
    return [part for part in parts if part or not skip_empty]


def dotify(entries: Any) -> Any:
    """Return a dictionary unchanged, as entries can always be written with a dot."""
    if not isinstance(entries, dict):
        raise ExpressionError(f"{to_text(entries)[:40]} is no dictionary")
    return entries


FIELD_WIDTH = re.compile(r"\d+")
"""A number in a pattern, such as the width of a field."""

FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan")},
    **{name: getattr(math, name) for name in ("atan2", "sqrt", "exp", "log", "log10", "hypot")},
    **{name: getattr(math, name) for name in ("floor", "ceil", "radians", "degrees", "fabs")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh", "copysign", "fmod")},
    **{name: getattr(math, name) for name in ("log2", "log1p", "expm1", "trunc", "isfinite")},
    **{name: getattr(math, name) for name in ("asinh", "acosh", "atanh", "isnan", "isinf")},
    **{"abs": abs, "min": min, "max": max, "round": round, "sum": sum, "pow": power},
    **{"int": int, "float": float, "bool": bool, "str": str, "len": len, "range": integer_range},
    **{"list": list, "tuple": tuple, "dict": dict, "set": DistinctItems, "sorted": sorted},
    **{"any": any, "all": all, "zip": zip_lists, "enumerate": enumerate_items},
    **{"xacro.tokenize": tokenize, "xacro.dotify": dotify, "dotify": dotify},
}
"""The functions by name; functions of ``math`` can also be written ``math.name``."""

METHODS: dict[type, tuple[str, ...]] = {
    str: ("lower", "upper", "strip", "split", "startswith", "endswith", "replace", "join", "title"),
    list: ("index", "count"),
    dict: ("get", "keys", "values", "items"),
}
"""The methods of each type of value."""


def method(value: Value, name: str) -> Callable[..., Any] | None:
    """Return a method of a value by its name; None if expressions may not call it."""
    names = METHODS.get(type(value), ())
    return getattr(value, name) if name in names else None
