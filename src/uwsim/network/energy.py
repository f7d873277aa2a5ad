"""Energy use of a device."""

from __future__ import annotations

from dataclasses import dataclass

from .events import NANOSECONDS


@dataclass(frozen=True, kw_only=True)
class EnergyModel:
    """Energy at the start and powers of a device."""

    level: float
    """Energy at the start [J]."""
    turn_on: float = 0.0
    """To switch on, once [J]."""
    sending: float = 0.0
    """Power while sending [W]."""
    receiving: float = 0.0
    """Power while receiving [W]."""
    idle: float = 0.0
    """Power the rest of the time [W]."""

    def left(self, now: int, *, sent: int, received: int) -> float:
        """Return what is left [J], at least 0.

        Args:
            now: time since the start [ns].
            sent: time spent sending [ns].
            received: time spent receiving [ns].
        """
        rest = max(now - sent - received, 0)
        used = (self.sending * sent + self.receiving * received + self.idle * rest) / NANOSECONDS
        return max(self.level - self.turn_on - used, 0.0)
