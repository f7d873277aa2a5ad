r"""Water as an optical medium: absorption, scattering and a phase function.

Light on a straight path of length :math:`r` keeps the fraction :math:`e^{-c r}` without being
absorbed or scattered, with the beam attenuation :math:`c = a + b`. Daylight decreases with depth by
the diffuse attenuation, for which J. T. O. Kirk (*Limnol. Oceanogr.* 29, 350 (1984)) fitted

.. math:: K_d = \sqrt{a^2 + 0.256\, a\, b}

to Monte-Carlo results for a sun at the zenith; about 10 % is its error. Not modelled: fluorescence,
Raman scattering, the change of the coefficients in space, and the spectrum inside a channel.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..errors import BadSetting, ErrorCollector
from .fournier_forand import FournierForand
from .phase_function import FloatArray, PhaseFunction

MAX_CHANNELS = 64
"""The greatest number of channels or spectral bands."""
COLOURS = ("red", "green", "blue")
"""The names of the channels of a medium that has three."""
MAX_COEFFICIENT = 1000.0
"""The greatest absorption or scattering coefficient [1/m]; milk has about 700."""
PETZOLD_AVERAGE = FournierForand(1.10, 3.5835)
"""The phase function that stands for Petzold's average of turbid sea water; the default."""
KIRK_FACTOR = 0.256
"""The factor of Kirk's formula, for a sun at the zenith."""


