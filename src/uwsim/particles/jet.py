r"""The jet of a thruster, and its speed along the floor.

A propeller of diameter D and thrust T accelerates the water to (momentum theory)

.. math:: U_0 = \sqrt{\frac{2 T}{\rho A}} = 1.60 \sqrt{\frac{T}{\rho D^2}}

The jet behind it has the initial diameter :math:`D_0 = D / \sqrt 2` and, at the distance x and the
distance r from its axis, the speed

.. math:: u(x, r) = 2.8\, U_0 \frac{D_0}{x}\, e^{-15.4\, r^2 / x^2}

(H. G. Blaauw and E. J. van de Kaa, *Erosion of bottom and sloping banks caused by the screw race
of manoeuvring ships*, Delft Hydraulics publication 202 (1978)); its momentum is the thrust to 2 %.
Nearer than :math:`2.8 D_0` the speed is :math:`U_0`. Along a level floor at the height h below a
jet whose axis rises by :math:`d_z` per length, r is :math:`h + d_z x`, and the greatest speed is
that at :math:`h / x = q` with :math:`30.8\, q (q + d_z) = 1`; for a level jet it is
:math:`0.31 U_0 D_0 / h`.
Not modelled: swirl, the wall jet of the water that the floor deflects, hulls in the jet, and the
motion of the vehicle and the current, which bend the jet.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .terminal_speed import WATER_DENSITY

AXIS_FACTOR = 2.8
"""The factor of the speed on the axis [1]."""
SPREAD = 15.4
"""The factor in the exponent of the profile [1]."""
WIDTH = 1.0 / math.sqrt(SPREAD)
"""The distance from the axis at which the speed is 1/e of that on the axis, over x [1]."""


@dataclass(frozen=True, kw_only=True)
class Jet:
    """The jet of a thruster."""

    thrust: float
    """The thrust, 0 or more [N]."""
    diameter: float
    """The diameter of the propeller [m]."""

    @property
    def initial_speed(self) -> float:
        """The speed behind the propeller [m/s]."""
        area = 0.25 * math.pi * self.diameter**2
        return math.sqrt(2.0 * self.thrust / (WATER_DENSITY * area))

    @property
    def initial_diameter(self) -> float:
        """The diameter of the jet where it has contracted [m]."""
        return self.diameter / math.sqrt(2.0)

    def compute_speed(self, distance: float, radius: float = 0.0) -> float:
        """Compute the speed at a distance behind the propeller and one from the axis [m/s]."""
        core = AXIS_FACTOR * self.initial_diameter
        length = max(distance, 1e-6)
        axis_speed = self.initial_speed * min(core / length, 1.0)
        return axis_speed * math.exp(-SPREAD * (radius / length) ** 2)

    def find_floor_contact(self, height: float, rise: float) -> tuple[float, float]:
        """Find where the jet is fastest along a level floor.

        Args:
            height: the height of the propeller above the floor, above 0 [m].
            rise: the upward component of the jet's direction, -1..1.

        Returns:
            The distance along the axis [m], and the speed there [m/s].
        """
        slope = 0.5 * (math.sqrt(rise * rise + 2.0 / SPREAD) - rise)
        distance = height / slope
        return distance, self.compute_speed(distance, height + rise * distance)
