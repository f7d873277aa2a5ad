"""Work on a panel by a vehicle with an arm, with parts of the algorithm ``grasp``."""

from __future__ import annotations

from .plug import Plug, PlugRigid, PlugTruth
from .valve import Valve, ValveRigid, ValveTruth

__all__ = ["Plug", "PlugRigid", "PlugTruth", "Valve", "ValveRigid", "ValveTruth"]
