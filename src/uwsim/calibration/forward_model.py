"""The forward model of all readings of a channel, as arrays, for the fit.

The phase function is :math:`m` times that of Fournier and Forand (1.10, 3.5835) plus :math:`1 - m`
times that of Henyey and Greenstein (0.9). All lengths of `readings` are linear in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..optics import FournierForand, HenyeyGreenstein, PhaseFunction, PhaseMixture
from ..optics.phase_function import FloatArray
from .readings import Reading

NARROW_PHASE: PhaseFunction = FournierForand()
"""The phase function for m = 1, with a narrow peak."""
WIDE_PHASE: PhaseFunction = HenyeyGreenstein(0.9)
"""The phase function for m = 0, without a narrow peak."""
MIN_ABSORPTION = 1e-9
"""The least absorption in a square root [1/m], whose slope is infinite at 0."""


@dataclass(frozen=True)
class WaterNumbers:
    """The numbers of a water in one channel."""

    absorption: float
    """The absorption a [1/m]."""
    scattering: float
    """The scattering b [1/m]."""
    shape: float
    """The shape m of the phase function: 1 is Fournier and Forand, 0 Henyey and Greenstein."""

    @property
    def beam_attenuation(self) -> float:
        """The beam attenuation c [1/m]."""
        return self.absorption + self.scattering


@dataclass(frozen=True, eq=False)
class ForwardModel:
    """The forward model of n readings."""

    path_lengths: FloatArray
    """The lengths L of the light's ways [m], (n,)."""
    kept_lengths: FloatArray
    """The lengths for the wide and the narrow phase function [m], (2, n)."""
    absorption_factors: FloatArray
    """The lengths to be subtracted for each unit of sqrt(a L) [m], (2, n)."""

    @classmethod
    def from_readings(cls, readings: Sequence[Reading]) -> ForwardModel:
        """Return the forward model of readings."""
        terms = np.array(
            [
                [reading.compute_kept_length(phase) for reading in readings]
                for phase in (WIDE_PHASE, NARROW_PHASE)
            ]
        )  # (2, n, 2)
        lengths = np.array([reading.path_length for reading in readings])
        return cls(lengths, terms[..., 0], terms[..., 1])

    def compute_losses(self, water: WaterNumbers) -> FloatArray:
        """Compute a L + b (L - beta), the loss of ln(signal) by the water, (n,)."""
        weights = np.array([1.0 - water.shape, water.shape])[:, None]
        absorption = max(water.absorption, MIN_ABSORPTION)
        roots = np.sqrt(absorption * self.path_lengths)
        kept_lengths = np.sum(weights * (self.kept_lengths - self.absorption_factors * roots), 0)
        losses: FloatArray = water.absorption * self.path_lengths + water.scattering * (
            self.path_lengths - kept_lengths
        )
        return losses


@lru_cache(maxsize=64)
def make_phase_function(shape: float) -> PhaseMixture:
    """Return the phase function of a shape m, which is limited to 0..1 to be positive."""
    weight = min(max(shape, 0.0), 1.0)
    return PhaseMixture((NARROW_PHASE, WIDE_PHASE), (weight, 1.0 - weight))
