r"""sediment: clouds that thrusters stir up from the floor.

.. code-block:: xml

    <u:sediment> <u:criticalStress>0.1</u:criticalStress> </u:sediment>

The jet of a thruster (`jet`) exerts the stress :math:`\tau = \frac12 C_f \rho u^2` on the floor,
with :math:`C_f` = 0.01, an assumption of the order of measured friction. It erodes the mass

.. math:: E = M \left( \frac{\tau}{\tau_c} - 1 \right)

per area and time (E. Partheniades, *J. Hydraul. Div. ASCE* 91, 105 (1965)); M is 0.01 to 0.5 g/m2/s
for mud (J. C. Winterwerp and W. G. M. van Kesteren, *Introduction to the Physics of Cohesive
Sediment*, Elsevier (2004)). The area is a disc as wide as the jet. The eroded mass becomes puffs
(`puffs`), whose scattering is the mass per volume times 500 m2/kg, that of mineral particles (M.
Babin and others, *Limnol. Oceanogr.* 48, 843 (2003)).

Clouds affect images through physical water alone: not sonar, range, segmentation, or truth. Not
modelled: the floor that is lost, kinds of floor (rock erodes too), stirring by bodies and waves,
and the density of the cloud.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..base.geometry import Triple
from ..schema import Spec, element
from .terminal_speed import WATER_DENSITY

FRICTION_FACTOR = 0.01
"""The friction factor of a jet along the floor [1]."""


@dataclass(frozen=True, kw_only=True)
class SedimentSpec(Spec):
    """A ``<u:sediment>``: the loose floor below thrusters."""

    critical_stress: float = element(
        namespaced=True, default=0.1, exclusive_minimum=0.0, maximum=100.0
    )
    """The stress on the floor above which it erodes [Pa]."""
    erosion_rate: float = element(namespaced=True, default=5e-4, minimum=0.0, maximum=1.0)
    """The factor M of the erosion [kg/m2/s]."""
    settling_speed: float = element(namespaced=True, default=5e-4, minimum=0.0, maximum=0.1)
    """The speed at which the particles settle [m/s]."""
    diffusivity: float = element(namespaced=True, default=0.003, minimum=0.0, maximum=1.0)
    """The diffusivity of the water around the clouds [m2/s]."""
    scattering: float = element(namespaced=True, default=500.0, minimum=0.0, maximum=1e5)
    """The scattering coefficient over the mass of particles per volume [m2/kg]."""
    color: Triple = element(
        namespaced=True, default=(0.55, 0.48, 0.38), parts="rgb", minimum=0.0, maximum=1.0
    )
    """The albedo of a thick cloud in daylight [1]."""

    def compute_erosion(self, speed: float) -> float:
        """Compute the mass eroded by a flow along the floor [kg/m2/s].

        Args:
            speed: the speed along the floor [m/s].
        """
        stress = 0.5 * FRICTION_FACTOR * WATER_DENSITY * speed * speed
        return self.erosion_rate * max(stress / self.critical_stress - 1.0, 0.0)
