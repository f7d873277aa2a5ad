"""Values of expressions: numbers, truth values, texts, lists and dictionaries, within limits."""

from __future__ import annotations

from collections.abc import ItemsView, Iterable, KeysView, ValuesView
from typing import Any

from ...errors import UwsimError

Value = int | float | bool | str | list[Any] | dict[Any, Any] | None
"""A list holds values, a dictionary values by texts or numbers; None is YAML's null."""
MAX_LENGTH = 4096
"""Longest expression, and longest text it may give [characters]."""
MAX_INTEGER = 2**63
MAX_ITEMS = 10_000
"""Most values in a list or a dictionary, those in their lists and dictionaries included."""
MAX_DISTINCT = 1000
"""Most items of which a set is made: each is compared with all others."""
LETTERS = 100
"""Letters of the texts in a list that count as a value."""
MAX_NESTED = 40
"""Deepest nesting of lists and dictionaries."""


class ExpressionError(UwsimError):
    """An expression that cannot be evaluated."""


class DistinctItems(list[Any]):
    """The set of an expression: a list without equal items, in the order of their first ones.

    Python's sets have another order in each process, and no file can rely on that.
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
        return DistinctItems(item for item in self if item not in _distinct(other))

    def __and__(self, other: Any) -> DistinctItems:
        return DistinctItems(item for item in self if item in _distinct(other))

    def __or__(self, other: Any) -> DistinctItems:
        return DistinctItems([*self, *_distinct(other)])

    def __le__(self, other: Any) -> bool:
        return not self - _distinct(other)

    def __ge__(self, other: Any) -> bool:
        return not _distinct(other) - self

    def __lt__(self, other: Any) -> bool:
        return self <= other and len(self) < len(other)

    def __gt__(self, other: Any) -> bool:
        return self >= other and len(self) > len(other)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, DistinctItems) and self <= other <= self

    __hash__ = None


def _distinct(value: Any) -> DistinctItems:
    if not isinstance(value, DistinctItems):
        raise TypeError(f"a set and a {type(value).__name__} have no such operation")
    return value


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
