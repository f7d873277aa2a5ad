"""The hydrodynamics file of a vehicle: specs, their reader, and checks of their numbers."""

from __future__ import annotations

from .spec import (
    BadHydrodynamics,
    BodyHydrodynamics,
    FinSpec,
    ThrusterSpec,
    VehicleHydrodynamics,
)

__all__ = [
    "BadHydrodynamics",
    "BodyHydrodynamics",
    "FinSpec",
    "ThrusterSpec",
    "VehicleHydrodynamics",
]
