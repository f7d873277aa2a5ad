"""The connection of a vehicle to its autopilot by MAVLink: sensors out, commands in and out."""

from __future__ import annotations

from .mavlink import MavlinkDevice, MavlinkSpec

__all__ = ["MavlinkDevice", "MavlinkSpec"]
