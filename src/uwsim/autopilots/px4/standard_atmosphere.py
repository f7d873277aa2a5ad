r"""The pressure that PX4's barometer measures.

PX4 computes altitudes from pressures with the standard atmosphere (ISO 2533), also under water:

.. math:: p = p_0 \Bigl(1 - \frac{L h}{T_0}\Bigr)^{g / (R L)}

with the altitude h, the pressure :math:`p_0` = 101325 Pa, the temperature :math:`T_0` = 288.15 K,
the lapse rate L = 6.5 K/km, g = 9.80665 m/s2 and the gas constant of air R = 287.05287 J/(kg K). At
a depth d, the formula with h = -d gives the pressure from which PX4 computes the altitude -d. It is
the pressure of air, 12 Pa per metre. The pressure of water, 10 kPa per metre, would be taken for 6
km below sea level after 10 m. PX4's simulators of underwater vehicles use the same convention.
"""

from __future__ import annotations

PRESSURE, TEMPERATURE = 101325.0, 288.15
"""The pressure [Pa] and the temperature [K] at sea level."""
LAPSE_RATE = 0.0065
"""The decrease of the temperature with the altitude [K/m]."""
EXPONENT = 9.80665 / (287.05287 * LAPSE_RATE)
"""The exponent, 5.256 [1]."""


def air_pressure(altitude: float) -> float:
    """Return the pressure of the standard atmosphere at an altitude, at most 11 km [Pa]."""
    return float(PRESSURE * (1.0 - LAPSE_RATE * altitude / TEMPERATURE) ** EXPONENT)


def air_temperature(altitude: float) -> float:
    """Return the temperature of the standard atmosphere at an altitude, at most 11 km [degC]."""
    return TEMPERATURE - LAPSE_RATE * altitude - 273.15
