r"""bubbles: air below breaking waves, or gas that rises from a place.

.. code-block:: xml

    <u:bubbles> <u:source> <x>3</x> <y>0</y> <z>12</z> </u:source> <u:rate>40</u:rate> </u:bubbles>

Without a source the bubbles are below the surface; their concentration falls by :math:`e^{-z/L}`
with the depth z. With one they rise from a place in L: bubble k leaves it at the time
:math:`k / \mathrm{rate}`, rises at its terminal speed (`terminal_speed`) and moves with the water
that is now at the first vehicle. Their path wobbles by 0.02 m, and the source spreads as a plume of
the slope 0.1. Not modelled: growth, solution, coalescence, the water that a plume carries upwards,
and the bubbles of a diver or a thruster that move with them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..base.geometry import Triple
from ..schema import MAX_DISTANCE, Spec, element
from .marine_snow import MAX_CONCENTRATION, check_diameters
from .population import Kind, SizeClass, divide_population
from .terminal_speed import compute_bubble_speed


@dataclass(frozen=True, kw_only=True)
class BubblesSpec(Spec):
    """A ``<u:bubbles>``: bubbles that rise in the water."""

    concentration: float = element(
        namespaced=True, default=2000.0, minimum=0.0, maximum=MAX_CONCENTRATION
    )
    """The number of bubbles at the surface [1/m3], without a source."""
    depth_scale: float = element(namespaced=True, default=1.0, minimum=0.01, maximum=1000.0)
    """The depth L over which the concentration falls to 1/e, without a source [m]."""
    source: Triple | None = element(
        namespaced=True, default=None, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The place in L from which the bubbles rise [m]; when absent they are below the surface."""
    rate: float = element(namespaced=True, default=40.0, minimum=0.0, maximum=2000.0)
    """The number of bubbles that leave the source [1/s]."""
    min_diameter: float = element(namespaced=True, default=0.001, minimum=1e-4, maximum=0.05)
    """The smallest diameter [m]."""
    max_diameter: float = element(namespaced=True, default=0.006, minimum=1e-4, maximum=0.05)
    """The largest diameter [m]."""
    slope: float = element(namespaced=True, default=3.0, minimum=1.5, maximum=8.0)
    """The exponent s of the numbers over the diameter, d^-s [1]."""
    reflectance: float = element(namespaced=True, default=0.3, minimum=0.0, maximum=1.0)
    """The ratio of a bubble's mean radiance to that of a white surface that faces the light [1]."""

    def divide(self, keys: Callable[[], int]) -> tuple[SizeClass, ...]:
        """Return the classes of size of the bubbles below the surface, or of the source.

        The concentration of a source's bubbles is their share of the rate.

        Args:
            keys: returns the key of the next class.

        Raises:
            BadSetting: the largest diameter is below the smallest.
        """
        check_diameters("bubbles", self.min_diameter, self.max_diameter)
        return divide_population(
            kind=Kind.BUBBLE,
            keys=keys,
            concentration=self.concentration if self.source is None else self.rate,
            min_diameter=self.min_diameter,
            max_diameter=self.max_diameter,
            slope=self.slope,
            rise_speed=compute_bubble_speed,
            reflectance=self.reflectance,
            depth_scale=self.depth_scale,
        )
