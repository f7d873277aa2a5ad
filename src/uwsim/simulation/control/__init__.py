"""Services by which external programs pause, step, reset and rearrange a running simulation."""

from __future__ import annotations

from .control import Quit, SimulationControl

__all__ = ["Quit", "SimulationControl"]
