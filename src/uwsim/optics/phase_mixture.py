"""A phase function as a mixture of others, such as that of a calibrated water."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..errors import BadSetting, ErrorCollector
from .phase_function import FloatArray, PhaseFunction

MAX_PARTS = 8
"""The greatest number of parts of a mixture."""


@dataclass(frozen=True)
class PhaseMixture(PhaseFunction):
    r"""The phase function :math:`p = \sum_i w_i\, p_i` of particles of several kinds.

    Kind :math:`i` causes the fraction :math:`w_i` of the scattering :math:`b`. Single scattering is
    linear in the phase function, and so are the encircled energy and the transform Q.
    """

    parts: tuple[PhaseFunction, ...]
    """The phase functions of the kinds."""
    weights: tuple[float, ...]
    """The fraction of each kind, 0 or more; the fractions are divided by their sum."""

    def __post_init__(self) -> None:
        errors = ErrorCollector()
        n_parts, n_weights = len(self.parts), len(self.weights)
        with errors.collect():
            if not 1 <= n_parts <= MAX_PARTS:
                raise BadSetting(
                    f"A mixture of phase functions has {n_parts} parts; expected 1 to {MAX_PARTS}."
                )
        with errors.collect():
            if n_parts != n_weights:
                raise BadSetting(
                    f"A mixture has {n_parts} phase functions and {n_weights} weights; expected "
                    "one weight for each."
                )
        with errors.collect():
            if not all(0.0 <= weight < math.inf for weight in self.weights):
                raise BadSetting(
                    f"The weights of a mixture are {self.weights}; expected numbers of 0 or more."
                )
            if not sum(self.weights) > 0.0:
                raise BadSetting("The weights of a mixture are all 0; expected a positive one.")
        errors.raise_errors()

    def compute_density(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the phase function at scattering angles [rad]; the result is in 1/sr."""
        angles = np.asarray(angle, dtype=np.float64)
        total = np.zeros_like(angles)
        for part, weight in zip(self.parts, self._shares, strict=True):
            total = total + weight * part.compute_density(angles)
        return total

    def compute_cumulative(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the fraction of the light that is scattered by less than angles [rad]."""
        angles = np.asarray(angle, dtype=np.float64)
        total = np.zeros_like(angles)
        for part, weight in zip(self.parts, self._shares, strict=True):
            total = total + weight * part.compute_cumulative(angles)
        return total

    @property
    def _shares(self) -> list[float]:
        """The weights, divided by their sum."""
        total = sum(self.weights)
        return [weight / total for weight in self.weights]
