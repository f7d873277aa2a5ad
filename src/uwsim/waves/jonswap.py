r"""jonswap: a sea with the JONSWAP spectrum.

.. code-block:: xml

    <u:jonswap>
      <u:significantHeight>1.5</u:significantHeight> <u:peakPeriod>6</u:peakPeriod>
      <u:peakFactor>3.3</u:peakFactor> <u:direction>M_PI_4</u:direction>
      <u:spreading>10</u:spreading>
    </u:jonswap>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import element
from .spectrum import Spectrum
from .wave_system import MAX_HEIGHT, IrregularWavesSpec


@dataclass(frozen=True, kw_only=True)
class JonswapSpec(IrregularWavesSpec):
    """A ``<u:jonswap>``: a growing wind sea, or swell with a high peak factor."""

    significant_height: float = element(namespaced=True, minimum=0, maximum=MAX_HEIGHT)
    """The significant wave height [m]."""
    peak_period: float = element(namespaced=True, minimum=0.2, maximum=60.0)
    """The period of the spectrum's peak [s]."""
    peak_factor: float = element(namespaced=True, default=3.3, minimum=1.0, maximum=10.0)
    """The peak factor gamma: 1 for a fully developed sea, 3.3 on average in JONSWAP [1]."""

    @property
    def spectrum(self) -> Spectrum:
        """The spectrum."""
        return Spectrum(
            significant_height=self.significant_height,
            peak_period=self.peak_period,
            peak_factor=self.peak_factor,
        )
