"""Hydrodynamics: added mass in the mass matrix, Coriolis, damping, buoyancy, current, thrust."""

from __future__ import annotations

from .callback import CallbackTaken
from .hydrodynamics import Hydrodynamics, NoWater, install
from .layout import MujocoChanged
from .spec import (
    BadHydrodynamics,
    BodyHydrodynamics,
    ThrusterSpec,
    VehicleHydrodynamics,
    vehicle_faults,
)
from .table import prepare

__all__ = [
    "BadHydrodynamics",
    "BodyHydrodynamics",
    "CallbackTaken",
    "Hydrodynamics",
    "MujocoChanged",
    "NoWater",
    "ThrusterSpec",
    "VehicleHydrodynamics",
    "install",
    "prepare",
    "vehicle_faults",
]
