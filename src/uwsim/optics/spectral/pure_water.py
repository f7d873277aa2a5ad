r"""Absorption and scattering of pure sea water by wavelength.

The absorption is that of R. M. Pope and E. S. Fry (*Appl. Opt.* 36, 8710 (1997)), and beyond
700 nm that of L. Kou, D. Labrie and P. Chylek (*Appl. Opt.* 32, 3531 (1993)). The molecules scatter

.. math:: b_w = b_0 (550 / \lambda)^{4.32}

with :math:`b_0` = 0.0019 1/m (A. Morel, in *Optical Aspects of Oceanography*, 1974; R. C. Smith
and K. S. Baker, *Appl. Opt.* 20, 177 (1981)). Not modelled: temperature and salinity.
"""

from __future__ import annotations

import numpy as np

from .colorimetry import WAVELENGTHS, FloatArray

ABSORPTION = (
    *(0.0114, 0.00851, 0.00663, 0.00473, 0.00454, 0.00495, 0.00635, 0.00922, 0.00979, 0.0106),
    *(0.0127, 0.0150, 0.0204, 0.0325, 0.0409, 0.0434, 0.0474, 0.0565, 0.0619, 0.0695),
    *(0.0896, 0.1351, 0.2224, 0.2644, 0.2755, 0.2916, 0.3108, 0.340, 0.410, 0.439),
    *(0.465, 0.516, 0.624, 0.827, 1.231),
)
"""The absorption of pure water at `WAVELENGTHS` [1/m], (35,)."""
SCATTERING_AT_550 = 0.0019
"""The scattering of pure sea water at 550 nm [1/m]."""
REFERENCE_WAVELENGTH = 550.0
"""The wavelength [nm] of `SCATTERING_AT_550`."""
MOLECULAR_EXPONENT = 4.32
"""The exponent of Morel."""


def find_pure_water() -> tuple[FloatArray, FloatArray]:
    """Return absorption and scattering of pure sea water at `WAVELENGTHS` [1/m], (35,) each."""
    ratios = (REFERENCE_WAVELENGTH / WAVELENGTHS).tolist()
    scattering = np.array([SCATTERING_AT_550 * ratio**MOLECULAR_EXPONENT for ratio in ratios])
    return np.array(ABSORPTION), scattering


def scale_particles(scattering_at_550: float, exponent: float) -> FloatArray:
    """Compute the scattering of particles b_p (550 / wavelength)^exponent at `WAVELENGTHS` [1/m].

    Args:
        scattering_at_550: the scattering of the particles at 550 nm [1/m].
        exponent: the exponent: 1.7 for small particles in the sea, 1 for those of a pool.
    """
    ratios = (REFERENCE_WAVELENGTH / WAVELENGTHS).tolist()
    return np.array([scattering_at_550 * ratio**exponent for ratio in ratios])
