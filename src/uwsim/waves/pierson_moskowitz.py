r"""piersonMoskowitz: a fully developed sea in a wind.

.. code-block:: xml

    <u:piersonMoskowitz> <u:windSpeed>8</u:windSpeed> </u:piersonMoskowitz>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import element
from .spectrum import Spectrum
from .wave_system import IrregularWavesSpec


@dataclass(frozen=True, kw_only=True)
class PiersonMoskowitzSpec(IrregularWavesSpec):
    """A ``<u:piersonMoskowitz>``: a fully developed sea."""

    wind_speed: float = element(namespaced=True, minimum=0.5, maximum=40.0)
    """The wind speed 19.5 m above the sea [m/s]."""

    @property
    def spectrum(self) -> Spectrum:
        """The spectrum."""
        return Spectrum.from_wind(self.wind_speed)
