"""Angles of more than a turn: likely degrees instead of radians.

An angle that is meant is the same within one turn, and can be written so.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

MORE_THAN_A_TURN = 6.3
"""Nobody writes a turn with more digits than are needed [rad]."""


def degrees_for_radians(values: Sequence[float]) -> str:
    """Describe angles as if they were degrees; None where none is beyond a turn."""
    if all(abs(value) <= MORE_THAN_A_TURN for value in values):
        return ""
    turned = _list([math.radians(value) for value in values])
    within = _list([math.remainder(value, math.tau) for value in values])
    return (
        f"{_list(values)} in radians, more than a turn; as degrees it would be {turned}, "
        f"else write {within}, which is the same"
    )


def _list(values: Sequence[float]) -> str:
    return " ".join(f"{value:.5g}" for value in values)
