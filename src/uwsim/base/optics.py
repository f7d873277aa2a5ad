"""Units of fog: a density, or the distance at which the contrast has decreased to a given share."""

from __future__ import annotations

import math
from collections.abc import Callable

CONTRAST_EXPONENT = math.log(50.0)
"""The exponent of the contrast threshold of 2 %, below which nothing is visible."""
DENSITY = "density"
"""The ``u:unit`` of a value that is a fog density [1/m]."""
LENGTHS: dict[str, Callable[[float], float]] = {
    "attenuationLength": lambda length: 1.0 / length,
    "visibilityRange": lambda length: math.sqrt(CONTRAST_EXPONENT) / length,
}
"""The functions that convert a length [m] to a fog density [1/m], and back, by ``u:unit``."""
