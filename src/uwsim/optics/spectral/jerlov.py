r"""The water types of Jerlov by wavelength.

N. G. Jerlov (*Marine Optics*, 2nd edition, 1976, table XXVII) defines the types by the diffuse
attenuation :math:`K_d` of daylight from 310 to 700 nm. The scattering is that of M. G. Solonenko
and C. D. Mobley (*Appl. Opt.* 54, 5392 (2015)), whose particles scatter as

.. math:: b_p = b_p(550)\, (550 / \lambda)^{1.7}

and the absorption is that of which Kirk's formula (`medium`) makes Jerlov's :math:`K_d`:

.. math:: a = -\tfrac12 G b + \sqrt{(\tfrac12 G b)^2 + K_d^2}, \quad G = 0.256

but not less than that of pure water :math:`a_w`. Between the wavelengths of the table
:math:`K_d - a_w` is linear. Solonenko and Mobley's own absorption, at 680, 550 and 440 nm, is near
it: at 550 nm within 15 % for I to III, 1C and 9C, and 16 to 33 % less for 3C to 7C; at 440 nm it is
up to 48 % less.
"""

from __future__ import annotations

import numpy as np

from ..medium import KIRK_FACTOR
from .colorimetry import WAVELENGTHS
from .pure_water import SCATTERING_AT_550, find_pure_water, scale_particles
from .spectral_water import SpectralWater

TABLE_WAVELENGTHS = (
    *(375.0, 400.0, 425.0, 450.0, 475.0, 500.0, 525.0),
    *(550.0, 575.0, 600.0, 625.0, 650.0, 675.0, 700.0),
)
"""The wavelengths of Jerlov's table [nm]."""
DIFFUSE_ATTENUATION = {
    "I": (3.8, 2.8, 2.2, 1.9, 1.8, 2.7, 4.3, 6.3, 8.9, 23.5, 30.5, 36, 42, 56),
    "IA": (5.2, 3.8, 3.1, 2.6, 2.5, 3.2, 4.8, 6.7, 9.4, 24, 31, 37, 43, 57),
    "IB": (6.6, 5.1, 4.2, 3.6, 3.3, 4.2, 5.4, 7.2, 9.9, 24.5, 31.5, 37.5, 43.5, 58),
    "II": (12.2, 9.6, 8.1, 6.8, 6.2, 7.0, 7.6, 8.9, 11.5, 26, 33.5, 40, 46.5, 61),
    "III": (22, 18.5, 16, 13.5, 11.6, 11.5, 11.6, 12, 14.8, 29.5, 37.5, 44.5, 52, 66),
    "1C": (80, 51, 36, 25, 17, 14, 13, 12, 15, 30, 37, 45, 51, 65),
    "3C": (110, 78, 54, 39, 29, 22, 20, 19, 21, 33, 40, 46, 56, 71),
    "5C": (160, 110, 78, 56, 43, 36, 31, 30, 33, 40, 48, 54, 65, 80),
    "7C": (210, 160, 120, 89, 71, 58, 49, 46, 46, 48, 54, 63, 78, 92),
    "9C": (300, 240, 190, 160, 123, 99, 78, 63, 58, 60, 65, 76, 92, 110),
}
"""The diffuse attenuation of each type at `TABLE_WAVELENGTHS` [0.01/m]."""
SCATTERING = {
    **{"I": 0.002, "IA": 0.0035, "IB": 0.054, "II": 0.358, "III": 0.98},
    **{"1C": 0.365, "3C": 1.06, "5C": 1.33, "7C": 2.35, "9C": 3.12},
}
"""The scattering of each type at 550 nm, that of the water included [1/m]."""
PARTICLE_EXPONENT = 1.7
"""The exponent of the scattering of small particles."""


def find_jerlov_spectrum(name: str) -> SpectralWater:
    """Return a water type by its name, such as ``3C``; raise KeyError if there is none."""
    pure_absorption, molecules = find_pure_water()
    table = np.array(DIFFUSE_ATTENUATION[name]) / 100.0
    contents = table - np.interp(TABLE_WAVELENGTHS, WAVELENGTHS, pure_absorption)
    attenuation = pure_absorption + np.interp(WAVELENGTHS, TABLE_WAVELENGTHS, contents)
    particles = max(SCATTERING[name] - SCATTERING_AT_550, 0.0)
    scattering = molecules + scale_particles(particles, PARTICLE_EXPONENT)
    half = 0.5 * KIRK_FACTOR * scattering
    absorption = np.maximum(
        np.sqrt(half * half + attenuation * attenuation) - half, pure_absorption
    )
    return SpectralWater(
        wavelengths=tuple(WAVELENGTHS.tolist()),
        absorption=tuple(absorption.tolist()),
        scattering=tuple(scattering.tolist()),
    )
