r"""Populations of particles: numbers, sizes and speeds, in classes of size.

The number of particles per volume and diameter follows a power law between two diameters,
:math:`n(d) \propto d^{-s}`. The slope s of particles in the sea is 3 to 5 (L. Stemmann and E.
Boss, *Annu. Rev. Mar. Sci.* 4, 263 (2012)). A population is divided into classes whose diameters
differ by `CLASS_RATIO` at most. The particles of a class move at one speed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum

CLASS_RATIO = 1.5
"""The ratio of the largest to the smallest diameter in a class."""


class Kind(IntEnum):
    """The kinds of particles, which look different."""

    FLOC = 0
    """A floc of marine snow: a soft disc."""
    BUBBLE = 1
    """A bubble: a disc with a bright rim."""


@dataclass(frozen=True, kw_only=True)
class SizeClass:
    """A class of particles of similar size, evenly distributed in the water."""

    kind: Kind
    """The kind of the particles."""
    key: int
    """The key of the class's random numbers, 64 bits."""
    concentration: float
    """The number of particles [1/m3]."""
    min_diameter: float
    """The smallest diameter [m]."""
    max_diameter: float
    """The largest diameter [m]."""
    slope: float
    """The slope s of the numbers over the diameter."""
    rise_speed: float
    """The speed relative to the water, upwards positive [m/s]."""
    reflectance: float
    """The ratio of radiance to that of a white surface that faces the light [1]."""
    depth_scale: float = math.inf
    """The depth over which the concentration falls to 1/e below the water's surface [m]."""


def divide_population(
    *,
    kind: Kind,
    keys: Callable[[], int],
    concentration: float,
    min_diameter: float,
    max_diameter: float,
    slope: float,
    rise_speed: Callable[[float], float],
    reflectance: float,
    depth_scale: float = math.inf,
) -> tuple[SizeClass, ...]:
    """Divide a population into classes of size.

    Args:
        kind: the kind of the particles.
        keys: returns the key of the next class.
        concentration: the number of all particles [1/m3].
        min_diameter: the smallest diameter [m].
        max_diameter: the largest diameter [m].
        slope: the slope s, not 1.
        rise_speed: the speed at a diameter, upwards positive [m/s].
        reflectance: the ratio of radiance to that of a white surface that faces the light [1].
        depth_scale: the depth over which the concentration falls to 1/e [m].
    """
    ratio = max_diameter / min_diameter
    n_classes = max(math.ceil(math.log(ratio) / math.log(CLASS_RATIO) - 1e-9), 1)
    edges = [min_diameter * math.pow(ratio, i / n_classes) for i in range(n_classes + 1)]
    powers = [math.pow(edge / min_diameter, 1.0 - slope) for edge in edges]
    span = powers[-1] - powers[0]
    return tuple(
        SizeClass(
            kind=kind,
            key=keys(),
            concentration=concentration * ((powers[i + 1] - powers[i]) / span if span else 1.0),
            min_diameter=edges[i],
            max_diameter=edges[i + 1],
            slope=slope,
            rise_speed=rise_speed(math.sqrt(edges[i] * edges[i + 1])),
            reflectance=reflectance,
            depth_scale=depth_scale,
        )
        for i in range(n_classes)
    )
