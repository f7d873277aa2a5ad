r"""Electric power that the thrusters and joints of a vehicle draw from its battery.

*Thruster.* A propeller that does not advance must give the water of its disc the power of momentum
theory (Rankine and Froude; Carlton, *Marine Propellers and Propulsion*, ch. 8):

.. math:: P = \frac{|T|^{3/2}}{\eta \sqrt{2 \rho A}}, \qquad A = \pi r^2

where :math:`\eta` is the *efficiency* from the battery to that ideal: motor and its electronics
times the propeller's figure of merit. A duct may lift the figure of merit up to
:math:`\sqrt 2`. Instead of the law a file may give measured power as a polynomial of the thrust,

.. math:: P = c_1 |T| + c_2 |T|^2 + \dots

T is the present thrust: a dead thruster draws no power. One that lost half of its thrust draws what
a healthy one draws for that half.

*Joint.* A motor with a gear draws power for its work and for the current that makes its torque
(Spong, Hutchinson and Vidyasagar, *Robot Modeling and Control*, ch. 6: copper loss
:math:`R i^2`, with :math:`i` in proportion to the torque):

.. math:: P = \frac{\max(0, \tau \omega)}{\eta} + k \tau^2

Work of the load on the motor is lost: there is no regeneration.

Not modelled: inflow (it changes the power of a thruster), idling current, the voltage of the
battery and its own losses, friction of gears at rest.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...scene.hydrodynamics.power_checks import greatest_thrust, polynomial
from ...scene.hydrodynamics.spec import ThrusterSpec

DEFAULT_EFFICIENCY = 0.4
"""The efficiency of a thruster whose file does not state one [1]."""


def power_table(thruster: ThrusterSpec, density: float, min_terms: int = 0) -> Array:
    """Return the coefficients of `power_kernel.thruster_power`, (2, 1 + n).

    Args:
        thruster: the spec of the thruster.
        density: the density of the water [kg/m3].
        min_terms: the least number of coefficients of the polynomials.
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
        thrusts = np.linspace(0.0, greatest_thrust(thruster, forward=forward), 201)
        ideal_powers = table[row, 0] * thrusts**1.5
        max_powers.append(float((ideal_powers + polynomial(tuple(table[row, 1:]), thrusts)).max()))
    return max(max_powers)
