"""The connection of a vehicle to ArduPilot, which steers it through its physics backend."""

from __future__ import annotations

from .link import ArduPilotLink
from .spec import ArduPilotSpec, thrusters_of

__all__ = ["ArduPilotLink", "ArduPilotSpec", "thrusters_of"]
