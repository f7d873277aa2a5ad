"""The bodies that the water acts on."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from ...base.geometry import Array
from ..poses import Poses

if TYPE_CHECKING:
    from .hydrodynamics import Hydrodynamics


class SubmergedBodies:
    """The bodies of a scene that the water acts on.

    Args:
        model: of the engine.
        poses: where its bodies are.
        water: their hydrodynamics; None where nothing is simulated.
        vehicles: numbers of the simulated vehicles: autopilots feel the water at their bases.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        poses: Poses,
        water: Hydrodynamics | None,
        vehicles: Collection[int],
    ) -> None:
        self._poses = poses
        found = set() if water is None else {*water.bodies, *map(poses.base, vehicles)}
        self.bodies = np.array(sorted(found), np.int64)
        """Their numbers in the engine, (n,)."""
        points = (
            [] if water is None else [water.reference_point(body) for body in self.bodies.tolist()]
        )
        self.reference_points = np.array(points).reshape(-1, 3)
        """Where the water acts on each, in its axes, (n, 3) [m].

        At the centre of buoyancy; for a body that displaces nothing, where its matrices are about.
        """
        parts = [model.body(body).name.split("/") for body in self.bodies.tolist()]
        self.vehicles = tuple(int(part[1]) if part[0] == "vehicle" else None for part in parts)
        """The number of the vehicle that each belongs to; None: of none."""

    def positions(self) -> Array:
        """Return where the water acts on them now, in W, (n, 3) [m]."""
        return self._poses.points(self.bodies, self.reference_points)
