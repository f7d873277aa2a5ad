r"""Absorption and scattering of pure water at a wavelength, for the clear reference of a tank.

Absorption is that of R. M. Pope and E. S. Fry (*Appl. Opt.* 36, 8710 (1997)), linear between the
rows of `ABSORPTION`. Scattering is that of sea water without particles after R. C. Smith and
K. S. Baker (*Appl. Opt.* 20, 177 (1981)), with the power law of A. Morel (1974):

.. math:: b = 0.0019\,\mathrm{m}^{-1} \left(\frac{550\,\mathrm{nm}}{\lambda}\right)^{4.32}

Tap water has 0.01 to 0.1 1/m more of both, by particles and dissolved matter.
"""

from __future__ import annotations

import numpy as np

WAVELENGTHS = tuple(range(400, 710, 10))
"""The wavelengths of the rows [nm]."""
ABSORPTION = (
    *(0.00663, 0.00473, 0.00454, 0.00495, 0.00635, 0.00922, 0.00979, 0.0106, 0.0127, 0.0150),
    *(0.0204, 0.0325, 0.0409, 0.0434, 0.0474, 0.0565, 0.0619, 0.0695, 0.0896, 0.1351),
    *(0.2224, 0.2644, 0.2755, 0.2916, 0.3108, 0.340, 0.410, 0.439, 0.465, 0.516, 0.624),
)
"""The absorption at the wavelengths [1/m]."""


def compute_pure_absorption(wavelength: float) -> float:
    """Compute the absorption of pure water [1/m] at a wavelength [nm], 400 to 700."""
    return float(np.interp(wavelength, WAVELENGTHS, ABSORPTION))


def compute_pure_scattering(wavelength: float) -> float:
    """Compute the scattering of sea water without particles [1/m] at a wavelength [nm]."""
    return 0.0019 * float((550.0 / wavelength) ** 4.32)
