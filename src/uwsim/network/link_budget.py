r"""Link budget by the sonar equation: the signal-to-noise ratio of a link.

.. math::

    TL &= L + 10 k \log_{10} r + \alpha r \\
    SNR &= SL - TL - (NL + 10 \log_{10} B) \\
    E_b / N_0 &= SNR \cdot B / R \\
    P_b &= \tfrac{1}{2} \operatorname{erfc} \sqrt{E_b / N_0}

with the constant loss L [dB], the distance r [m] (at least 1 m), the spreading factor k (1
cylindrical, 1.5 practical, 2 spherical), the absorption :math:`\alpha` [dB/m] of Thorp or of
Francois and Garrison at the carrier frequency, the source level SL, the noise level NL in 1 Hz, the
bandwidth B [Hz] and the bit rate R [bit/s]. The last line is the bit error rate :math:`P_b` of
coherent BPSK in white Gaussian noise (Proakis, *Digital communications*). Not modelled: multipath,
fading, Doppler shift, coding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..acoustics import absorption, thorp_absorption
from .channel import AbsorptionModel, Path, WaterChannel


@dataclass(frozen=True, kw_only=True)
class LinkBudget:
    """The quantities of the sonar equation for a link between two modems."""

    source_level: float
    """The source level of the sender [dB re 1 uPa at 1 m]."""
    frequency: float
    """The carrier frequency [Hz]."""
    bandwidth: float
    """The noise bandwidth of the receiver [Hz]."""
    noise_level: float
    """The spectral level of the noise, in dB re 1 uPa^2/Hz."""
    spreading: float = 2.0
    """The spreading factor, from 1 (cylindrical) to 2 (spherical) [1]."""
    constant_loss: float = 0.0
    """The part of the transmission loss that does not depend on the distance [dB]."""
    absorption: AbsorptionModel = "francoisGarrison"
    """The absorption model."""
    temperature: float = 10.0
    """The temperature of the water, for Francois and Garrison [degrees Celsius]."""
    salinity: float = 35.0
    """The salinity of the water, for Francois and Garrison [g/kg]."""

    @staticmethod
    def from_water(
        water: WaterChannel,
        *,
        source_level: float,
        frequency: float,
        spreading: float,
        constant_loss: float,
    ) -> LinkBudget:
        """Return the link budget of a sender in a channel; the fields describe the arguments."""
        return LinkBudget(
            source_level=source_level,
            frequency=frequency,
            bandwidth=water.bandwidth,
            noise_level=water.noise_at(frequency),
            spreading=spreading,
            constant_loss=constant_loss,
            absorption=water.absorption,
            temperature=water.temperature,
            salinity=water.salinity,
        )

    def transmission_loss(self, path: Path) -> float:
        """Return the transmission loss of the signal [dB]."""
        distance = max(path.distance, 1.0)
        spread = 10.0 * self.spreading * math.log10(distance)
        return self.constant_loss + spread + self._absorption(path.depth) * distance

    def snr(self, path: Path) -> float:
        """Return the signal-to-noise ratio at the receiver [dB]."""
        noise = self.noise_level + 10.0 * math.log10(self.bandwidth)
        return self.source_level - self.transmission_loss(path) - noise

    def bit_error_rate(self, path: Path, bit_rate: float) -> float:
        """Return the bit error rate at ``bit_rate`` [bit/s], from 0 to 0.5."""
        ratio = 10.0 ** (self.snr(path) / 10.0) * self.bandwidth / bit_rate
        return bpsk_error_rate(ratio)

    def _absorption(self, depth: float) -> float:
        if self.absorption == "thorp":
            return thorp_absorption(self.frequency)
        return absorption(
            self.frequency, temperature=self.temperature, salinity=self.salinity, depth=depth
        )


def bpsk_error_rate(ratio: float) -> float:
    """Return the bit error rate of coherent BPSK at the ``ratio`` Eb/N0 [1], from 0 to 0.5."""
    return 0.5 * math.erfc(math.sqrt(ratio))
