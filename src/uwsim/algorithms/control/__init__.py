"""Controllers as algorithms under test: they read images of a camera and publish twists."""

from __future__ import annotations

from .controller import ControllerNode, Law, StationKeeper
from .p import P
from .pi import PI

__all__ = ["PI", "ControllerNode", "Law", "P", "StationKeeper"]
