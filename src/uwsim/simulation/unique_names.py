"""Unique names: the second of two equal names gets the suffix ``#2``."""

from __future__ import annotations

from collections.abc import Iterable


def make_unique(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names in their order, with suffixes ``#2``, ``#3`` for repeated names."""
    unique_names: dict[str, None] = {}
    for name in names:
        candidate, number = name, 1
        while candidate in unique_names:
            number += 1
            candidate = f"{name}#{number}"
        unique_names[candidate] = None
    return tuple(unique_names)
