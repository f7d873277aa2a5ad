"""The coefficients of a body in water, as a plug-in states them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...base.geometry import Array, Triple
from ..sdf.flat_model import FlatPlugin


@dataclass(frozen=True, kw_only=True)
class BodyCoefficients:
    """The added mass and damping of a link, in its axes, about its origin in the SDF file."""

    path: str
    """The path of the link."""
    plugin: FlatPlugin
    """The plug-in."""
    added_mass: Array
    """The added mass, (6, 6)."""
    linear_damping: Array
    """The linear damping, positive, (6, 6)."""
    quadratic_damping: Array
    """The quadratic damping, positive, (6, 6)."""
    notes: list[str]
    """The differences from the file."""
    current: Triple = (0.0, 0.0, 0.0)
    """The current in the world [m/s]."""
    volume: float | None = None
    """The displaced volume; None: that of the collision shapes [m3]."""
    centre_of_buoyancy: Triple | None = None
    """The centre of buoyancy; None: that of the collision shapes [m]."""
    box: Triple | None = None
    """The edges of the box for partial submersion [m]."""
    density: float | None = None
    """The density of the water [kg/m3]."""


@dataclass(kw_only=True)
class Water:
    """The water of a file, as its plug-ins state it."""

    density: float | None = None
    """The density; None: no plug-in states it [kg/m3]."""
    surface: float | None = None
    """The height of the surface; None: the water has none [m]."""
    current: Triple = (0.0, 0.0, 0.0)
    """The current [m/s]."""
    has_buoyancy: bool = True
    """True if collision shapes displace water."""
    buoyant_names: tuple[str, ...] = field(default=())
    """The models and links that displace water; empty: all."""

    def is_buoyant(self, model: str, link: str) -> bool:
        """Return whether the collision shapes of a link displace water."""
        if not self.has_buoyancy:
            return False
        names = (model, f"{model}::{link}")
        return not self.buoyant_names or any(name in self.buoyant_names for name in names)


def positive_damping(matrix: Array, name: str, notes: list[str]) -> Array:
    """Return a damping matrix whose diagonal is not negative, with a note if it was."""
    if (np.diag(matrix) < 0.0).any():
        notes.append(f"the {name} has the sign of a propulsion; its absolute values are used")
        matrix = np.where(np.eye(6, dtype=bool), np.abs(matrix), matrix)
    return matrix + 0.0
