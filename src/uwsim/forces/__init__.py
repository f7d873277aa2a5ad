"""Forces on bodies that are not the hull's own hydrodynamics, one file each."""

from __future__ import annotations

from .docking_magnet import DockingMagnetSpec
from .force import Force, ForceSpec

FORCES: dict[str, type[ForceSpec]] = {
    "dockingMagnet": DockingMagnetSpec,
}
"""Element of ``<u:forces>``, without its prefix -> its spec, in alphabetical order."""

__all__ = ["FORCES", "DockingMagnetSpec", "Force", "ForceSpec"]
