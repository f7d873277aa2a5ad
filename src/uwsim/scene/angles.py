"""Angles of more than a turn: likely degrees instead of radians.

An intended angle of more than a turn can be written as the equal angle within one turn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

MAX_PLAUSIBLE_ANGLE = 6.3
"""The angle above which values are likely degrees: a turn has fewer digits in files [rad]."""


def describe_degrees(values: Sequence[float]) -> str:
    """Describe angles as if they were degrees; empty if none is beyond a turn."""
    if all(abs(value) <= MAX_PLAUSIBLE_ANGLE for value in values):
        return ""
    radians = _list([math.radians(value) for value in values])
    reduced_values = _list([math.remainder(value, math.tau) for value in values])
    return (
        f"{_list(values)} in radians, more than a turn; if these are degrees write {radians}, "
        f"else write {reduced_values}, which is equal"
    )


def _list(values: Sequence[float]) -> str:
    return " ".join(f"{value:.5g}" for value in values)
