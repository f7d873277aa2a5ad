"""Controllers for visual station keeping: algorithms that read images and publish twists."""

from __future__ import annotations

from .controller import ControllerNode, Law, StationKeeper
from .feedforward import Feedforward
from .p import P
from .pi import PI

__all__ = ["PI", "ControllerNode", "Feedforward", "Law", "P", "StationKeeper"]
