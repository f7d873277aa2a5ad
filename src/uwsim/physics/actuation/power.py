r"""Electric power that the thrusters and joints of a vehicle draw from its battery.

*Thruster.* With the power of a propeller without advance by momentum theory (Rankine and Froude;
Carlton, *Marine Propellers and Propulsion*, ch. 8), the electric power at the thrust T is

.. math:: P = \frac{|T|^{3/2}}{\eta \sqrt{2 \rho A}}, \qquad A = \pi r^2

with the density :math:`\rho` of the water and the radius r of the propeller. The *efficiency*
:math:`\eta` is the product of the efficiency of the motor with its electronics and the propeller's
figure of merit, which a duct may raise up to :math:`\sqrt 2`. Instead, a file may state measured
power as a polynomial of the thrust,

.. math:: P = c_1 |T| + c_2 |T|^2 + \dots

T is the present thrust: a dead thruster draws no power. A thruster that has lost half of its thrust
draws the power of a healthy thruster at that reduced thrust.

*Joint.* A motor with a gear draws power for its mechanical work and for the current that produces
its torque (Spong, Hutchinson and Vidyasagar, *Robot Modeling and Control*, ch. 6: copper loss
:math:`R i^2`, with the current i proportional to the torque). With the effort :math:`\tau`, the
joint's velocity :math:`\omega`, the efficiency :math:`\eta` and the copper loss k,

.. math:: P = \frac{\max(0, \tau \omega)}{\eta} + k \tau^2

There is no regeneration: work of the load on the motor is lost.

Not modelled: the effect of the inflow on the power of a thruster, idling current, the voltage of
the battery and its own losses, friction of gears at rest.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...scene.hydrodynamics.power_checks import max_thrust, polynomial
from ...scene.hydrodynamics.spec import ThrusterSpec

DEFAULT_EFFICIENCY = 0.4
"""The efficiency of a thruster whose file does not state one [1]."""


def power_table(thruster: ThrusterSpec, density: float, min_terms: int = 0) -> Array:
    """Return the table of coefficients for `power_kernel.thruster_power`, (2, 1 + n).

    Args:
        thruster: the spec of the thruster.
        density: the density of the water [kg/m3].
        min_terms: the minimum number n of polynomial coefficients, padded with zeros.
    """
    forward, backward = thruster.power, thruster.power_backward or thruster.power
    min_terms = max(min_terms, len(forward or ()), len(backward or ()))
    table = np.zeros((2, 1 + min_terms))
    disc = math.pi * thruster.radius**2
    for row, curve in enumerate((forward, backward)):
        if curve is None:
            efficiency = DEFAULT_EFFICIENCY if thruster.efficiency is None else thruster.efficiency
            table[row, 0] = 1.0 / (efficiency * math.sqrt(2.0 * density * disc))
        else:
            table[row, 1 : 1 + len(curve)] = curve
    return table


def greatest_power(thruster: ThrusterSpec, density: float) -> float:
    """Return the electric power of a thruster at its greatest thrust, forward or backward [W].

    Args:
        thruster: the spec of the thruster.
        density: the density of the water [kg/m3].
    """
    table = power_table(thruster, density)
    max_powers = []
    for row, forward in enumerate((True, False)):
        thrusts = np.linspace(0.0, max_thrust(thruster, forward=forward), 201)
        ideal_powers = table[row, 0] * thrusts**1.5
        max_powers.append(float((ideal_powers + polynomial(tuple(table[row, 1:]), thrusts)).max()))
    return max(max_powers)
