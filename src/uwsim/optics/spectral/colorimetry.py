r"""The three channels of an image as sums over wavelengths.

A surface or water with the relative spectrum :math:`L(\lambda)` in daylight has in channel
:math:`i` of linear sRGB (IEC 61966-2-1) the value

.. math:: C_i = \sum_\lambda w_i L, \quad
    w_i \propto S_{D65} \sum_j M_{ij}\, \bar c_j, \quad \sum_\lambda w_i = 1

with the colour matching functions :math:`\bar c = (\bar x, \bar y, \bar z)` of the standard
observer (CIE 1931, 2 degrees), daylight :math:`S_{D65}` (CIE standard illuminant D65; ISO/CIE
11664-1 and -2), both in steps of 10 nm, and the matrix :math:`M` from XYZ to sRGB. A white surface
has 1 in each channel. The weights of a channel have negative parts, as those of every camera whose
colours were corrected: sRGB's primaries do not span all colours. Not modelled: the sensitivities
of one camera, whose colours differ from those of the standard observer by its own errors.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

STEP = 10
"""The distance of the wavelengths [nm]."""
WAVELENGTHS: FloatArray = np.arange(380.0, 720.0 + STEP, STEP)  # (35,) [nm]
"""The wavelengths of all spectra [nm], (35,)."""
OBSERVER = (
    (  # x
        *(0.0014, 0.0042, 0.0143, 0.0435, 0.1344, 0.2839, 0.3483, 0.3362, 0.2908, 0.1954),
        *(0.0956, 0.0320, 0.0049, 0.0093, 0.0633, 0.1655, 0.2904, 0.4334, 0.5945, 0.7621),
        *(0.9163, 1.0263, 1.0622, 1.0026, 0.8544, 0.6424, 0.4479, 0.2835, 0.1649, 0.0874),
        *(0.0468, 0.0227, 0.0114, 0.0058, 0.0029),
    ),
    (  # y
        *(0.0000, 0.0001, 0.0004, 0.0012, 0.0040, 0.0116, 0.0230, 0.0380, 0.0600, 0.0910),
        *(0.1390, 0.2080, 0.3230, 0.5030, 0.7100, 0.8620, 0.9540, 0.9950, 0.9950, 0.9520),
        *(0.8700, 0.7570, 0.6310, 0.5030, 0.3810, 0.2650, 0.1750, 0.1070, 0.0610, 0.0320),
        *(0.0170, 0.0082, 0.0041, 0.0021, 0.0010),
    ),
    (  # z
        *(0.0065, 0.0201, 0.0679, 0.2074, 0.6456, 1.3856, 1.7471, 1.7721, 1.6692, 1.2876),
        *(0.8130, 0.4652, 0.2720, 0.1582, 0.0782, 0.0422, 0.0203, 0.0087, 0.0039, 0.0021),
        *(0.0017, 0.0011, 0.0008, 0.0003, 0.0002, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000),
        *(0.0000, 0.0000, 0.0000, 0.0000, 0.0000),
    ),
)
"""The colour matching functions of the standard observer at `WAVELENGTHS`, (3, 35)."""
DAYLIGHT = (
    *(49.98, 54.65, 82.75, 91.49, 93.43, 86.68, 104.87, 117.01, 117.81, 114.86),
    *(115.92, 108.81, 109.35, 107.80, 104.79, 107.69, 104.41, 104.05, 100.00, 96.33),
    *(95.79, 88.69, 90.01, 89.60, 87.70, 83.29, 83.70, 80.03, 80.21, 82.28),
    *(78.28, 69.72, 71.61, 74.35, 61.60),
)
"""The relative power of D65 at `WAVELENGTHS`, (35,)."""
SRGB_FROM_XYZ = (
    (3.2406, -1.5372, -0.4986),
    (-0.9689, 1.8758, 0.0415),
    (0.0557, -0.2040, 1.0570),
)
"""The matrix of IEC 61966-2-1."""


def compute_channel_weights() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Compute the weights w of red, green and blue at `WAVELENGTHS`, (35,) each."""
    weights = []
    for row in SRGB_FROM_XYZ:
        matching_function = sum(
            factor * np.array(values) for factor, values in zip(row, OBSERVER, strict=True)
        )
        products = np.array(DAYLIGHT) * matching_function
        weights.append(products / math.fsum(products.tolist()))
    return weights[0], weights[1], weights[2]


def integrate_spectrum(weights: FloatArray, spectrum: FloatArray) -> float:
    """Compute the value of a channel from its weights and a spectrum at `WAVELENGTHS`."""
    return math.fsum((weights * spectrum).tolist())
