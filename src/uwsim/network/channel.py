"""How long a packet travels: channels described by delays, and sound in water."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from ..acoustics import sound_speed


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
class WaterChannel:
    """Sound in water of one temperature and salinity, along straight lines."""

    temperature: float
    """[degrees Celsius]."""
    salinity: float
    """[g/kg]."""

    def delay(self, path: Path) -> float:
        """Return how long sound travels, at the speed in the middle of its path [s]."""
        speed = sound_speed(temperature=self.temperature, salinity=self.salinity, depth=path.depth)
        return path.distance / speed
