"""Detection of angles that are likely in degrees instead of radians: angles of more than a turn.

An intended angle of more than a turn can be written as the equal angle within one turn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

MAX_PLAUSIBLE_ANGLE = 6.3
"""The angle above which a value is likely in degrees: a turn, as files round it [rad]."""


def describe_degrees(values: Sequence[float]) -> str:
    """Return a hint for angles [rad] that may be degrees; empty if none exceeds a turn."""
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
