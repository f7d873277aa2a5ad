"""The water as an acoustic medium."""

from __future__ import annotations

from dataclasses import dataclass

from .absorption import absorption
from .sound_speed import sound_speed


@dataclass(frozen=True)
class SeaWater:
    """The properties of sea water of uniform temperature and salinity."""

    temperature: float = 15.0
    """The temperature [degrees Celsius]."""
    salinity: float = 35.0
    """The salinity on the practical scale [g/kg]."""

    def sound_speed(self, depth: float) -> float:
        """Return the speed of sound at a depth [m], [m/s]."""
        return sound_speed(temperature=self.temperature, salinity=self.salinity, depth=depth)

    def absorption(self, frequency: float, depth: float) -> float:
        """Return the loss of sound of a frequency [Hz] at a depth [m], [dB/m]."""
        return absorption(
            frequency, temperature=self.temperature, salinity=self.salinity, depth=depth
        )
