"""Forces on bodies other than gravity, contacts and hydrodynamics, one module for each kind."""

from __future__ import annotations

from .docking_magnet import DockingMagnetSpec
from .force import DrawnSegments, Force, ForceSpec
from .tether import Tether, TetherSpec

FORCES: dict[str, type[ForceSpec]] = {
    "dockingMagnet": DockingMagnetSpec,
    "tether": TetherSpec,
}
"""The spec class of each child element of ``<u:forces>``, by the element's name without prefix."""

__all__ = [
    "FORCES",
    "DockingMagnetSpec",
    "DrawnSegments",
    "Force",
    "ForceSpec",
    "Tether",
    "TetherSpec",
]
