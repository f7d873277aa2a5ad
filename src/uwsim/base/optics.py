"""Units of fog: a density, or the distance at which contrast has fallen to a given share."""

from __future__ import annotations

import math
from collections.abc import Callable

CONTRAST_EXPONENT = math.log(50.0)
"""Exponent of the contrast threshold of 2 %, below which nothing is seen."""
DENSITY = "density"
LENGTHS: dict[str, Callable[[float], float]] = {
    "attenuationLength": lambda length: 1.0 / length,
    "visibilityRange": lambda length: math.sqrt(CONTRAST_EXPONENT) / length,
}
"""``u:unit`` -> fog density [1/m] of a length [m], and the same the other way round."""
