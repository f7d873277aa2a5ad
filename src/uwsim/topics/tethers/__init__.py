"""The topics of tethers: their lengths and tensions, and the commands of their winches."""

from __future__ import annotations

from .ros_to_winch import ROSToWinchSpec
from .tether_to_ros import TetherToROSSpec

__all__ = ["ROSToWinchSpec", "TetherToROSSpec"]
