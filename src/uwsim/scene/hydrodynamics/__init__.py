"""The contents of a vehicle's hydrodynamics file: specs, their reader, and their errors."""

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
