"""Unique names for objects that share one: the second gets ``#2`` behind it."""

from __future__ import annotations

from collections.abc import Iterable


def make_unique(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names, each of which is there once."""
    unique_names: dict[str, None] = {}
    for name in names:
        candidate, number = name, 1
        while candidate in unique_names:
            number += 1
            candidate = f"{name}#{number}"
        unique_names[candidate] = None
    return tuple(unique_names)
