"""Values of expressions: numbers, truth values, texts, lists and dictionaries, within limits."""

from __future__ import annotations

from collections.abc import ItemsView, Iterable, KeysView, ValuesView
from typing import Any

from ...errors import UwsimError

Value = int | float | bool | str | list[Any] | dict[Any, Any] | None
"""A value of an expression. A list contains values; a dictionary contains values by texts or
numbers; None is the null of YAML."""
MAX_LENGTH = 4096
"""The greatest length of an expression and of a resulting text [characters]."""
MAX_INTEGER = 2**63
MAX_ITEMS = 10_000
"""The greatest number of values in a list or dictionary, nested ones included."""
MAX_DISTINCT = 1000
"""The greatest number of items of a set: each is compared with all others."""
LETTERS_PER_VALUE = 100
"""The number of characters in texts of a list that count like one value."""
MAX_NESTING = 40
"""The deepest nesting of lists and dictionaries."""


class ExpressionError(UwsimError):
    """An expression that cannot be evaluated."""


class DistinctItems(list[Any]):
    """A set in an expression: a list without equal items, in the order of their first occurrence.

    The order of Python's own sets differs between processes, so that files could not rely on it.
    """

    def __init__(self, items: Iterable[Any] = ()) -> None:
        super().__init__()
        items = list(items)
        if len(items) > MAX_DISTINCT:
            raise ExpressionError(f"a set of more than {MAX_DISTINCT} items")
        for item in items:
            if item not in self:
                self.append(item)

    def __repr__(self) -> str:
        return f"{{{', '.join(map(repr, self))}}}" if self else "set()"

    def __sub__(self, other: Any) -> DistinctItems:
        return DistinctItems(item for item in self if item not in _check_set(other))

    def __and__(self, other: Any) -> DistinctItems:
        return DistinctItems(item for item in self if item in _check_set(other))

    def __or__(self, other: Any) -> DistinctItems:
        return DistinctItems([*self, *_check_set(other)])

    def __le__(self, other: Any) -> bool:
        return not self - _check_set(other)

    def __ge__(self, other: Any) -> bool:
        return not _check_set(other) - self

    def __lt__(self, other: Any) -> bool:
        return self <= other and len(self) < len(other)

    def __gt__(self, other: Any) -> bool:
        return self >= other and len(self) > len(other)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, DistinctItems) and self <= other <= self

    __hash__ = None


def _check_set(value: Any) -> DistinctItems:
    if not isinstance(value, DistinctItems):
        raise TypeError(f"a set and a {type(value).__name__} have no such operation")
    return value


def to_text(value: Value) -> str:
    """Return a value as text, as xacro does: the result of a comparison is ``True``."""
    return str(value)


def check_value(value: Any) -> Value:
    """Return a value if it is within the limits; else raise ExpressionError.

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
        return check_value([check_value(item) for item in items])
    raise ExpressionError("the result is no number, text, list or dictionary")


def _check_size(container: list[Any] | dict[Any, Any]) -> None:
    """Check the number of values in a list or dictionary; shared values count each time."""
    n_items = 0
    level: list[Any] = [container]
    for _ in range(MAX_NESTING):
        next_level: list[Any] = []
        for collection in level:
            items = list(collection.values()) if isinstance(collection, dict) else collection
            n_items += (
                len(items) + sum(len(i) for i in items if isinstance(i, str)) // LETTERS_PER_VALUE
            )
            if n_items > MAX_ITEMS:
                raise ExpressionError(f"a list or dictionary of more than {MAX_ITEMS} values")
            next_level += [item for item in items if isinstance(item, list | dict)]
        level = next_level
    if level:
        raise ExpressionError(f"lists are nested deeper than {MAX_NESTING} levels")
