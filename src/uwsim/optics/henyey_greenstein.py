"""The phase function of Henyey and Greenstein."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..errors import BadSetting
from .phase_function import FloatArray, PhaseFunction

MAX_MEAN_COSINE = 0.999


@dataclass(frozen=True)
class HenyeyGreenstein(PhaseFunction):
    r"""The phase function of one parameter, the mean cosine :math:`g`.

    .. math::
        p = \frac{1 - g^2}{4 \pi (1 + g^2 - 2 g \cos\theta)^{3/2}}, \quad
        F = \frac{1 - g^2}{2 g} \left( \frac{1}{1 - g} -
            \frac{1}{\sqrt{1 + g^2 - 2 g \cos\theta}} \right), \quad
        \frac{b_b}{b} = \frac{1 - g}{2 g} \left( \frac{1 + g}{\sqrt{1 + g^2}} - 1 \right)

    Source: L. G. Henyey and J. L. Greenstein, *Astrophys. J.* 93, 70 (1941). It has less light at
    small angles than sea water: 1.4 % within 1 degree for g = 0.9, where Fournier and Forand's has
    25 %. Halos and blur are therefore too wide.
    """

    asymmetry: float = 0.9
    """The mean cosine g, from 0 to 0.999."""

    def __post_init__(self) -> None:
        if not 0.0 <= self.asymmetry <= MAX_MEAN_COSINE:
            raise BadSetting(
                f"The mean cosine of Henyey and Greenstein is {self.asymmetry:g}; expected 0 to "
                f"{MAX_MEAN_COSINE:g}."
            )

    def compute_density(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the phase function at scattering angles [rad]; the result is in 1/sr."""
        root = self._compute_root(angle)
        density: FloatArray = (1.0 - self.asymmetry**2) / (4.0 * math.pi * root * root * root)
        return density

    def compute_cumulative(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the fraction of the light that is scattered by less than angles [rad].

        The form has no difference of near numbers: with s = sin(angle / 2) and the root r, it is
        2 (1 + g) s^2 / (r (r + 1 - g)).
        """
        g, root = self.asymmetry, self._compute_root(angle)
        squares = np.sin(np.asarray(angle, dtype=np.float64) / 2.0) ** 2
        return 2.0 * (1.0 + g) * squares / (root * (root + 1.0 - g))

    @cached_property
    def mean_cosine(self) -> float:
        """The mean cosine of the scattering angle, g."""
        return self.asymmetry

    def _compute_root(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the square root of 1 + g^2 - 2 g cos(angle)."""
        g, halves = self.asymmetry, np.asarray(angle, dtype=np.float64) / 2.0
        root: FloatArray = np.sqrt((1.0 - g) ** 2 + 4.0 * g * np.sin(halves) ** 2)
        return root
