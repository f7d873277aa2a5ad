"""Forces on bodies that are not the hull's own hydrodynamics, one file each."""

from __future__ import annotations

from .docking_magnet import DockingMagnetSpec
from .force import Force, ForceSpec

FORCES: dict[str, type[ForceSpec]] = {
    "dockingMagnet": DockingMagnetSpec,
}
"""The specs by the element of ``<u:forces>``, without its prefix, in alphabetical order."""

__all__ = ["FORCES", "DockingMagnetSpec", "Force", "ForceSpec"]
