"""PX4 as the autopilot of a vehicle, in lock-step over its HIL messages."""

from __future__ import annotations

from .px4 import Px4, Px4Spec

__all__ = ["Px4", "Px4Spec"]
