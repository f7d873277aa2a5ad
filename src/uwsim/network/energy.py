"""The energy use of a device."""

from __future__ import annotations

from dataclasses import dataclass

from .events import NANOSECONDS


@dataclass(frozen=True, kw_only=True)
class EnergyModel:
    """The energy that a device has at the start, and the power that it consumes."""

    initial_energy: float
    """The energy at the start [J]."""
    turn_on_energy: float = 0.0
    """The energy that switching on the device takes, once [J]."""
    sending_power: float = 0.0
    """The power consumed while the device sends [W]."""
    receiving_power: float = 0.0
    """The power consumed while the device receives [W]."""
    idle_power: float = 0.0
    """The power consumed during the rest of the time [W]."""

    def remaining_energy(self, now: int, *, time_sending: int, time_receiving: int) -> float:
        """Return the remaining energy [J], at least 0.

        Args:
            now: the time since the start [ns].
            time_sending: the time spent sending [ns].
            time_receiving: the time spent receiving [ns].
        """
        time_idle = max(now - time_sending - time_receiving, 0)
        used_energy = (
            self.sending_power * time_sending
            + self.receiving_power * time_receiving
            + self.idle_power * time_idle
        ) / NANOSECONDS
        return max(self.initial_energy - self.turn_on_energy - used_energy, 0.0)
