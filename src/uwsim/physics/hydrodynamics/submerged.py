"""The bodies on which the water acts, and the points at which it acts on them."""

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
    """The bodies of a scene on which the water acts.

    Args:
        model: the engine's model.
        poses: the poses of the engine's bodies.
        water: the hydrodynamics of the engine; None in a scene without dynamics.
        vehicles: the indices of the vehicles with dynamics, whose bases are included as the
            autopilots need the water's motion there.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        poses: Poses,
        water: Hydrodynamics | None,
        vehicles: Collection[int],
    ) -> None:
        self._poses = poses
        bodies = set() if water is None else {*water.bodies, *map(poses.base, vehicles)}
        self.bodies = np.array(sorted(bodies), np.int64)
        """The MuJoCo IDs of the bodies, (n,)."""
        points = (
            [] if water is None else [water.reference_point(body) for body in self.bodies.tolist()]
        )
        self.reference_points = np.array(points).reshape(-1, 3)
        """The points at which the water acts, in the frames of the bodies, (n, 3) [m].

        The point is the centre of buoyancy, or the reference point of a body that displaces no
        water.
        """
        parts = [model.body(body).name.split("/") for body in self.bodies.tolist()]
        self.vehicles = tuple(int(part[1]) if part[0] == "vehicle" else None for part in parts)
        """The index of the vehicle to which each body belongs; None for an object."""

    def positions(self) -> Array:
        """Return the present positions in W of the points at which the water acts, (n, 3) [m]."""
        return self._poses.points(self.bodies, self.reference_points)
