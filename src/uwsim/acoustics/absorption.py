r"""Absorption of sound by sea water, after Francois and Garrison.

R. E. Francois, G. R. Garrison, *Sound absorption based on ocean measurements. Part II: Boric acid
contribution and equation for total absorption*, J. Acoust. Soc. Am. 72(6), 1982. With the frequency
f [kHz], the relaxation frequencies :math:`f_1` of boric acid and :math:`f_2` of magnesium sulphate
[kHz], and coefficients A and P that depend on temperature, salinity, pH and depth,

.. math::

    \alpha = \frac{A_1 P_1 f_1 f^2}{f_1^2 + f^2} + \frac{A_2 P_2 f_2 f^2}{f_2^2 + f^2}
             + A_3 P_3 f^2 .

The equation was fitted to measurements from 0.2 kHz to 1 MHz and from -2 to 22 degrees Celsius,
where its authors state an error of 5 %. In fresh water only the last term, of pure water, remains.
"""

from __future__ import annotations

import math

MAX_COLD_TEMPERATURE = 20.0
"""The temperature above which A3 has a second set of coefficients [degrees Celsius]."""


def absorption(
    frequency: float, *, temperature: float, salinity: float, depth: float, ph: float = 8.0
) -> float:
    """Return the absorption coefficient of sound in sea water [dB/m].

    Args:
        frequency: the frequency of the sound [Hz].
        temperature: the temperature of the water [degrees Celsius].
        salinity: the practical salinity [g/kg].
        depth: the depth below the surface [m].
        ph: the pH of the water on the scale of the National Bureau of Standards [1].
    """
    f = frequency / 1000.0
    kelvin = 273.0 + temperature
    c = 1412.0 + 3.21 * temperature + 1.19 * salinity + 0.0167 * depth  # sound speed in the paper
    boric = 8.86 / c * 10.0 ** (0.78 * ph - 5.0) if salinity > 0.0 else 0.0
    f1 = 2.8 * math.sqrt(salinity / 35.0) * 10.0 ** (4.0 - 1245.0 / kelvin)
    magnesium = 21.44 * salinity / c * (1.0 + 0.025 * temperature)
    f2 = 8.17 * 10.0 ** (8.0 - 1990.0 / kelvin) / (1.0 + 0.0018 * (salinity - 35.0))
    magnesium *= 1.0 - 1.37e-4 * depth + 6.2e-9 * depth**2
    water = _pure_water(temperature) * (1.0 - 3.83e-5 * depth + 4.9e-10 * depth**2)
    per_km: float = (
        boric * f1 * f**2 / (f1**2 + f**2) + magnesium * f2 * f**2 / (f2**2 + f**2) + water * f**2
    )
    return per_km / 1000.0


def _pure_water(temperature: float) -> float:
    """Return the coefficient A3 of pure water at a temperature [degrees Celsius], [dB/km/kHz2]."""
    t = temperature
    if t <= MAX_COLD_TEMPERATURE:
        return 4.937e-4 - 2.59e-5 * t + 9.11e-7 * t**2 - 1.50e-8 * t**3
    return 3.964e-4 - 1.146e-5 * t + 1.45e-7 * t**2 - 6.5e-10 * t**3
