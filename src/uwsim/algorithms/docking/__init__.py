"""Guidance into docks: along the axis of a dock, and homing of a torpedo-shaped vehicle."""

from .homing import Homing, HomingLineOfSight
from .observed import Docking, DockingGirona
from .usbl import (
    DockingGironaUsbl,
    DockingGironaUsblProportional,
    DockingUsbl,
    DockingUsblProportional,
)

__all__ = [
    "Docking",
    "DockingGirona",
    "DockingGironaUsbl",
    "DockingGironaUsblProportional",
    "DockingUsbl",
    "DockingUsblProportional",
    "Homing",
    "HomingLineOfSight",
]