@dataclass(frozen=True, kw_only=True)
class Medium:
    """Homogeneous water. Arrays of its numbers have one entry for each channel, (n,).

    The channels are usually red, green and blue. A medium of one channel serves for one LED or one
    wavelength, one of more channels for spectral bands.

    Raises:
        BadSetting: a coefficient is invalid.
        SeveralErrors: several are.
    """

    absorption: tuple[float, ...]
    """The absorption coefficient a of each channel [1/m]."""
    scattering: tuple[float, ...]
    """The scattering coefficient b of each channel [1/m]."""
    phase_function: PhaseFunction = PETZOLD_AVERAGE
    """The phase function of particles, the same for all channels."""
    molecular_scattering: tuple[float, ...] = ()
    """The part of the scattering coefficient of each channel that the molecules of the water cause
    [1/m]; empty: none. Half of it goes backwards, so that it counts in daylight, where particles
    scatter 2 % backwards; blur and veils of lamps have the phase function of the particles."""

    def __post_init__(self) -> None:
        errors = ErrorCollector()
        for text in find_coefficient_errors(self.absorption, self.scattering):
            with errors.collect():
                raise BadSetting(text)
        molecules = self.molecular_scattering
        with errors.collect():
            if molecules and len(molecules) != len(self.scattering):
                raise BadSetting(
                    f"The molecular scattering has {len(molecules)} channels; expected those of "
                    f"the scattering, {len(self.scattering)}."
                )
            if not all(0.0 <= value <= MAX_COEFFICIENT for value in molecules):
                raise BadSetting(
                    f"The molecular scattering is {molecules}; expected 0 to {MAX_COEFFICIENT:g} "
                    "1/m."
                )
        errors.raise_errors()

    @classmethod
    def from_beam_attenuation(
        cls,
        beam_attenuation: Sequence[float],
        scattering: Sequence[float],
        phase_function: PhaseFunction = PETZOLD_AVERAGE,
    ) -> Medium:
        """Return the medium with the beam attenuation c and the scattering b [1/m] per channel.

        Raises:
            BadSetting: a coefficient is invalid, or b is greater than c.
            SeveralErrors: several are.
        """
        errors = ErrorCollector()
        n_channels = min(len(beam_attenuation), len(scattering))
        for number, (c, b) in enumerate(zip(beam_attenuation, scattering, strict=False), start=1):
            with errors.collect():
                if b > c:
                    raise BadSetting(
                        f"The scattering of {name_channel(number, n_channels)} is {b:g} 1/m; "
                        f"expected at most the beam attenuation, {c:g} 1/m."
                    )
        errors.raise_errors()
        differences = [beam_attenuation[i] - scattering[i] for i in range(n_channels)]
        remainder = tuple(beam_attenuation[n_channels:])
        return cls(
            absorption=(*differences, *remainder),
            scattering=tuple(scattering),
            phase_function=phase_function,
        )

    def scale(self, factor: float) -> Medium:
        """Return the medium with all coefficients times a factor; b/c and phase function remain.

        Raises:
            BadSetting: a coefficient is above `MAX_COEFFICIENT`.
            SeveralErrors: several are.
        """
        return replace(
            self,
            absorption=tuple(factor * value for value in self.absorption),
            scattering=tuple(factor * value for value in self.scattering),
            molecular_scattering=tuple(factor * value for value in self.molecular_scattering),
        )

    @property
    def molecules(self) -> FloatArray:
        """The molecular scattering of each channel, not more than the scattering [1/m]."""
        scattering = np.array(self.scattering)
        if not self.molecular_scattering:
            return np.zeros_like(scattering)
        molecules: FloatArray = np.minimum(np.array(self.molecular_scattering), scattering)
        return molecules

    @property
    def n_channels(self) -> int:
        """The number of channels."""
        return len(self.absorption)

    @property
    def beam_attenuation(self) -> FloatArray:
        """The beam attenuation c = a + b [1/m]."""
        attenuation: FloatArray = np.array(self.absorption) + np.array(self.scattering)
        return attenuation

    @property
    def single_scattering_albedo(self) -> FloatArray:
        """The fraction b/c of the attenuated light that is scattered; 0 where c is 0."""
        attenuation = self.beam_attenuation
        is_empty = attenuation == 0.0
        return np.where(
            is_empty, 0.0, np.array(self.scattering) / np.where(is_empty, 1.0, attenuation)
        )

    @property
    def attenuation_length(self) -> FloatArray:
        """The attenuation length 1/c [m]; infinite where c is 0."""
        attenuation = self.beam_attenuation
        is_empty = attenuation == 0.0
        lengths = 1.0 / np.where(is_empty, 1.0, attenuation)
        return np.where(is_empty, math.inf, lengths)

    @property
    def backscattering(self) -> FloatArray:
        """The backscattering coefficient bb [1/m]."""
        molecules = self.molecules
        particles = np.array(self.scattering) - molecules
        backscattering: FloatArray = (
            particles * self.phase_function.backscatter_ratio + 0.5 * molecules
        )
        return backscattering

    @property
    def diffuse_attenuation(self) -> FloatArray:
        """The diffuse attenuation Kd of daylight [1/m], after Kirk."""
        a, b = np.array(self.absorption), np.array(self.scattering)
        attenuation: FloatArray = np.sqrt(a * a + KIRK_FACTOR * a * b)
        return attenuation


def find_coefficient_errors(absorption: Sequence[float], scattering: Sequence[float]) -> list[str]:
    """Return everything that is wrong with coefficients [1/m], one text for each error."""
    n_absorption, n_scattering = len(absorption), len(scattering)
    if not 1 <= n_absorption <= MAX_CHANNELS:
        return [f"Water has {n_absorption} channels; expected 1 to {MAX_CHANNELS}."]
    if n_absorption != n_scattering:
        return [
            f"Water has {n_absorption} absorption and {n_scattering} scattering coefficients; "
            "expected one of each for every channel."
        ]
    return [
        f"The {name} of {name_channel(number, n_absorption)} is {value:g} 1/m; expected 0 to "
        f"{MAX_COEFFICIENT:g} 1/m."
        for name, values in (("absorption", absorption), ("scattering", scattering))
        for number, value in enumerate(values, start=1)
        if not 0.0 <= value <= MAX_COEFFICIENT
    ]


def name_channel(number: int, n_channels: int) -> str:
    """Return the name of a channel by its number from 1; three are red, green and blue."""
    return COLOURS[number - 1] if n_channels == len(COLOURS) else f"channel {number}"
