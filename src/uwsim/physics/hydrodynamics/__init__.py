"""Hydrodynamics: added mass in the mass matrix, Coriolis, damping, buoyancy, current, thrust.

Here is what can be said of bodies and thrusters; the water itself is in `hydrodynamics.py`, which
compiles a kernel when it is imported: who simulates nothing does not wait for it.
"""

from __future__ import annotations

from .file.checks import vehicle_errors
from .file.spec import (
    BadHydrodynamics,
    BodyHydrodynamics,
    FinSpec,
    ThrusterSpec,
    VehicleHydrodynamics,
)
from .file.table import prepare

__all__ = [
    "BadHydrodynamics",
    "BodyHydrodynamics",
    "FinSpec",
    "ThrusterSpec",
    "VehicleHydrodynamics",
    "prepare",
    "vehicle_errors",
]
