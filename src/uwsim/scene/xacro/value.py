"""Values of expressions: numbers, truth values, texts, lists and dictionaries, within limits."""

from __future__ import annotations

from collections.abc import ItemsView, KeysView, ValuesView
from typing import Any

from ...errors import UwsimError

Value = int | float | bool | str | list[Any] | dict[Any, Any] | None
"""A list holds values, a dictionary values by texts or numbers; None is YAML's null."""
MAX_LENGTH = 4096
"""Longest expression, and longest text it may give [characters]."""
MAX_INTEGER = 2**63
MAX_ITEMS = 10_000
"""Most values in a list or a dictionary, those in their lists and dictionaries included."""
LETTERS = 100
"""Letters of the texts in a list that count as a value."""
MAX_NESTED = 40
"""Deepest nesting of lists and dictionaries."""


class ExpressionError(UwsimError):
    """An expression that cannot be evaluated."""


def written(value: Value) -> str:
    """Return a value as it stands in a file: that of a comparison as ``True``, as xacro has it."""
    return str(value)


def checked(value: Any) -> Value:
    """Return a value within the limits; raises ExpressionError for another.

    Tuples and views of a dictionary become lists.
    """
    if isinstance(value, str) and len(value) > MAX_LENGTH:
        raise ExpressionError(f"a text longer than {MAX_LENGTH} characters")
    if isinstance(value, int) and abs(value) > MAX_INTEGER:
        return float(value)
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, list | dict):
        _check_size(value)
        return value
    if isinstance(value, tuple | KeysView | ValuesView | ItemsView):
        items: list[Any] = list(value)
        return checked([checked(item) for item in items])
    raise ExpressionError("the result is no number, text, list or dictionary")


def _check_size(whole: list[Any] | dict[Any, Any]) -> None:
    """Count the values in a list or dictionary, however often one of them occurs."""
    n_items = 0
    level: list[Any] = [whole]
    for _ in range(MAX_NESTED):
        below: list[Any] = []
        for each in level:
            items = list(each.values()) if isinstance(each, dict) else each
            n_items += len(items) + sum(len(i) for i in items if isinstance(i, str)) // LETTERS
            if n_items > MAX_ITEMS:
                raise ExpressionError(f"a list or dictionary of more than {MAX_ITEMS} values")
            below += [item for item in items if isinstance(item, list | dict)]
        level = below
    if level:
        raise ExpressionError(f"lists are nested deeper than {MAX_NESTED} levels")
