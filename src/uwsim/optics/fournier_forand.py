"""The phase function of Fournier and Forand."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.numerics.elementwise import power
from ..errors import BadSetting, ErrorCollector
from .phase_function import MIN_ANGLE, FloatArray, PhaseFunction

REFRACTIVE_INDICES = (1.01, 1.35)
"""The smallest and the greatest refractive index of particles relative to water."""
SLOPES = (3.05, 4.95)
"""The smallest and the greatest slope of the distribution of particle sizes."""
_SERIES_LIMIT = 0.02
_SERIES_TERMS = 9


@dataclass(frozen=True)
class FournierForand(PhaseFunction):
    r"""The phase function of spheres whose sizes follow a power law.

    With :math:`\nu = (3 - \mu) / 2`, :math:`s = \sin(\theta / 2)`,
    :math:`\delta = 4 s^2 / (3 (n - 1)^2)` and :math:`\delta_{180} = 4 / (3 (n - 1)^2)`:

    .. math::
        p = \frac{\nu (1 - \delta) - (1 - \delta^\nu) + [\delta (1 - \delta^\nu) -
            \nu (1 - \delta)] s^{-2}}{4 \pi (1 - \delta)^2 \delta^\nu} +
            \frac{1 - \delta_{180}^\nu}{16 \pi (\delta_{180} - 1) \delta_{180}^\nu}
            (3 \cos^2\theta - 1)

        F = \frac{1 - \delta^{\nu + 1} - (1 - \delta^\nu) s^2}{(1 - \delta) \delta^\nu} +
            \frac{1 - \delta_{180}^\nu}{8 (\delta_{180} - 1) \delta_{180}^\nu}
            \cos\theta \sin^2\theta

    Source: G. R. Fournier and J. L. Forand, *Proc. SPIE* 2258, 194 (1994); G. R. Fournier and
    M. Jonasz, *Proc. SPIE* 3761, 62 (1999). The default stands for Petzold's average of turbid sea
    water: bb/b is 0.0183 (C. D. Mobley et al., *Appl. Opt.* 41, 1035 (2002)). The function is
    infinite at the angle zero. Not modelled: absorbing and non-spherical particles.
    """

    refractive_index: float = 1.10
    """The refractive index n of the particles relative to water, from 1.01 to 1.35."""
    slope: float = 3.5835
    """The slope mu of the size distribution, from 3.05 to 4.95."""

    def __post_init__(self) -> None:
        errors = ErrorCollector()
        for name, value, (low, high) in (
            ("refractive index", self.refractive_index, REFRACTIVE_INDICES),
            ("slope", self.slope, SLOPES),
        ):
            with errors.collect():
                if not low <= value <= high:
                    raise BadSetting(
                        f"The {name} of Fournier and Forand is {value:g}; expected {low:g} to "
                        f"{high:g}."
                    )
        errors.raise_errors()

    def compute_density(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the phase function at scattering angles [rad]; the result is in 1/sr."""
        angles = np.maximum(np.asarray(angle, dtype=np.float64), MIN_ANGLE)
        squares, delta, delta_power, quadratic = self._compute_terms(angles)
        peak = (delta * quadratic - self._exponent) / squares - quadratic
        cosines = np.cos(angles)
        return peak / (4.0 * math.pi * delta_power) + self._backward_factor * (
            3.0 * cosines * cosines - 1.0
        ) / (16.0 * math.pi)

    def compute_cumulative(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the fraction of the light that is scattered by less than angles [rad]."""
        given_angles = np.asarray(angle, dtype=np.float64)
        angles = np.maximum(given_angles, MIN_ANGLE)
        squares, delta, delta_power, quadratic = self._compute_terms(angles)
        linear = self._exponent + quadratic * (1.0 - delta)  # (1 - delta^nu) / (1 - delta)
        shares = (1.0 + delta * linear - linear * squares) / delta_power
        shares += self._backward_factor * np.cos(angles) * np.sin(angles) ** 2 / 8.0
        return np.where(given_angles > 0.0, np.clip(shares, 0.0, 1.0), 0.0)

    @property
    def _exponent(self) -> float:
        """The exponent nu, which is negative."""
        return (3.0 - self.slope) / 2.0

    @property
    def _backward_factor(self) -> float:
        """The factor of the two terms that are due to delta at 180 degrees."""
        delta = 4.0 / (3.0 * (self.refractive_index - 1.0) ** 2)
        delta_power = math.pow(delta, self._exponent)
        return (1.0 - delta_power) / ((delta - 1.0) * delta_power)

    def _compute_terms(
        self, angles: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        r"""Compute s^2, delta, delta^nu and (1 - delta^nu - nu (1 - delta)) / (1 - delta)^2.

        The last is a series near delta = 1, where the quotient loses its digits: with
        :math:`\epsilon = 1 - \delta` it is the sum over k of
        :math:`-\binom{\nu}{k} (-\epsilon)^k / \epsilon^2`, from k = 2.
        """
        nu = self._exponent
        squares = np.sin(angles / 2.0) ** 2
        delta = 4.0 * squares / (3.0 * (self.refractive_index - 1.0) ** 2)
        delta_power = power(delta, nu)
        epsilon = 1.0 - delta
        is_near = np.abs(epsilon) < _SERIES_LIMIT
        divisor = np.where(is_near, 1.0, epsilon)
        quotient = (1.0 - delta_power - nu * epsilon) / (divisor * divisor)
        series, coefficient = np.zeros_like(epsilon), nu
        near = np.where(is_near, epsilon, 0.0)
        factor = np.ones_like(near)
        for k in range(2, 2 + _SERIES_TERMS):
            coefficient *= -(nu - k + 1) / k  # (-1)^(k - 1) times the binomial coefficient
            series += coefficient * factor
            factor = factor * near
        return squares, delta, delta_power, np.where(is_near, series, quotient)
