"""Controllers for visual station keeping: algorithms that read images and publish twists."""

from __future__ import annotations

from .controller import ControllerNode, Law, StationKeeper
from .p import P
from .pi import PI

__all__ = ["PI", "ControllerNode", "Law", "P", "StationKeeper"]
