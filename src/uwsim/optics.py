"""How fog is said: as a density, or as the length at which contrast has fallen so far."""

from __future__ import annotations

import math
from collections.abc import Callable

EXPONENT_SEEN = math.log(50.0)
"""Of the contrast of 2 %, the least that is seen."""
DENSITY = "density"
LENGTHS: dict[str, Callable[[float], float]] = {
    "attenuationLength": lambda length: 1.0 / length,
    "visibilityRange": lambda length: math.sqrt(EXPONENT_SEEN) / length,
}
"""``u:unit`` -> fog density [1/m] of a length [m], and the same the other way round."""
