r"""marineSnow: flocs of organic matter that sink slowly and are carried by the current.

.. code-block:: xml

    <u:marineSnow> <u:concentration>5000</u:concentration> </u:marineSnow>

Marine snow is larger than 0.5 mm, with up to some hundred flocs a litre near the surface, and sinks
1 to some 100 m a day (A. L. Alldredge and M. W. Silver, *Prog. Oceanogr.* 20, 41 (1988)). Its
sinking speed grows with size as

.. math:: w = w_1\, (d / 1\,\mathrm{mm})^{0.26}

with :math:`w_1` = 50 m/day (A. L. Alldredge and C. Gotschalk, *Limnol. Oceanogr.* 33, 339 (1988)).
Not modelled: strings and other long flocs, collisions, and the light that flocs take from each
other; the scattering b of the water stands for all smaller particles.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from ..errors import BadSetting
from ..schema import Spec, element
from .population import Kind, SizeClass, divide_population

MAX_CONCENTRATION = 1e6
"""The largest concentration in a file [1/m3]."""
SINKING_EXPONENT = 0.26
"""The exponent of the sinking speed over the diameter."""


@dataclass(frozen=True, kw_only=True)
class MarineSnowSpec(Spec):
    """A ``<u:marineSnow>``: flocs that sink in the water."""

    concentration: float = element(
        namespaced=True, default=5000.0, minimum=0.0, maximum=MAX_CONCENTRATION
    )
    """The number of flocs between the two diameters [1/m3]."""
    min_diameter: float = element(namespaced=True, default=0.0005, minimum=1e-4, maximum=0.05)
    """The smallest diameter [m]."""
    max_diameter: float = element(namespaced=True, default=0.005, minimum=1e-4, maximum=0.05)
    """The largest diameter [m]."""
    slope: float = element(namespaced=True, default=3.5, minimum=1.5, maximum=8.0)
    """The exponent s of the numbers over the diameter, d^-s [1]."""
    reflectance: float = element(namespaced=True, default=0.05, minimum=0.0, maximum=0.25)
    """The mean ratio of a floc's radiance to that of a white surface that faces the light [1].
    Flocs are porous; one that scatters all light evenly has 0.25."""
    sinking_speed: float = element(namespaced=True, default=0.00058, minimum=0.0, maximum=0.1)
    """The sinking speed of a floc of 1 mm [m/s]; 0.00058 m/s is 50 m a day."""

    def divide(self, keys: Callable[[], int]) -> tuple[SizeClass, ...]:
        """Return the classes of size.

        Args:
            keys: returns the key of the next class.

        Raises:
            BadSetting: the largest diameter is below the smallest.
        """
        check_diameters("marineSnow", self.min_diameter, self.max_diameter)
        return divide_population(
            kind=Kind.FLOC,
            keys=keys,
            concentration=self.concentration,
            min_diameter=self.min_diameter,
            max_diameter=self.max_diameter,
            slope=self.slope,
            rise_speed=lambda d: -self.sinking_speed * math.pow(d / 0.001, SINKING_EXPONENT),
            reflectance=self.reflectance,
        )


def check_diameters(name: str, min_diameter: float, max_diameter: float) -> None:
    """Raise BadSetting if the largest diameter is below the smallest."""
    if max_diameter < min_diameter:
        raise BadSetting(
            f"<u:{name}> has diameters from {min_diameter:g} to {max_diameter:g} m; expected "
            "<u:maxDiameter> not below <u:minDiameter>."
        )
