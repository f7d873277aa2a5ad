r"""The blur of images by scattering, as a sum of five Gaussian levels.

.. math::
    I = D J + \sum_{l=0}^{4} w_l(R)\, (G_l * J) + B (1 - h) + V

:math:`J` is the radiance of the targets, linear and without water; :math:`G_l` a Gaussian with the
angular deviation :math:`\sigma_l` = 2, 8, 32, 128 and 512 mrad, every second level of a mip
pyramid; :math:`D`, :math:`h` and :math:`B` as in `transmission`; :math:`V` the veil of lamps
(`lamp_light`). With the modulation transfer :math:`M` the weights are

.. math::
    w_l = M(\psi_l) - M(\psi_{l-1}), \quad \psi_l = \frac{1}{4 \pi \sigma_l}, \quad
    M(\psi_{-1}) = e^{-c R}, \quad M(\psi_4) = M(0) = h

so that :math:`D + \sum w_l = h`: blur moves light and loses none. At a step in depth, weight by the
range of the source pixel. The edge of a black and a white half plane is within 2.4 % of the
scattered part for optical depths to 4.

Not modelled: the change of the spread across the image, and targets outside of it.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from .medium import Medium
from .phase_function import FloatArray, PhaseFunction
from .transmission import compute_direct, compute_full_field, compute_transfer_of_transform

SIGMAS = (0.002, 0.008, 0.032, 0.128, 0.512)
"""The standard deviations of the five Gaussian levels [rad]."""
N_LEVELS = len(SIGMAS)
FREQUENCIES = tuple(1.0 / (4.0 * math.pi * sigma) for sigma in SIGMAS[:-1])
"""The frequencies between neighbouring levels, decreasing [cycles/rad], (4,)."""


def compute_level_transforms(phase: PhaseFunction) -> FloatArray:
    """Compute the transform Q of a phase function at the four `FREQUENCIES`, for a shader.

    Together with 1 - bb/b, e0 and k these numbers determine all weights (`transmission`).
    """
    return phase.compute_transform(np.array(FREQUENCIES))


def compute_blur_weights(water: Medium, distance: npt.ArrayLike) -> FloatArray:
    """Compute the weights of the five Gaussian levels.

    Args:
        water: the water, of n channels.
        distance: the ranges [m], (...).

    Returns:
        The weights from the narrowest to the widest level, (..., 5, n).
    """
    ranges = np.asarray(distance, dtype=np.float64)
    transforms = compute_level_transforms(water.phase_function)
    transfers = [
        compute_direct(water, ranges),
        *(compute_transfer_of_transform(water, float(value), ranges) for value in transforms),
        compute_full_field(water, ranges),
    ]
    return np.diff(np.stack(transfers, axis=-2), axis=-2)
