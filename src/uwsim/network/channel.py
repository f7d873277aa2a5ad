"""Channels with propagation delays: constant and per metre, or of sound in water."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

from ..acoustics import ambient_noise, power_sum, sound_speed

AbsorptionModel = Literal["thorp", "francoisGarrison"]


@dataclass(frozen=True, kw_only=True)
class Path:
    """The straight line between two devices."""

    distance: float
    """Its length [m]."""
    depth: float
    """Of its middle below the surface, 0 above it [m]."""


class Channel(Protocol):
    """What carries packets."""

    def delay(self, path: Path) -> float:
        """Return how long a packet travels [s]."""


@dataclass(frozen=True, kw_only=True)
class DelayChannel:
    """A channel described by two numbers: ``minimum + per_metre * distance``."""

    minimum: float = 0.0
    """Delay at distance zero [s]."""
    per_metre: float = 0.66667e-3
    """Delay per distance [s/m]."""

    def delay(self, path: Path) -> float:
        """Return how long a packet travels [s]."""
        return self.minimum + self.per_metre * path.distance


@dataclass(frozen=True, kw_only=True)
class Sea:
    """Conditions of the ambient noise of the sea."""

    shipping: float
    """From 0, few ships, to 1 [1]."""
    wind_speed: float
    """At the surface [m/s]."""


@dataclass(frozen=True, kw_only=True)
class WaterChannel:
    """Sound in water of one temperature and salinity, along straight lines."""

    temperature: float = 25.0
    """[degrees Celsius]."""
    salinity: float = 35.0
    """[g/kg]."""
    bandwidth: float = 4096.0
    """In which receivers hear noise [Hz]."""
    noise_level: float = 0.0
    """Of the noise in 1 Hz besides that of the sea, in dB re 1 uPa^2/Hz."""
    sea: Sea | None = None
    """What makes the noise of the sea; None: it makes none."""
    absorption: AbsorptionModel = "francoisGarrison"
    """Whose formula."""

    def noise_at(self, frequency: float) -> float:
        """Return the level of all noise in 1 Hz at a ``frequency`` [Hz], in dB re 1 uPa^2/Hz."""
        if self.sea is None:
            return self.noise_level
        sea = ambient_noise(frequency, shipping=self.sea.shipping, wind_speed=self.sea.wind_speed)
        return power_sum((self.noise_level, sea))

    def delay(self, path: Path) -> float:
        """Return how long sound travels, at the speed in the middle of its path [s]."""
        speed = sound_speed(temperature=self.temperature, salinity=self.salinity, depth=path.depth)
        return path.distance / speed
