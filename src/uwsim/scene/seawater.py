r"""Density of sea water by the equation of state of UNESCO, EOS-80, at atmospheric pressure.

.. math:: \rho = \rho_w(T) + A(T) S + B(T) S^{3/2} + C S^2

Fofonoff and Millard, *Algorithms for computation of fundamental properties of seawater*, UNESCO
technical papers in marine science 44, 1983: for salinities S of 0 to 42 and temperatures T of -2 to
40 degrees Celsius. Not modelled: compression under pressure, 0.5 % at 1000 m.
"""

from __future__ import annotations

PURE_WATER = (999.842594, 6.793952e-2, -9.095290e-3, 1.001685e-4, -1.120083e-6, 6.536332e-9)
A = (8.24493e-1, -4.0899e-3, 7.6438e-5, -8.2467e-7, 5.3875e-9)
B = (-5.72466e-3, 1.0227e-4, -1.6546e-6)
C = 4.8314e-4


def sea_water_density(temperature: float, salinity: float) -> float:
    """Return the density of sea water [kg/m3].

    Args:
        temperature: the temperature [degrees Celsius].
        salinity: the practical salinity, grams of salt per kilogram [1].
    """
    root = float(salinity**0.5)
    return (
        _polynomial(PURE_WATER, temperature)
        + _polynomial(A, temperature) * salinity
        + _polynomial(B, temperature) * salinity * root
        + C * salinity * salinity
    )


def _polynomial(coefficients: tuple[float, ...], x: float) -> float:
    total = 0.0
    for coefficient in reversed(coefficients):
        total = total * x + coefficient
    return total
