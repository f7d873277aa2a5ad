"""Names of their own for things of one name: the second gets ``#2`` behind it."""

from __future__ import annotations

from collections.abc import Iterable


def unique(names: Iterable[str]) -> tuple[str, ...]:
    """Return names of which none is there twice."""
    found: dict[str, None] = {}
    for name in names:
        own, number = name, 1
        while own in found:
            number += 1
            own = f"{name}#{number}"
        found[own] = None
    return tuple(found)
