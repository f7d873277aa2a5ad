r"""Spectra of the elevation of a sea surface, over the angular frequency :math:`\omega`.

JONSWAP, normalised so that the significant wave height is :math:`H_s` for any peak factor
:math:`\gamma` within 1 % up to 7, 0.2 % up to 3.3 (DNV-RP-C205, section 3.5.5),

.. math:: S(\omega) = A_\gamma \tfrac{5}{16} H_s^2 \omega_p^4 \omega^{-5}
    e^{-\frac54 (\omega/\omega_p)^{-4}}
    \gamma^{\exp(-\frac12 ((\omega - \omega_p)/(\sigma \omega_p))^2)},
    \quad A_\gamma = 1 - 0.287 \ln \gamma

with :math:`\sigma = 0.07` up to the peak and 0.09 above it. With :math:`\gamma = 1` it is the
Pierson-Moskowitz spectrum of a fully developed sea, which in a wind of :math:`U` at 19.5 m has
:math:`H_s = 2 \sqrt{0.0081/0.74}\; U^2/g` and :math:`\omega_p = (0.8 \cdot 0.74)^{1/4} g/U`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.numerics.elementwise import exp, power
from ..world import GRAVITY

MIN_FREQUENCY_RATIO, MAX_FREQUENCY_RATIO = 0.4, 5.0
"""The range of the frequencies of waves, over the frequency of the peak [1]: 99.8 % of the variance
of a Pierson-Moskowitz spectrum."""
PHILLIPS_CONSTANT, WIND_CONSTANT = 0.0081, 0.74
"""The constants of Pierson and Moskowitz (1964) [1]."""


@dataclass(frozen=True, kw_only=True)
class Spectrum:
    """A JONSWAP spectrum."""

    significant_height: float
    """The significant wave height: four standard deviations of the elevation [m]."""
    peak_period: float
    """The period of the peak [s]."""
    peak_factor: float = 1.0
    """The peak factor gamma, 1 for Pierson-Moskowitz [1]."""

    @classmethod
    def from_wind(cls, wind_speed: float) -> Spectrum:
        """Return the Pierson-Moskowitz spectrum in a wind at 19.5 m above the sea [m/s]."""
        height = 2.0 * math.sqrt(PHILLIPS_CONSTANT / WIND_CONSTANT) * wind_speed**2 / GRAVITY
        peak = math.sqrt(math.sqrt(0.8 * WIND_CONSTANT)) * GRAVITY / wind_speed  # [rad/s]
        return cls(significant_height=height, peak_period=2.0 * math.pi / peak)

    @property
    def peak_frequency(self) -> float:
        """The angular frequency of the peak [rad/s]."""
        return 2.0 * math.pi / self.peak_period

    def density(self, angular_frequencies: Array) -> Array:
        """Compute the spectral density of the elevation.

        Args:
            angular_frequencies: the angular frequencies, (n,) [rad/s], above 0.

        Returns:
            The densities, (n,) [m2 s/rad].
        """
        ratio = np.asarray(angular_frequencies) / self.peak_frequency
        width = np.where(ratio <= 1.0, 0.07, 0.09)
        peak = power(self.peak_factor, exp(-0.5 * ((ratio - 1.0) / width) ** 2))
        scale = (1.0 - 0.287 * math.log(self.peak_factor)) * 5.0 / 16.0
        scale *= self.significant_height**2 / self.peak_frequency
        density: Array = scale * power(ratio, -5.0) * exp(-1.25 * power(ratio, -4.0)) * peak
        return density
