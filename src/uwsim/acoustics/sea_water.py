"""Sea water as an acoustic medium: its sound speed and absorption."""

from __future__ import annotations

from dataclasses import dataclass

from .absorption import absorption
from .sound_speed import sound_speed


@dataclass(frozen=True)
class SeaWater:
    """A sea water of uniform temperature and salinity."""

    temperature: float = 15.0
    """The temperature [degrees Celsius]."""
    salinity: float = 35.0
    """The practical salinity [g/kg]."""

    def sound_speed(self, depth: float) -> float:
        """Return the speed of sound at a depth [m], [m/s]."""
        return sound_speed(temperature=self.temperature, salinity=self.salinity, depth=depth)

    def absorption(self, frequency: float, depth: float) -> float:
        """Return the absorption coefficient of sound at a frequency [Hz] and depth [m], [dB/m]."""
        return absorption(
            frequency, temperature=self.temperature, salinity=self.salinity, depth=depth
        )
