r"""piersonMoskowitz: a fully developed sea in a wind.

.. code-block:: xml

    <u:piersonMoskowitz> <u:windSpeed>8</u:windSpeed> </u:piersonMoskowitz>
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..schema import element
from .components import WaveComponents, draw_components
from .spectrum import Spectrum
from .wave_system import IrregularWavesSpec, SeaSettings


@dataclass(frozen=True, kw_only=True)
class PiersonMoskowitzSpec(IrregularWavesSpec):
    """A ``<u:piersonMoskowitz>``: a fully developed sea."""

    wind_speed: float = element(namespaced=True, minimum=0.5, maximum=40.0)
    """The wind speed 19.5 m above the sea [m/s]."""

    @property
    def spectrum(self) -> Spectrum:
        """The spectrum."""
        return Spectrum.from_wind(self.wind_speed)

    def components(self, sea: SeaSettings, rng: np.random.Generator) -> WaveComponents:
        """Draw its components."""
        return draw_components(
            self.spectrum,
            self.n_components,
            rng,
            direction=self.direction,
            spreading=self.spreading,
        )
