"""The axes of autopilots: forward, starboard, down (FRD), and north, east, down (NED)."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array, Pose, quaternion_from_rotation
from ...base.numerics.linear import product
from ...vehicle import Vehicle

NED_FROM_WORLD = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""The rotation from W (east, north, up) to north, east, down."""
HALF_TURN = np.diag([1.0, -1.0, -1.0])
"""The half turn about the x axis, between z up and z down."""


class BodyAxes:
    """The body axes of an autopilot on a vehicle whose base has its x axis forward.

    The z axis of the base points up (FLU) or down (FRD); that of its pose at the start decides.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        is_up = vehicle.world_from_base.rotation[2, 2] > 0.0
        self.frd_from_base = HALF_TURN if is_up else np.eye(3)
        """The rotation from base axes to forward, starboard, down, (3, 3)."""

    @property
    def ned_from_frd(self) -> Array:
        """The rotation from body axes to north, east, down at present, (3, 3)."""
        world_from_base = self._vehicle.world_from_base.rotation
        return product(product(NED_FROM_WORLD, world_from_base), self.frd_from_base.T)


def ned_pose(world_from_body: Pose) -> tuple[Array, tuple[float, ...]]:
    """Return a pose in W, of forward, starboard, down axes, as position in NED and quaternion.

    Args:
        world_from_body: the pose.

    Returns:
        North, east, down from the origin of W (3,) [m], and the quaternion w, x, y, z.
    """
    quaternion = quaternion_from_rotation(product(NED_FROM_WORLD, world_from_body.rotation))
    return product(NED_FROM_WORLD, world_from_body.position), tuple(quaternion.tolist())
