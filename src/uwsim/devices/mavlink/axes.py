"""The axes of autopilots: forward, starboard, down (FRD), and north, east, down (NED)."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array, Pose
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


class HomeFrame:
    """The frame of an autopilot's local positions: north, east, down from home.

    Args:
        world_from_localized: the pose of L, the frame of positions on topics, in W.
        home: the position of home in L, (3,) [m].
    """

    def __init__(self, world_from_localized: Pose, home: Array) -> None:
        self._world_from_localized = world_from_localized
        self._home = world_from_localized.transform(home)
        self.ned_from_localized = product(NED_FROM_WORLD, world_from_localized.rotation)
        """The rotation from the axes of L to north, east, down, (3, 3)."""

    @property
    def origin(self) -> Array:
        """The position of home from the origin of W, north, east, down (3,) [m]."""
        return product(NED_FROM_WORLD, self._home)

    def position(self, point: Array) -> Array:
        """Return north, east, down from home of a point in L, (3,) [m]."""
        return product(NED_FROM_WORLD, self._world_from_localized.transform(point) - self._home)

    def localized_pose(self, position: Array, ned_from_body: Array) -> Pose:
        """Return the pose in L of a body with axes forward, starboard, down.

        Args:
            position: north, east, down from home, (3,) [m].
            ned_from_body: the axes of the body, (3, 3).
        """
        world_from_body = Pose(
            self._home + product(NED_FROM_WORLD.T, position),
            product(NED_FROM_WORLD.T, ned_from_body),
        )
        return self._world_from_localized.inverse() @ world_from_body
