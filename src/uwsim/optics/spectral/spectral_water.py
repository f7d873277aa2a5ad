r"""Water with spectra of absorption and scattering, and its reduction to three channels.

A renderer of three channels needs one absorption :math:`a_i` and one scattering :math:`b_i` in
each. Light that has passed the range :math:`r` has in channel :math:`i` the share

.. math:: T_i(r) = \sum_\lambda w_i(\lambda)\, e^{-a(\lambda) r}

of a white surface (`colorimetry`), which is no exponential function: the wavelengths that are
absorbed least remain. The reduction is exact where the water has absorbed all but 1/e of a channel:

.. math:: T_i(r_i) = e^{-1}, \quad a_i = 1 / r_i, \quad
    b_i = \frac{\sum w_i e^{-a r_i}\, b}{\sum w_i e^{-a r_i}}

so the scattering is the mean over the light that is left there. It is exact for coefficients that
do not depend on the wavelength. Its errors in light, beam and colour against the sum over
wavelengths are in ``docs/water-optics.md`` and in the tests. A channel at one wavelength, such as
680 nm for red, is far from it: red light of a camera is mostly at 570 to 650 nm, where water
absorbs half as much.

Between the wavelengths of a table, what the water contains is interpolated, not the water:
:math:`a - a_w` and :math:`b - b_w` are linear between them and constant outside, because the
absorption of pure water rises steeply from 570 to 610 nm. Not modelled: fluorescence and Raman
scattering, and phase functions that depend on the wavelength.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...base.numerics.elementwise import exp
from ...errors import BadSetting, ErrorCollector
from ..medium import MAX_COEFFICIENT, PETZOLD_AVERAGE, Medium
from ..phase_function import PhaseFunction
from .colorimetry import WAVELENGTHS, FloatArray, compute_channel_weights, integrate_spectrum
from .pure_water import find_pure_water

N_WAVELENGTHS = (3, 1000)
"""The least and the greatest number of wavelengths of a table."""
WAVELENGTH_LIMITS = (300.0, 1000.0)
"""The limits of the wavelengths of a table [nm]."""
COVERED_WAVELENGTHS = (450.0, 620.0)
"""The range that a table must cover [nm]; an ac-9 measures from 412 to 715 nm."""
N_BISECTIONS = 60
MIN_ABSORPTION = 1e-6
"""The least absorption in the search for a range [1/m]."""
MAX_RANGE_RATIO = 4.0
"""The longest range of the search, over the absorption length of the clearest wavelength."""


@dataclass(frozen=True, kw_only=True)
class SpectralWater:
    """The coefficients of a water by wavelength.

    Raises:
        BadSetting: a number is invalid.
        SeveralErrors: several are.
    """

    wavelengths: tuple[float, ...]
    """The wavelengths, rising [nm]."""
    absorption: tuple[float, ...]
    """The absorption a at each wavelength, that of the water included [1/m]."""
    scattering: tuple[float, ...]
    """The scattering b at each wavelength, that of the water included [1/m]."""
    phase_function: PhaseFunction = PETZOLD_AVERAGE
    """The phase function of the particles."""

    def __post_init__(self) -> None:
        errors = ErrorCollector()
        for text in self._find_errors():
            with errors.collect():
                raise BadSetting(text)
        errors.raise_errors()

    def _find_errors(self) -> list[str]:
        min_number, max_number = N_WAVELENGTHS
        n = len(self.wavelengths)
        if not min_number <= n <= max_number:
            return [f"The spectrum has {n} wavelengths; expected {min_number} to {max_number}."]
        columns = {"absorption": self.absorption, "scattering": self.scattering}
        texts = [
            f"The spectrum has {n} wavelengths and {len(values)} values of {name}; expected one "
            "for each wavelength."
            for name, values in columns.items()
            if len(values) != n
        ]
        low, high = WAVELENGTH_LIMITS
        texts += [
            f"A wavelength of the spectrum is {value:g} nm; expected {low:g} to {high:g} nm."
            for value in self.wavelengths
            if not low <= value <= high
        ]
        if any(a >= b for a, b in zip(self.wavelengths, self.wavelengths[1:], strict=False)):
            texts.append("The wavelengths of the spectrum do not rise; expected them in order.")
        blue, red = COVERED_WAVELENGTHS
        if not (self.wavelengths[0] <= blue and self.wavelengths[-1] >= red):
            texts.append(
                f"The spectrum is from {self.wavelengths[0]:g} to {self.wavelengths[-1]:g} nm; "
                f"expected at least {blue:g} to {red:g} nm."
            )
        texts += [
            f"The {name} at {wavelength:g} nm is {value:g} 1/m; expected 0 to "
            f"{MAX_COEFFICIENT:g} 1/m."
            for name, values in columns.items()
            for wavelength, value in zip(self.wavelengths, values, strict=False)
            if not 0.0 <= value <= MAX_COEFFICIENT
        ]
        return texts

    @classmethod
    def from_contents(
        cls,
        wavelengths: tuple[float, ...],
        absorption: tuple[float, ...],
        scattering: tuple[float, ...],
        phase_function: PhaseFunction = PETZOLD_AVERAGE,
    ) -> SpectralWater:
        """Return the water with contents whose spectra do not contain the water itself.

        An absorption and attenuation meter that is set to zero in pure water measures such spectra.

        Args:
            wavelengths: the wavelengths [nm].
            absorption: the absorption of what the water contains [1/m].
            scattering: the scattering of what the water contains [1/m].
            phase_function: the phase function of the particles.
        """
        pure_water = [
            np.interp(wavelengths, WAVELENGTHS, values).tolist() for values in find_pure_water()
        ]
        return cls(
            wavelengths=wavelengths,
            absorption=tuple(a + b for a, b in zip(absorption, pure_water[0], strict=False)),
            scattering=tuple(a + b for a, b in zip(scattering, pure_water[1], strict=False)),
            phase_function=phase_function,
        )

    def resample(self) -> tuple[FloatArray, FloatArray]:
        """Return absorption and scattering at `WAVELENGTHS` [1/m], (35,) each."""
        pure_water = find_pure_water()
        spectra = []
        for values, water in zip((self.absorption, self.scattering), pure_water, strict=True):
            contents = np.array(values) - np.interp(self.wavelengths, WAVELENGTHS, water)
            spectrum = water + np.interp(WAVELENGTHS, self.wavelengths, contents)
            spectra.append(np.clip(spectrum, 0.0, MAX_COEFFICIENT))
        return spectra[0], spectra[1]

    def reduce(self) -> Medium:
        """Return the medium of three channels, red, green and blue."""
        return _reduce(self)


@lru_cache(maxsize=32)
def _reduce(water: SpectralWater) -> Medium:
    absorption, scattering = water.resample()
    molecules = np.minimum(find_pure_water()[1], scattering)
    rows = [
        _reduce_channel(weights, absorption, scattering, molecules)
        for weights in compute_channel_weights()
    ]
    return Medium(
        absorption=tuple(row[0] for row in rows),
        scattering=tuple(row[1] for row in rows),
        phase_function=water.phase_function,
        molecular_scattering=tuple(row[2] for row in rows),
    )


def _reduce_channel(
    weights: FloatArray, absorption: FloatArray, scattering: FloatArray, molecules: FloatArray
) -> tuple[float, float, float]:
    """Reduce a channel to its absorption, scattering and molecular scattering [1/m]."""
    low, high = (
        max(float(value), MIN_ABSORPTION) for value in (absorption.min(), absorption.max())
    )
    near, far = 1.0 / high, MAX_RANGE_RATIO / low
    for _ in range(N_BISECTIONS):
        middle = math.sqrt(near * far)
        if integrate_spectrum(weights, exp(-absorption * middle)) > math.exp(-1.0):
            near = middle
        else:
            far = middle
    remainder = weights * exp(-absorption * near)
    total = math.fsum(remainder.tolist())
    means = [
        min(
            max(integrate_spectrum(remainder, values) / total, float(values.min())),
            float(values.max()),
        )
        for values in (scattering, molecules)
    ]
    reduced_absorption = min(max(1.0 / near, float(absorption.min())), float(absorption.max()))
    return reduced_absorption, means[0], min(means[1], means[0])
