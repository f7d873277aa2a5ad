"""A water with its coefficients in every channel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..optics import Medium, PhaseMixture, WaterFile
from .backscatter import Backscatter
from .estimate import Estimate
from .forward_model import make_phase_function
from .quantities import Quantity

N_FILE_CHANNELS = 3
"""The number of channels of a water file: red, green and blue."""


@dataclass(frozen=True, kw_only=True)
class ChannelResult:
    """The result of one channel."""

    estimate: Estimate
    """The coefficients and the fit."""
    quantities: tuple[Quantity, ...]
    """The quantities with their intervals."""
    backscatter: Backscatter | None = None
    """The scattering at 170 degrees; None if open water was not measured."""


@dataclass(frozen=True, kw_only=True)
class CalibratedWater:
    """The result of one water."""

    name: str
    """The name of the water."""
    dose: float | None
    """The amount of dye or powder; None if unknown."""
    channels: tuple[ChannelResult, ...]
    """The results of the channels."""
    remarks: tuple[str, ...] = ()
    """The readings that were left out, and why."""

    @property
    def shape(self) -> float:
        """The shape m of the phase function of all channels: the mean, weighted by certainty."""
        weights = [
            1.0 / max(result.estimate.standard_deviations["shape"] ** 2, 1e-9)
            for result in self.channels
        ]
        shapes = [result.estimate.water.shape for result in self.channels]
        return float(np.average(shapes, weights=weights))

    def make_water_file(self, source: str) -> WaterFile:
        """Return the water file of this water.

        The channels are those of the calibration, in their order; a single channel stands for red,
        green and blue.

        Args:
            source: the source of the numbers.
        """
        estimates = [result.estimate for result in self.channels]
        if len(estimates) == 1:
            estimates = estimates * N_FILE_CHANNELS
        phase = make_phase_function(self.shape)
        medium = Medium(
            absorption=tuple(_round_number(e.water.absorption) for e in estimates),
            scattering=tuple(_round_number(e.water.scattering) for e in estimates),
            phase_function=PhaseMixture(
                phase.parts, tuple(round(weight, 4) for weight in phase.weights)
            ),
        )
        names = ("absorption", "scattering", "beam_attenuation", "shape")
        return WaterFile(
            name=self.name,
            medium=medium,
            source=source,
            uncertainties={
                name: tuple(_round_number(e.standard_deviations[name]) for e in estimates)
                for name in names
            },
        )


def _round_number(number: float) -> float:
    """Round a number to five digits."""
    return float(f"{number:.5g}")
