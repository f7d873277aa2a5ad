"""Channels, which delay packets: by a constant and a delay per metre, or as sound in water."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

from ..acoustics import ambient_noise, power_sum, sound_speed

AbsorptionModel = Literal["thorp", "francoisGarrison"]


@dataclass(frozen=True, kw_only=True)
class Path:
    """The straight line between two devices."""

    distance: float
    """The length of the line [m]."""
    depth: float
    """The depth of the line's midpoint below the surface [m]; 0 if it is above the surface."""


class Channel(Protocol):
    """The medium through which packets travel."""

    def delay(self, path: Path) -> float:
        """Return the propagation delay of a packet [s]."""


@dataclass(frozen=True, kw_only=True)
class DelayChannel:
    """A channel with the delay ``minimum + per_metre * distance``."""

    minimum: float = 0.0
    """The delay at distance zero [s]."""
    per_metre: float = 0.66667e-3
    """The delay per distance [s/m]."""

    def delay(self, path: Path) -> float:
        """Return the propagation delay of a packet [s]."""
        return self.minimum + self.per_metre * path.distance


@dataclass(frozen=True, kw_only=True)
class Sea:
    """The conditions that determine the ambient noise of the sea."""

    shipping: float
    """The shipping activity from 0 (low) to 1 (high) [1]."""
    wind_speed: float
    """The wind speed at the surface [m/s]."""


@dataclass(frozen=True, kw_only=True)
class WaterChannel:
    """An acoustic channel in water of uniform temperature and salinity, with straight paths."""

    temperature: float = 25.0
    """The temperature of the water [degrees Celsius]."""
    salinity: float = 35.0
    """The salinity of the water [g/kg]."""
    bandwidth: float = 4096.0
    """The noise bandwidth of receivers [Hz]."""
    noise_level: float = 0.0
    """The spectral level of noise from other sources than the sea, in dB re 1 uPa^2/Hz."""
    sea: Sea | None = None
    """The conditions of the sea; None: the sea causes no noise."""
    absorption: AbsorptionModel = "francoisGarrison"
    """The absorption model."""

    def noise_at(self, frequency: float) -> float:
        """Return the spectral level of all noise at a ``frequency`` [Hz], in dB re 1 uPa^2/Hz."""
        if self.sea is None:
            return self.noise_level
        sea = ambient_noise(frequency, shipping=self.sea.shipping, wind_speed=self.sea.wind_speed)
        return power_sum((self.noise_level, sea))

    def delay(self, path: Path) -> float:
        """Return the propagation delay [s], with the sound speed at the path's midpoint."""
        speed = sound_speed(temperature=self.temperature, salinity=self.salinity, depth=path.depth)
        return path.distance / speed
